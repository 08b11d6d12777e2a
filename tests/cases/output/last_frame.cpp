#include "inputs.hpp"

namespace plait::cases {

Case last_frame_case() {
    Case result = {PLAIT_STAGE_last_frame, {}, {{"position_last_frame", 1e-6}}, {"vertex_stride"}};
    for (const Size& size : sizes()) {
        const Hair hair = make_hair(size, 12);
        Setup setup;
        setup.name = name_of(size);
        setup.items = hair.vertices();
        setup.buffers = {float4s(hair.position), unwritten_float4s(hair.vertices())};
        result.setups.push_back(
            setup.with(plait_last_frame_params{size.stride, size.stride % 2 ? 1.0f : 1.7f}));
    }
    return result;
}

} // namespace plait::cases
