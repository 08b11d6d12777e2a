// Who looks at a run, frame by frame.
#pragma once

#include "shot.hpp"

#include <functional>

namespace simulate {

// `wanted(frame)`: whether see() is to be given that frame's positions.
struct Watcher {
    std::function<bool(uint32_t frame)> wanted;
    std::function<void(const Shot&)> see;
};

} // namespace simulate
