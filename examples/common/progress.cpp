#include "common/progress.hpp"

#include <csignal>
#include <cstdio>
#include <unistd.h>

namespace common {

namespace {

volatile std::sig_atomic_t interrupt_flag = 0;

extern "C" void on_interrupt(int) {
    interrupt_flag = 1;
}

} // namespace

// SA_RESETHAND: the second Ctrl-C finds the default action. Writing to an ffmpeg that has gone must
// be an error of the write, not the end of the program.
void watch_for_interrupt() {
    struct sigaction action {};
    action.sa_handler = on_interrupt;
    action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    std::signal(SIGPIPE, SIG_IGN);
}

bool interrupted() {
    return interrupt_flag != 0;
}

Progress::Progress(std::string label, uint32_t total)
    : label_(std::move(label)), total_(total), terminal_(isatty(STDERR_FILENO)),
      start_(Clock::now()), last_(start_) {}

Progress::~Progress() {
    if (terminal_)
        std::fputc('\n', stderr);
}

void Progress::update(uint32_t done) {
    const auto now = Clock::now();
    const std::chrono::duration<double> pause(terminal_ ? 0.1 : 10.0);
    if (now - last_ < pause && !(terminal_ && done == total_))
        return;
    last_ = now;
    const double spent = std::chrono::duration<double>(now - start_).count();
    const double left = spent * (total_ - done) / done;
    if (!terminal_) {
        std::fprintf(stderr, "%s %u/%u, %.0f s left\n", label_.c_str(), done, total_, left);
        return;
    }
    const std::string bar(30u * done / total_, '#');
    std::fprintf(stderr, "\r%s [%-30s] %u/%u, %.0f s left   ", label_.c_str(), bar.c_str(), done,
                 total_, left);
}

} // namespace common
