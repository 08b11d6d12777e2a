#include "follows/follow_out.hpp"
#include "mesh/field_inputs.hpp"

namespace plait::cases {
namespace {

Setup make(const Size& size) {
    const FollowHair hair = hair_through_bodies(size, 82);
    FieldMeshes meshes;
    Random random(83);
    const uint32_t count = size.strands;
    for (uint32_t i = 0; i < count; ++i) {
        meshes.add(random);
        add_body_row(meshes.rows, random, hair, size, i, i % 4 == 3);
    }
    Setup setup;
    setup.name = name_of(size);
    setup.items = hair.follows;
    std::vector<float> rows(meshes.rows.size(), 0.5f); // of the substep before
    rows.insert(rows.end(), meshes.rows.begin(), meshes.rows.end());
    setup.width = size.stride;
    setup.buffers = {lanes_of(hair),      float4s(rows),         float4s(meshes.grid),
                     uints(meshes.nodes), floats(meshes.values), float4s(hair.position)};
    return setup.with(out_params(size, count));
}

} // namespace

// What a turn is off by moves all that comes after it.
Case follow_field_case() {
    Case result = {PLAIT_STAGE_follow_field, {}, {{"position", 1e-5}}};
    result.unread = out_unread();
    result.unread.push_back("collider.end.a.radius");
    for (const Size& size : contact_sizes())
        result.setups.push_back(make(size));
    return result;
}

} // namespace plait::cases
