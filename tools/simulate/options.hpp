// The command line of plait-simulate.
#pragma once

#include "common/json_reader.hpp"
#include "many.hpp"
#include "scene/scene.hpp"

#include <optional>

namespace simulate {

struct CommandLine {
    bool list_devices = false;
    bool list_presets = false;
    bool list_params = false;
    std::optional<int> exit_code; // set when --help or an error has been printed
    std::vector<std::string> scene_files;
    std::optional<Part> part;
    Json keys = Json::object(); // what was given, as keys of a scene file
};

CommandLine read_command_line(int argc, char** argv);

} // namespace simulate
