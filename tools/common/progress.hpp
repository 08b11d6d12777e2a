// A progress line on stderr: a bar with the time left on a terminal, a line now and then elsewhere.
#pragma once

#include "common/failure.hpp"

#include <chrono>
#include <cstdint>
#include <string>

namespace common {

class Progress {
  public:
    Progress(std::string label, uint32_t total);
    ~Progress(); // ends the line
    void update(uint32_t done);

  private:
    using Clock = std::chrono::steady_clock;
    std::string label_;
    uint32_t total_;
    bool terminal_;
    Clock::time_point start_, last_;
};

// Set by Ctrl-C after watch_for_interrupt(); a second Ctrl-C ends the program at once. Call it
// before anything starts a thread or a program: what is started later leaves Ctrl-C to us. SIGTERM
// counts as Ctrl-C.
void watch_for_interrupt();
bool interrupted();

// How what has written all it has may end: ok, or where it was interrupted 128 + the signal's
// number, 130 of Ctrl-C, so that what a shell was to run after it is not run.
Exit ended();

} // namespace common
