// lane_orient: where a segment is more than a degree off its director, all of the strand's
// orientations are turned to their segments: B_i q_i, B_i = turn(B_(i-1) t_i -> e_i) B_(i-1). Or those of
// the substep before are turned from the present ones as the segments are.
#include "backend/reference/base/lanes.hpp"

namespace plait::reference {
namespace {

constexpr double askew = 0.9998477; // cos 1 degree

Vec3 segment(const View<const double>& x, const Lane& lane, uint32_t i) {
    return lane.vector(x, i + 1) - (i > 0 ? lane.vector(x, i) : Vec3(Vec3::Zero()));
}

Vec3 director(const Quat& q) {
    return q * Vec3::UnitX();
}

bool is_askew(const lane_orient_args& args, const Lane& lane, uint32_t segments) {
    for (uint32_t i = 0; i < segments; ++i) {
        const Vec3 e = segment(args.lane_x, lane, i);
        if (director(lane.rotation(args.lane_q, i)).dot(e) < askew * e.norm())
            return true;
    }
    return false;
}

void orient_before(const lane_orient_args& args, const Lane& lane, uint32_t segments) {
    constexpr double otherwise = 1e-8; // in square, of a director: more than a caller's rounding
    for (uint32_t i = 0; i < segments; ++i) {
        const Quat back = turn(segment(args.lane_x, lane, i), segment(args.lane_x_before, lane, i));
        const Quat q = (back * lane.rotation(args.lane_q, i)).normalized();
        if ((director(q) - director(lane.rotation(args.lane_q_before, i))).squaredNorm() >
            otherwise)
            lane.store(args.lane_q_before, i, q);
    }
}

} // namespace

void lane_orient(uint32_t item_count, const plait_lane_orient_params& params,
                 const lane_orient_args& args) {
    const uint32_t segments = params.vertex_stride - 1;
    for (size_t slot = 0; slot < item_count; ++slot) {
        const Lane lane(slot, params.vertex_stride, params.tile);
        if (params.before) {
            orient_before(args, lane, segments);
            continue;
        }
        if (!is_askew(args, lane, segments))
            continue;
        Quat bend = Quat::Identity();
        for (uint32_t i = 0; i <= segments; ++i) {
            if (i < segments) {
                const Vec3 e = segment(args.lane_x, lane, i);
                if (e.norm() > 0)
                    bend = (turn(bend * director(lane.rotation(args.lane_q, i)), e) * bend)
                               .normalized();
            }
            for (const auto* q : {&args.lane_q, &args.lane_q_before})
                lane.store(*q, i, Quat((bend * lane.rotation(*q, i)).normalized()));
        }
    }
}

} // namespace plait::reference
