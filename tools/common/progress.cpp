#include "common/progress.hpp"

#include <atomic>
#include <csignal>
#include <cstdio>
#ifdef _WIN32
#define WIN32_LEAN_AND_MEAN
#include <io.h>
#include <windows.h>
#else
#include <thread>
#include <unistd.h>
#endif

namespace common {

namespace {

std::atomic<int> interrupt_signal = 0; // 0: none came

#ifdef _WIN32

bool is_terminal() {
    return _isatty(_fileno(stderr)) != 0;
}

// What is not handled ends the program.
BOOL WINAPI handle(DWORD event) {
    return (event == CTRL_C_EVENT || event == CTRL_BREAK_EVENT) &&
           interrupt_signal.exchange(SIGINT) == 0;
}

#else

bool is_terminal() {
    return isatty(STDERR_FILENO) != 0;
}

// The second signal finds the default action.
void wait_for_interrupt(const sigset_t& signals) {
    int signal = 0;
    while (sigwait(&signals, &signal) != 0) {
    }
    interrupt_signal = signal;
    while (sigwait(&signals, &signal) != 0) {
    }
    std::signal(signal, SIG_DFL);
    pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
    std::raise(signal);
}

#endif

} // namespace

#ifdef _WIN32

void watch_for_interrupt() {
    SetConsoleCtrlHandler(handle, TRUE);
}

#else

// A thread waits for the signals, and all others block them. So do the processes they start: Ctrl-C
// goes to all of a terminal's programs, and would end the linker that an OpenCL driver has called
// to make a kernel, or the ffmpeg that writes the film. Writing to an ffmpeg that has gone must be
// an error of the write, not the end of the program.
void watch_for_interrupt() {
    sigset_t signals;
    sigemptyset(&signals);
    sigaddset(&signals, SIGINT);
    sigaddset(&signals, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    std::thread(wait_for_interrupt, signals).detach();
    std::signal(SIGPIPE, SIG_IGN);
}

#endif

bool interrupted() {
    return interrupt_signal != 0;
}

Exit ended() {
    const int signal = interrupt_signal;
    return static_cast<Exit>(signal == 0 ? 0 : 128 + signal);
}

Progress::Progress(std::string label, uint32_t total)
    : label_(std::move(label)), total_(total), terminal_(is_terminal()), start_(Clock::now()),
      last_(start_) {}

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
