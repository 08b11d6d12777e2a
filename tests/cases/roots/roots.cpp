#include "inputs.hpp"

namespace plait::cases {
namespace {

std::vector<float> float_poses(Random& random, uint32_t count) {
    std::vector<float> poses;
    for (uint32_t i = 0; i < count; ++i) {
        for (double x : random.rotation())
            poses.push_back(static_cast<float>(x));
        for (int lane = 0; lane < 3; ++lane)
            poses.push_back(static_cast<float>(random.uniform(-1, 1)));
        poses.push_back(0);
    }
    return poses;
}

Setup make(uint32_t strands, bool per_root, bool other_hemisphere, bool bends) {
    Random random(strands);
    const std::vector<float> head = float_poses(random, 3);
    plait_roots_params params = {};
    for (int lane = 0; lane < 4; ++lane) {
        params.head_from_q[lane] = head[lane];
        params.head_from_t[lane] = head[4 + lane];
        // q and -q are the same rotation: the shorter arc must be taken.
        params.head_to_q[lane] = other_hemisphere ? -head[8 + lane] : head[8 + lane];
        params.head_to_t[lane] = head[12 + lane];
        params.head_before_q[lane] = other_hemisphere ? -head[16 + lane] : head[16 + lane];
        params.head_before_t[lane] = head[20 + lane];
    }
    params.alpha = 0.3f;
    params.per_root = per_root;
    params.bends = bends;
    Setup setup;
    setup.name = std::to_string(strands) + (per_root ? " strands, own poses" : " strands") +
                 (bends ? ", bent" : "");
    setup.items = strands;
    for (int end = 0; end < 3; ++end)
        setup.buffers.push_back(per_root ? float4s(float_poses(random, strands)) : null_array());
    setup.buffers.push_back(unwritten_float4s(2 * strands));
    return setup.with(params);
}

} // namespace

// A product of unit quaternions and a sum of three rotated vectors of length about 1.
Case roots_case() {
    return {PLAIT_STAGE_roots,
            {make(67, true, false, true), make(7, true, true, true), make(67, true, false, false),
             make(7, true, true, false), make(67, false, false, true), make(1, false, true, false)},
            {{"pose", 2e-6}},
            {},
            {},
            {},
            {},
            {"bends", "head_before_q", "head_before_t", "root_before"}}; // of paths that bend
}

} // namespace plait::cases
