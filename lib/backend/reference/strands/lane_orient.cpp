// lane_orient: where a segment is more than a degree off its director, all of the strand's
// orientations are turned to their segments: B_i q_i, B_i = turn(B_(i-1) t_i -> e_i) B_(i-1), and then about
// them to where the joints hold least. Or those of the substep before are turned from the present ones
// as the segments are.
#include "backend/reference/base/lanes.hpp"

namespace plait::reference {
namespace {

constexpr double askew = 0.9998477; // cos 1 degree
constexpr int steps = 4;

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

Quat about(const Vec3& axis, double angle) {
    const Vec3 w = axis * (angle / 2);
    return Quat(1, w.x(), w.y(), w.z()).normalized();
}

// A joint of a rod between what it expects of a segment and the segment: the torque on that, and the
// stiffness against its turn v_after - N v_before.
struct Joint {
    double bend;
    Eigen::Matrix3d section;
    Vec3 torque;
    Eigen::Matrix3d N;
};

Joint joint_of(const lane_orient_args& args, const Lane& lane, uint32_t i, const Quat& expected,
               const Quat& q) {
    const auto material = [&](size_t component) {
        return args.lane_material[lane.index(i, component, PLAIT_LANE_MATERIAL_COMPONENTS)];
    };
    const Vec3 k(material(PLAIT_LANE_TWIST), 0, material(PLAIT_LANE_CROSS));
    const Eigen::Matrix3d axes = expected.toRotationMatrix();
    const Quat bent = expected.conjugate() * q;
    const Vec3 u = bent.vec(), g = k.cwiseProduct(u);
    Quat r = expected * q.conjugate();
    if (std::signbit(r.w()))
        r.coeffs() *= -1;
    Joint joint;
    joint.bend = material(PLAIT_LANE_BEND) / 4;
    joint.section = axes * Eigen::Matrix3d((k / 4).asDiagonal()) * axes.transpose();
    joint.torque = 2 * joint.bend * r.vec() - axes * (bent.w() * g + u.cross(g)) / 2;
    for (int c = 0; c < 3; ++c)
        joint.N.col(c) = r.w() * Vec3::Unit(c) + Vec3::Unit(c).cross(r.vec());
    return joint;
}

// H x = g for a symmetric tridiagonal H, by elimination.
std::vector<double> solved(std::vector<double> diagonal, const std::vector<double>& beside,
                           std::vector<double> g) {
    for (size_t i = 0; i < g.size(); ++i) {
        if (i > 0) {
            const double share = beside[i] / diagonal[i - 1];
            diagonal[i] -= share * beside[i];
            g[i] -= share * g[i - 1];
        }
        if (!(diagonal[i] > 0)) // past the tip
            diagonal[i] = 1;
    }
    for (size_t i = g.size(); i-- > 0;)
        g[i] = (g[i] - (i + 1 < g.size() ? beside[i + 1] * g[i + 1] : 0)) / diagonal[i];
    return g;
}

// One Newton step of the turns of all segments, each about itself.
void untwist(const lane_orient_args& args, const Lane& lane, uint32_t segments, const Quat& frame) {
    std::vector<double> diagonal(segments), beside(segments), g(segments);
    for (uint32_t i = 0; i < segments; ++i) {
        const Quat q = lane.rotation(args.lane_q, i);
        const Quat before = i > 0 ? lane.rotation(args.lane_q, i - 1) : frame;
        const Joint joint = joint_of(args, lane, i, before * lane.rotation(args.lane_rest, i), q);
        const Vec3 t = director(q), s = director(before), n = joint.N * s;
        diagonal[i] += joint.bend + t.dot(joint.section * t);
        g[i] += joint.torque.dot(t);
        if (i == 0)
            continue;
        diagonal[i - 1] += joint.bend + n.dot(joint.section * n);
        beside[i] = -joint.bend * t.dot(n) - t.dot(joint.section * n);
        g[i - 1] -= joint.torque.dot(s);
    }
    const std::vector<double> angles = solved(diagonal, beside, g);
    for (uint32_t i = 0; i < segments; ++i) {
        const Quat turned = about(director(lane.rotation(args.lane_q, i)), angles[i]);
        for (const auto* q : {&args.lane_q, &args.lane_q_before})
            lane.store(*q, i, Quat((turned * lane.rotation(*q, i)).normalized()));
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
        const Quat frame = pose_of(args.pose, strand_of(args.lane_strand, slot)).q;
        for (int k = 0; k < steps; ++k)
            untwist(args, lane, segments, frame);
    }
}

} // namespace plait::reference
