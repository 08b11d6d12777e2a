// grid_solid_field: the nodes whose distance to a mesh, by its grid of distances, is negative, and the rigid
// motion of that mesh.
#include "backend/reference/grid/volume.hpp"
#include "backend/reference/mesh/field_sample.hpp"
#include "backend/reference/mesh/mesh_ways.hpp"

namespace plait::reference {

void grid_solid_field(uint32_t item_count, const plait_grid_solid_field_params& params,
                      const grid_solid_field_args& args) {
    const NodeGrid grid(params.edge_count);
    const Pose pose{quat(params.q), vec3(params.t)};
    for (size_t node = 0; node < size_t{item_count} * params.edge_count; ++node) {
        const Vec3 x = pose.apply(params.voxel_edge * grid.centre(node));
        args.mesh_solid[node] = Vec4::Zero();
        for (size_t mesh = 0; mesh < params.collider_count; ++mesh) {
            const MeshField field(args, mesh);
            const MeshMotion motion(args.collider, params.collider_first + mesh);
            if (!(field.at(motion.pose.invert(x)).distance < 0))
                continue;
            const Vec3 v = (x - motion.carried_from(x)) / double(params.h);
            args.mesh_solid[node] = with_w(pose.q.conjugate() * v, 1);
        }
    }
}

} // namespace plait::reference
