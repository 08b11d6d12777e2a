// What a scene file says of detail after the simulation.
#pragma once

#include "common.hpp"

#include <plait/plait.h>

#include <optional>
#include <string>
#include <vector>

namespace simulate {

using Detail = std::optional<plait_detail_desc>; // absent: none

// The same run with another detail, to be shown beside it.
struct DetailChoice {
    std::string name;
    Detail detail;
};

// The object `value` of the key `detail`, its seed that of the scene. Ranges are the library's.
Detail read_detail(const JsonReader& top, const Json& value, uint64_t seed);
// The list of the key `compare_detail`.
std::vector<DetailChoice> read_details(JsonReader& top, uint64_t seed);

} // namespace simulate
