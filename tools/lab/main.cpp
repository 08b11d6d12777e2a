// plait-lab: scenes with known answers, run by models and baselines and measured.
#include "command_line.hpp"

#include "common/progress.hpp"

#include <cstdio>

namespace lab {

namespace {

// A command that was interrupted has done what it could.
Exit exit_after(Exit command) {
    return command == Exit::ok ? ended() : command;
}

int main_of(int argc, char** argv) {
    const auto command = read_command_line(argc, argv);
    watch_for_interrupt();
    return static_cast<int>(exit_after(command()));
}

} // namespace

} // namespace lab

int main(int argc, char** argv) {
    try {
        return lab::main_of(argc, argv);
    } catch (const lab::Failure& failure) {
        std::fprintf(stderr, "plait-lab: %s\n", failure.what());
        return static_cast<int>(failure.exit);
    } catch (const std::exception& failure) {
        std::fprintf(stderr, "plait-lab: %s\n", failure.what());
        return 1;
    }
}
