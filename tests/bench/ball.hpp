// A ball of triangles with a tree over them, as mesh_nearest takes it.
#pragma once

#include <cstdint>
#include <vector>

namespace bench {

struct Ball {
    std::vector<float> vertices;                       // float4
    std::vector<uint32_t> triangle, tree, under, ring; // as the buffers are
    std::vector<float> box;
};

// An octahedron whose faces were cut into four `levels` times.
Ball make_ball(float radius, uint32_t levels);

} // namespace bench
