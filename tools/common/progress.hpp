// A progress line on stderr: a bar with the time left on a terminal, a line now and then elsewhere.
#pragma once

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
// before anything starts a thread or a program: what is started later leaves Ctrl-C to us.
void watch_for_interrupt();
bool interrupted();

} // namespace common
