#pragma once

#include "generator/generator.hpp"

#include <string>

namespace plait_groom_tool {

// Wavefront OBJ with normals, to 0.1 mm. "" if it was written; else what failed.
// The file appears whole or not at all.
std::string write_obj(const plait_generator::HeadMesh& mesh, const std::string& path);

} // namespace plait_groom_tool
