// Files that appear whole or not at all: written beside their place, then renamed.
#pragma once

#include "common/json_fwd.hpp"

#include <string>

namespace common {

std::string json_text(const Json& json); // as write_json writes it
void write_text(const std::string& text, const std::string& path);
void write_json(const Json& json, const std::string& path);
void make_folder(const std::string& path);

} // namespace common
