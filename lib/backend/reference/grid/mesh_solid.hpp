// A mesh that bends over a substep, by its triangles, seen from a grid.
#pragma once

#include "backend/reference/mesh/mesh_ways.hpp"

#include <plait/constants.h>

#include <array>

namespace plait::reference {

template <typename Args> class MeshSolid {
  public:
    MeshSolid(const Args& args, size_t mesh, size_t collider)
        : args_(args), motion_(args.collider, collider) {
        triangle_ = args.mesh_first[mesh * PLAIT_MESH_FIRST_STRIDE + PLAIT_MESH_FIRST_TRIANGLE];
        vertex_ = args.mesh_first[mesh * PLAIT_MESH_FIRST_STRIDE + PLAIT_MESH_FIRST_VERTEX];
    }

    // In the world at the substep's end.
    std::array<Vec3, 3> corners(size_t triangle) const {
        std::array<Vec3, 3> all;
        for (size_t k = 0; k < 3; ++k)
            all[k] = motion_.pose.apply(own(triangle, k, motion_.end));
        return all;
    }
    // From the begin of the substep on, in the mean of the corners.
    Vec3 way(size_t triangle) const {
        Vec3 sum = Vec3::Zero();
        for (size_t k = 0; k < 3; ++k)
            sum += motion_.pose.apply(own(triangle, k, motion_.end)) -
                   motion_.carried_from(motion_.pose.apply(own(triangle, k, motion_.begin)));
        return sum / 3;
    }

  private:
    Vec3 own(size_t triangle, size_t k, double share) const {
        const size_t at =
            vertex_ + args_.mesh_triangle[(triangle_ + triangle) * PLAIT_MESH_TRIANGLE_STRIDE + k];
        const Vec3 from = xyz(args_.mesh_from[at]);
        return from + share * (xyz(args_.mesh_to[at]) - from);
    }

    const Args& args_;
    MeshMotion motion_;
    size_t triangle_, vertex_;
};

} // namespace plait::reference
