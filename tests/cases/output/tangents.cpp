#include "inputs.hpp"

namespace plait::cases {

// The direction of a 2 cm segment: exact differences of float32 points, so only the division
// rounds.
Case tangents_case() {
    Case result = {PLAIT_STAGE_tangents, {}, {{"tangent", 1e-6}}, {"position.w"}};
    for (const Size& size : sizes()) {
        const Hair hair = make_hair(size, 15);
        std::vector<float> position = hair.position;
        for (uint32_t s = 0; s < size.strands; ++s) // stale padding, to be refreshed
            for (uint32_t i = hair.vertex_count[s]; i < size.stride; ++i)
                position[4 * (size_t{s} * size.stride + i)] += 1;
        if (size.stride == 16) // a segment without a direction
            for (int lane = 0; lane < 4; ++lane)
                position[4 * 6 + lane] = position[4 * 5 + lane];
        Setup setup;
        setup.name = name_of(size);
        setup.items = hair.vertices();
        setup.buffers = {uints(hair.vertex_count), float4s(position),
                         unwritten_float4s(hair.vertices())};
        result.setups.push_back(setup.with(plait_tangents_params{size.stride, 0}));
        // of all strands but the first two
        if (size.strands > 2) {
            setup.name += ", not of the first";
            setup.items -= 2 * size.stride;
            result.setups.push_back(setup.with(plait_tangents_params{size.stride, 2}));
        }
    }
    return result;
}

} // namespace plait::cases
