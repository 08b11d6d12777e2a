#pragma once

#include "generator/generator.hpp"

#include <string>

namespace plait_groom_tool {

// glTF 2.0 in one file: mesh, skin and animation. "" if it was written; else what failed. The file
// appears whole or not at all.
std::string write_gltf(const plait_generator::Character& character, const std::string& path);

} // namespace plait_groom_tool
