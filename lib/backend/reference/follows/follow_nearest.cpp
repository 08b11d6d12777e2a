// follow_nearest: follow strands out of meshes that bend, by the nearest triangle; not of sheets.
#include "backend/reference/follows/follow_out.hpp"
#include "backend/reference/mesh/mesh_surface.hpp"
#include "backend/reference/mesh/mesh_ways.hpp"

namespace plait::reference {

void follow_nearest(uint32_t item_count, const plait_follow_collide_params& params,
                    const follow_nearest_args& args) {
    for (size_t mesh = 0; mesh < params.collider_count; ++mesh) {
        const MeshSurface surface(args, mesh);
        const MeshMotion motion(args.collider, params.collider_first + mesh);
        if (surface.two_sided)
            continue;
        const auto gap_at = [&](const Vec3& x, double bound) -> std::optional<FollowGap> {
            const auto sample = surface.at(motion.pose.invert(x), motion.end, bound);
            if (!sample)
                return {};
            return FollowGap{sample->distance, motion.pose.q * sample->normal};
        };
        leave_all(item_count, params, args.lane_strand, args.position, gap_at);
    }
}

} // namespace plait::reference
