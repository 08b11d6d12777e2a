#include "volume/volume_inputs.hpp"

#include <algorithm>

namespace plait::cases {
namespace {

float draw(Random& random, double low, double high) {
    return static_cast<float>(random.uniform(low, high));
}

bool outermost(uint32_t node, uint32_t n) {
    const uint32_t cell[] = {node % n, node / (n * n), node / n % n};
    return std::any_of(std::begin(cell), std::end(cell),
                       [&](uint32_t i) { return i == 0 || i + 1 == n; });
}

void add_vector(std::vector<float>& to, Random& random, double most, float w) {
    for (int axis = 0; axis < 3; ++axis)
        to.push_back(draw(random, -most, most));
    to.push_back(w);
}

} // namespace

const std::vector<uint32_t>& volume_sizes() {
    static const std::vector<uint32_t> sizes = {1, 2, 5, 8, 11};
    return sizes;
}

VolumeNodes make_volume_nodes(uint32_t n) {
    Random random(n), wet(n + 1);
    VolumeNodes nodes;
    nodes.edge_count = n;
    for (uint32_t i = 0; i < n * n * n; ++i) {
        const bool empty = i % 5 == 3, thin = i % 5 == 1, inside = i % 7 == 4;
        nodes.density.push_back(empty ? 0 : thin ? draw(random, .05, .1) : draw(random, .4, 4));
        nodes.rest.push_back(empty ? 0 : draw(random, 2.2, 3));
        nodes.wetness.push_back(draw(wet, .2, 1));
        add_vector(nodes.velocity, random, .6, 1);
        add_vector(nodes.solid, random, inside ? 1 : 0, inside ? 1 : 0);
        nodes.before.push_back(empty ? 0 : draw(random, 0, 2));
        const float then = i % 3 ? 0.7f : 2.1f; // density of the step before
        nodes.potential.insert(nodes.potential.end(), {nodes.before.back(), then});
        nodes.pressure.push_back(empty ? 0 : draw(random, -.2, 2));
        for (int axis = 0; axis < 3; ++axis)
            nodes.link.push_back(i % 4 == 2 ? 0 : draw(random, .2, 3));
        nodes.link.push_back(nodes.before.back());
        const bool none = inside || outermost(i, n);
        nodes.node.insert(nodes.node.end(), {draw(random, -3, 3), draw(random, -.3, 0),
                                             none ? 0 : draw(random, .05, .2), 0});
    }
    return nodes;
}

plait_lane_volume_params volume_params_of(const plait_lane_grid_params& grid) {
    plait_lane_volume_params params{};
    params.vertex_stride = grid.vertex_stride;
    params.tile = grid.tile;
    params.edge_count = grid.edge_count;
    params.voxel_edge = grid.voxel_edge;
    std::copy_n(grid.q, 4, params.q);
    std::copy_n(grid.t, 4, params.t);
    params.moves = 1;
    params.history = grid.history;
    return params;
}

// A tapered capsule, a box, a plane and a hull that move and turn, behind one that belongs to the substep
// before.
std::vector<float> colliders_among_nodes() {
    return {
        0, 0, 0, 9, 0, 0, 0, 9, 0, 0, 0, 9, 0, 0, 0, 9, 0, 0, 0, 1, 1, 0, 0, 0,
        //
        -.3f, -.1f, .1f, .25f, .4f, .3f, .2f, .08f, -.2f, 0, 0, .25f, .4f, .4f, .1f, .08f, .12f,
        -.24f, .16f, .9506840f, .3f, PLAIT_KIND_CAPSULE, 0, 0,
        //
        .1f, .1f, -.3f, .06f, .36f, -.48f, .64f, .48f, .15f, .1f, -.25f, .06f, .3f, .12f, .2f, 0,
        .12f, -.24f, .16f, .9506840f, .6f, PLAIT_KIND_BOX, 0, 0,
        //
        .1f, -.4f, .1f, 0, 0, 1, 0, 0, .1f, -.35f, .1f, 0, .48f, .64f, -.6f, 0, .3f, 0, .24f,
        .9233634f, .4f, PLAIT_KIND_PLANE, 0, 0,
        // hair stays inside of it: no node is
        .1f, .1f, -.1f, .06f, .36f, -.48f, .64f, .48f, .15f, .1f, -.05f, .06f, .5f, .4f, .6f, 0,
        .12f, -.24f, .16f, .9506840f, .6f, PLAIT_KIND_BOX + PLAIT_KIND_INWARD, 0, 0,
        // its faces are seven float4 further: after one of nothing, so that none lies where a row
        // has what is not read
        .3f, .35f, .2f, .02f, 0, .6f, 0, .8f, .35f, .3f, .2f, .02f, .26f, .3f, .15f, 0, 0, 0, .28f,
        .96f, .2f, PLAIT_KIND_HULL, 7, 5,
        //
        .5f, .5f, .5f, .5f, 0, 1, 0, .15f, .8660254f, -.5f, 0, .15f, -.8660254f, -.5f, 0, .15f, 0,
        0, 1, .15f, 0, 0, -1, .12f};
}

} // namespace plait::cases
