// What OBJ text must be before assimp may see it.
#pragma once

#include "base/result.hpp"

#include <string>
#include <string_view>

namespace plait {

// BAD_DATA (line, value, allowed range) unless assimp reads `text` as the OBJ specification says,
// and within its own memory. `file` is for the message.
Status check_obj(std::string_view text, const std::string& file);

} // namespace plait
