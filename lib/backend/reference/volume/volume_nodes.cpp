// volume_nodes: means of what volume_splat has summed up, and the rigid motion of the collider that
// holds a node, which of a mesh is known.
#include "backend/reference/contact/collider.hpp"
#include "backend/reference/grid/grid_sum.hpp"
#include "backend/reference/grid/volume.hpp"

namespace plait::reference {

void volume_nodes(uint32_t item_count, const plait_volume_nodes_params& params,
                  const volume_nodes_args& args) {
    const NodeGrid grid(params.edge_count);
    const Pose pose{quat(params.q), vec3(params.t)};
    for (size_t node = 0; node < item_count; ++node) {
        const Vec3 x = pose.apply(double(params.voxel_edge) * grid.centre(node));
        args.volume_solid[node] = params.meshes ? args.mesh_solid[node] : Vec4(Vec4::Zero());
        for (size_t i = 0; i < params.collider_count; ++i) {
            const Collider collider = collider_at(args.collider, params.collider_first + i);
            if (collider.inward || collider.surface(x).distance >= 0)
                continue;
            const Vec3 v = (x - collider.carried_from(x)) / double(params.h);
            args.volume_solid[node] = with_w(pose.q.conjugate() * v, 1);
        }
        const auto sum = [&](size_t which, double scale) {
            return double(load_sum(args.grid_sum, node * PLAIT_SUM_STRIDE + 2 * which)) / scale;
        };
        const double density = sum(0, PLAIT_SUM_DENSITY_SCALE);
        Vec3 v = Vec3::Zero();
        double rest = 0;
        if (density > 0) {
            for (size_t axis = 0; axis < 3; ++axis)
                v[static_cast<Eigen::Index>(axis)] =
                    sum(1 + axis, PLAIT_SUM_MOMENTUM_SCALE) / density;
            rest = sum(4, PLAIT_SUM_REST_SCALE) / density;
        }
        args.grid_density[node] = density;
        args.grid_velocity[node] = with_w(v, v.norm());
        args.volume_rest[node] = rest;
    }
}

} // namespace plait::reference
