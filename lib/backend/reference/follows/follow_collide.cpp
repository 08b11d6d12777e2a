// follow_collide: follow strands out of colliders, one after another.
#include "backend/reference/contact/collider.hpp"
#include "backend/reference/follows/follow_out.hpp"

namespace plait::reference {

void follow_collide(uint32_t item_count, const plait_follow_collide_params& params,
                    const follow_collide_args& args) {
    for (size_t index = 0; index < params.collider_count; ++index) {
        const Collider collider = collider_at(args.collider, params.collider_first + index);
        leave_all(item_count, params, args.lane_strand, args.position, [&](const Vec3& x, double) {
            const Surface at = collider.surface(x);
            return std::optional(FollowGap{at.distance, at.normal});
        });
    }
}

} // namespace plait::reference
