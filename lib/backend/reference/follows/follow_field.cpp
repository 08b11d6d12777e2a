// follow_field: follow strands out of meshes, by a grid of distances.
#include "backend/reference/follows/follow_out.hpp"
#include "backend/reference/mesh/field_sample.hpp"
#include "backend/reference/mesh/mesh_ways.hpp"

namespace plait::reference {

void follow_field(uint32_t item_count, const plait_follow_collide_params& params,
                  const follow_field_args& args) {
    for (size_t mesh = 0; mesh < params.collider_count; ++mesh) {
        const MeshField field(args, mesh);
        const MeshMotion motion(args.collider, params.collider_first + mesh);
        const auto gap_at = [&](const Vec3& x, double) -> std::optional<FollowGap> {
            const FieldSample sample = field.at(motion.pose.invert(x));
            if (!sample.gradient || !(sample.gradient->norm() > PLAIT_MESH_MIN_SLOPE))
                return {};
            return FollowGap{sample.distance, motion.pose.q * sample.gradient->normalized()};
        };
        leave_all(item_count, params, args.lane_strand, args.position, gap_at);
    }
}

} // namespace plait::reference
