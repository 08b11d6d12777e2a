#include "follows/follow_out.hpp"

namespace plait::cases {
namespace {

Setup make(const Size& size) {
    const FollowHair hair = hair_through_bodies(size, 84);
    NearestMeshes meshes;
    Random random(85);
    const uint32_t count = size.strands;
    for (uint32_t i = 0; i < count; ++i) {
        add_ball(meshes, random, i % 5 == 4, i % 2 == 0);
        add_body_row(meshes.rows, random, hair, size, i, i % 4 == 3, 0.7f);
    }
    Setup setup;
    setup.name = name_of(size);
    setup.items = hair.follows;
    std::vector<float> rows(meshes.rows.size(), 0.5f); // of the substep before
    rows.insert(rows.end(), meshes.rows.begin(), meshes.rows.end());
    setup.width = size.stride;
    setup.buffers = {lanes_of(hair), float4s(rows)};
    auto of_meshes = meshes.buffers();
    of_meshes.pop_back(); // clearances, which are of guides
    setup.buffers.insert(setup.buffers.end(), of_meshes.begin(), of_meshes.end());
    setup.buffers.push_back(float4s(hair.position));
    return setup.with(out_params(size, count));
}

} // namespace

// What a turn is off by moves all that comes after it.
Case follow_nearest_case() {
    Case result = {PLAIT_STAGE_follow_nearest, {}, {{"position", 1e-5}}};
    result.unread = out_unread();
    result.unread.push_back("mesh_box");   // bounds, which the reference does without
    result.unread.push_back("mesh_bends"); // whether there is anything to bend
    for (const Size& size : contact_sizes())
        result.setups.push_back(make(size));
    return result;
}

} // namespace plait::cases
