#include "inputs.hpp"

#include <algorithm>
#include <cmath>

namespace plait::cases {
namespace {

constexpr uint32_t meshes = 2, leaf = 4;

// Triangles any way about, and a tree over them in the order they have.
struct Trees {
    std::vector<uint32_t> first, under, triangle;
    std::vector<float> from, to, way, box;

    void add(Random& random, uint32_t triangles, uint32_t vertices) {
        const auto node = static_cast<uint32_t>(under.size() / PLAIT_MESH_UNDER_STRIDE);
        for (const uint32_t word :
             {node, static_cast<uint32_t>(triangle.size() / PLAIT_MESH_TRIANGLE_STRIDE),
              static_cast<uint32_t>(from.size() / 4), 0u, 0u, triangles})
            first.push_back(word);
        for (uint32_t t = 0; t < triangles; ++t) {
            for (int k = 0; k < 3; ++k)
                triangle.push_back(random.below(vertices));
            for (int k = 0; k < 3; ++k)
                triangle.push_back(PLAIT_MESH_NO_TRIANGLE);
        }
        for (uint32_t i = 0; i < vertices; ++i) {
            for (int k = 0; k < 3; ++k) {
                from.push_back(static_cast<float>(random.uniform(-1, 1)));
                to.push_back(from.back() + static_cast<float>(random.uniform(-0.1, 0.1)));
            }
            from.push_back(0);
            to.push_back(0);
        }
        add_node(0, triangles);
    }

  private:
    uint32_t add_node(uint32_t begin, uint32_t end) {
        const size_t at = under.size();
        for (const uint32_t word : {begin, end - begin, 1u})
            under.push_back(word);
        if (end - begin > leaf) {
            const uint32_t middle = (begin + end) / 2;
            under[at + 2] += add_node(begin, middle);
            under[at + 2] += add_node(middle, end);
        }
        return under[at + 2];
    }
};

// Of the second mesh. `least` > 0: the boxes of lesser nodes are there, some boxes or other.
Setup make(uint32_t triangles, uint32_t least, uint32_t most) {
    Random random(triangles + least);
    Trees trees;
    trees.add(random, 13, 20);
    trees.add(random, triangles, 2 * triangles + 3);
    const size_t nodes = trees.under.size() / PLAIT_MESH_UNDER_STRIDE;
    for (size_t node = 0; node < nodes; ++node) {
        for (const double side : {-1.0, 1.0})
            for (int k = 0; k < 4; ++k)
                trees.box.push_back(k == 3 ? 0.0f
                                           : static_cast<float>(side * random.uniform(0.1, 1)));
        trees.way.push_back(static_cast<float>(random.uniform(0.01, 0.1)));
    }
    Setup setup;
    setup.name = std::to_string(triangles) + " triangles, nodes of " + std::to_string(least + 1) +
                 " to " + std::to_string(most);
    setup.items =
        static_cast<uint32_t>(nodes) - trees.first[PLAIT_MESH_FIRST_STRIDE + PLAIT_MESH_FIRST_NODE];
    setup.buffers = {uints(trees.first),  uints(trees.under),      uints(trees.triangle),
                     float4s(trees.from), float4s(trees.to),       floats(trees.way),
                     float4s(trees.box),  unwritten_floats(meshes)};
    return setup.with(plait_mesh_refit_params{1, least, most});
}

} // namespace

// Within a metre of the origin.
Case mesh_refit_case() {
    Case result = {PLAIT_STAGE_mesh_refit,
                   {},
                   {{"mesh_box", 1e-6}, {"mesh_way", 1e-6}, {"mesh_bends", 1e-6}},
                   {"mesh_bends"}};
    for (const uint32_t triangles : {1u, 30u, 300u}) {
        result.setups.push_back(make(triangles, 0, 32));
        result.setups.push_back(make(triangles, 8, 64));
        result.setups.push_back(make(triangles, 32, 1024));
    }
    return result;
}

} // namespace plait::cases
