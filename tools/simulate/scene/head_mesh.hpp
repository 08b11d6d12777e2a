// The mesh under the hair: the generated mannequin, or a file.
#pragma once

#include <plait/plait.h>

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace simulate {

struct HeadMesh {
    std::vector<Eigen::Vector3f> vertices; // m
    std::vector<std::array<uint32_t, 3>> triangles;
    std::vector<float> scalp; // [vertices]: 1 where hair grows, 0 where none does; or none
};

HeadMesh mannequin();

// What the generated styles `ball` and `fur` lie on; hair covers all of it in the latter.
HeadMesh ball(bool fur);

// `scalp` of vertices in the mannequin's space.
std::vector<float> scalp_of(const std::vector<Eigen::Vector3f>& vertices);

// As it is at rest, without a scalp.
HeadMesh shape_of(const plait_mesh* mesh);

// .tfxmesh, or whatever assimp reads. Throws Failure.
HeadMesh load_head(const std::string& file, float scale);

} // namespace simulate
