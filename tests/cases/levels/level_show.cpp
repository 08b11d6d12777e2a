#include "inputs.hpp"

namespace plait::cases {

// Places and turned offsets of up to 2 m.
Case level_show_case() {
    Case result = {PLAIT_STAGE_level_show, {}, {{"position", 2e-6}}, {"position.w"}};
    for (const Size& size : sizes()) {
        const Hair hair = make_hair(size, 73);
        std::vector<uint32_t> guides;
        for (uint32_t strand = 0; strand < size.strands; ++strand)
            guides.push_back(size.strands - 1 - strand);
        for (const uint32_t whole : {0u, 1u}) {
            Setup setup;
            setup.name = name_of(size) + (whole ? ", whole" : "");
            setup.items = hair.vertices();
            setup.buffers = {uints(guides), float4s(hair.pose), float4s(hair.position),
                             float4s(hair.position_prev)};
            result.setups.push_back(setup.with(plait_level_params{size.stride, whole, 0.7f}));
        }
    }
    return result;
}

} // namespace plait::cases
