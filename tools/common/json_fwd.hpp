// Names of json_reader.hpp for headers that only pass them on: nlohmann's own header takes a compiler seconds.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace common {

using Json = nlohmann::json;
class JsonReader;
struct Origin;

} // namespace common
