// lane_carry: one rigid motion of all strands. The root, row 0 of both positions, is a place in the
// world; offsets from it and velocities only turn.
#include "backend/reference/base/lanes.hpp"

namespace plait::reference {

void lane_carry(uint32_t item_count, const plait_carry_params& params,
                const lane_carry_args& args) {
    const Pose motion{params.turns ? quat(params.q) : Quat::Identity(), vec3(params.t)};
    for (size_t slot = 0; slot < item_count; ++slot) {
        const Lane lane(slot, params.vertex_stride, params.tile);
        for (uint32_t i = 0; i < params.vertex_stride; ++i) {
            const auto carry = [&](const View<double>& x, const View<double>& v) {
                const Vec3 place = lane.vector(x, i);
                lane.store(x, i, i == 0 ? motion.apply(place) : Vec3(motion.q * place));
                lane.store(v, i, Vec3(motion.q * lane.vector(v, i)));
            };
            carry(args.lane_x, args.lane_v);
            if (params.history)
                carry(args.lane_x_before, args.lane_v_before);
            for (const auto* turns : {&args.lane_q, &args.lane_q_before})
                lane.store(*turns, i, motion.q * lane.rotation(*turns, i));
        }
    }
}

} // namespace plait::reference
