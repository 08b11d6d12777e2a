// mesh_take: the places that the caller gives, but for those that are none.
#include "backend/reference/base/math.hpp"
#include "backend/reference/base/stages.hpp"

#include <cmath>

namespace plait::reference {

void mesh_take(uint32_t item_count, const plait_mesh_take_params& params,
               const mesh_take_args& args) {
    for (size_t vertex = 0; vertex < item_count; ++vertex) {
        Vec3 place = xyz(args.mesh_at[vertex]);
        Vec3 given;
        for (size_t k = 0; k < 3; ++k)
            given[static_cast<Eigen::Index>(k)] = args.mesh_taken[vertex * params.words + k];
        if (given.allFinite() && given.cwiseAbs().maxCoeff() <= double{PLAIT_MESH_MOST_COORDINATE})
            place = double(params.scale) * given;
        args.mesh_target[vertex] = with_w(place, 0);
    }
}

} // namespace plait::reference
