// What plait-lab is asked for.
#pragma once

#include "common.hpp"

#include <functional>

namespace lab {

// Reads the command line. Returns what the chosen command does, or what is done instead: a list of devices, help,
// what is wrong with the command line.
std::function<Exit()> read_command_line(int argc, char** argv);

} // namespace lab
