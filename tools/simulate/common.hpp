// What plait-simulate shares with the other programs.
#pragma once

#include "common/failure.hpp"
#include "common/handles.hpp"
#include "common/json_fwd.hpp"

namespace simulate {
using namespace common;
}
