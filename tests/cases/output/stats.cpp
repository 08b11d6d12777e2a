#include "inputs.hpp"

#include <limits>

namespace plait::cases {

// A stretch is a 2 cm length over another one, of coordinates near 1 m: 1e-7 / 0.02 of its value.
Case stats_case() {
    Case result = {PLAIT_STAGE_stats, {}, {{"strand_stats", 1e-5}}, {"position.w"}};
    for (const Size& size : sizes())
        for (bool broken : {false, true}) {
            Hair hair = make_hair(size, 16);
            if (broken) { // a strand of each kind of trouble
                hair.position[4 * 1] = std::numeric_limits<float>::quiet_NaN();
                hair.position_prev[4 * (size_t{hair.vertices()} - 2) + 2] =
                    std::numeric_limits<float>::infinity();
                hair.rest_length[0] = 0;
            }
            Setup setup;
            setup.name = name_of(size) + (broken ? ", broken" : "");
            setup.items = size.strands;
            setup.buffers = {floats(hair.rest_length), uints(hair.vertex_count),
                             float4s(hair.position), float4s(hair.position_prev),
                             unwritten_float4s(size.strands)};
            result.setups.push_back(setup.with(plait_layout_params{size.stride}));
        }
    return result;
}

} // namespace plait::cases
