#pragma once

#include <string>

namespace plait_groom_tool {

// "" if it was written; else what failed. The file appears whole or not at all.
std::string write_whole(const std::string& text, const std::string& path);

} // namespace plait_groom_tool
