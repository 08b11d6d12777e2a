// wind_obstacle: in a canopy of hairs the wind dies away as du/dx = -sigma u (Cionco 1965), sigma in
// proportion to how much of them stands in a volume; solid bodies take all of it.
#include "backend/reference/base/stages.hpp"
#include "backend/reference/contact/collider.hpp"

#include <plait/constants.h>

namespace plait::reference {

void wind_obstacle(uint32_t item_count, const plait_wind_obstacle_params& params,
                   const wind_obstacle_args& args) {
    const uint32_t n = params.edge_count;
    const Pose pose{quat(params.q), vec3(params.t)};
    for (uint32_t item = 0; item < item_count; ++item) {
        const Vec3 cell(item % n, item / (n * n), item / n % n);
        const Vec3 x = pose.apply((cell + Vec3::Constant(0.5)) * params.voxel_edge);
        double extinction = params.extinction * args.grid_density[item];
        for (size_t index = 0; index < params.collider_count; ++index)
            if (const Collider collider = collider_at(args.collider, params.collider_first + index);
                !collider.inward && collider.surface(x).distance < 0)
                extinction = PLAIT_AIR_SOLID;
        if (params.meshes && args.mesh_solid[item].w() > 0)
            extinction = PLAIT_AIR_SOLID;
        args.wind_extinction[item] = extinction;
    }
}

} // namespace plait::reference
