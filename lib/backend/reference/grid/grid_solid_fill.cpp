// grid_solid_fill: the nodes before which a mesh has passed an odd number of times along their row.
#include "backend/reference/grid/mesh_solid.hpp"
#include "backend/reference/grid/volume.hpp"

namespace plait::reference {

void grid_solid_fill(uint32_t item_count, const plait_grid_solid_fill_params& params,
                     const grid_solid_fill_args& args) {
    const Quat turn = quat(params.q);
    const MeshSolid mesh(args, params.mesh, params.collider_first);
    for (size_t row = 0; row < item_count; ++row) {
        bool inside = false;
        for (size_t i = 0; i < params.edge_count; ++i) {
            const size_t node = row * params.edge_count + i;
            inside = inside != ((args.mesh_passed[node / 32] >> node % 32 & 1) != 0);
            if (inside) {
                const uint32_t met = args.mesh_met[node];
                const Vec3 way = met > 0 ? mesh.way(met - 1) : Vec3(Vec3::Zero());
                args.mesh_solid[node] = with_w(turn.conjugate() * way / double(params.h), 1);
            } else if (!params.others) {
                args.mesh_solid[node] = Vec4::Zero();
            }
        }
    }
}

} // namespace plait::reference
