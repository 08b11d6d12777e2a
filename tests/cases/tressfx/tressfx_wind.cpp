#include "inputs.hpp"

namespace plait::cases {
namespace {

Setup make(const Size& size, uint32_t form) {
    const Hair hair = make_hair(size, 8);
    Setup setup;
    setup.name = name_of(size) + (form == PLAIT_WIND_DRAG ? ", drag" : ", published");
    setup.items = size.strands;
    setup.width = size.stride;
    setup.buffers = {uints(hair.vertex_count), float4s(hair.position_prev), float4s(hair.position)};
    plait_tressfx_wind_params params = {size.stride, 1.0f / 30, form, 5, {3, -2, 1.5f, 0}, {}};
    // Strong enough that 1 % of one component moves a 2 cm segment by micrometres.
    Random random(size.strands);
    for (float& component : params.corner)
        component = static_cast<float>(random.uniform(3000, 6000));
    return setup.with(params);
}

} // namespace

// Drag divides positions by h and multiplies by it again; the published form multiplies a segment's
// square by 4 m per m^2. Both keep the rounding of positions of about 1 m.
Case tressfx_wind_case() {
    Case result = {PLAIT_STAGE_tressfx_wind, {}, {{"position", 2e-6}}};
    for (const Size& size : sizes())
        for (uint32_t form : {PLAIT_WIND_DRAG, PLAIT_WIND_PUBLISHED})
            result.setups.push_back(make(size, form));
    return result;
}

} // namespace plait::cases
