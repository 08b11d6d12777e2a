// mesh_advance: x_from' = x_to, x_to' = x_at + part (x_target - x_at), both in the groom's units.
#include "backend/reference/base/math.hpp"
#include "backend/reference/base/stages.hpp"

namespace plait::reference {

void mesh_advance(uint32_t item_count, const plait_mesh_advance_params& params,
                  const mesh_advance_args& args) {
    for (size_t item = 0; item < item_count; ++item) {
        const size_t vertex = params.begins + item;
        const Vec4 at = double(params.at_scale) * Vec4(args.mesh_at[item]);
        const Vec4 target = double(params.target_scale) * Vec4(args.mesh_target[item]);
        args.mesh_from[vertex] = args.mesh_to[vertex];
        args.mesh_to[vertex] = at + double(params.part) * (target - at);
    }
}

} // namespace plait::reference
