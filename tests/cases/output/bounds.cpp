#include "inputs.hpp"

#include <limits>

namespace plait::cases {
namespace {

Setup make(const Size& size, uint32_t share, bool boxes, bool broken) {
    Hair hair = make_hair(size, 12);
    if (broken) {
        hair.position[4 * 1] = std::numeric_limits<float>::quiet_NaN();
        hair.position[1] = std::numeric_limits<float>::infinity();
    }
    const uint32_t count = boxes ? hair.vertices() / 2 : hair.vertices();
    Setup setup;
    setup.name = name_of(size) + (boxes ? ", boxes" : "") + (broken ? ", broken" : "");
    setup.items = (count + share - 1) / share;
    setup.buffers = {float4s(hair.position), unwritten_float4s(size_t{2} * setup.items)};
    return setup.with(plait_bounds_params{count, share, boxes});
}

} // namespace

// Comparisons of floats: exact.
Case bounds_case() {
    Case result = {PLAIT_STAGE_bounds, {}, {{"box", 0}}, {"points.w"}};
    for (const Size& size : sizes())
        for (const bool boxes : {false, true})
            result.setups.push_back(make(size, 7, boxes, false));
    result.setups.push_back(make(sizes().back(), 1, false, true)); // a run of nothing finite
    return result;
}

} // namespace plait::cases
