// articulated: Newton's method on the rod's potential over the turns w_i of the segments alone:
// vertices are x_{i+1} = x_i + l_i t_i, so that lengths hold whatever the solve finds. Here the
// system is assembled and solved densely,
//   H = J' M J + joints + tension + eps I,   g = -J' f - moments,
// J the derivative of the vertices by the turns, column i of vertex j > i being -l_i [t_i]x; M and
// f inertia, pins and contact of the vertices. A joint whose turn from q_i to p_i = q_{i-1} r_i has
// the scalar part c0 and the vector part e adds, with N = c0 I + [e]x and k = kb/4,
//   K to (i, i),  -K N' to (i, i-1),  N K N' + k e e' to (i-1, i-1),
// K = k I + diag(kt, 0, kc)/4 in its axes. Of a round joint these are the second derivatives but
// for (1 - c0) k on the diagonal, which keeps them positive. Tension: max(0, P.t) l (I - t t'), P
// the force on all that hangs on the segment. Source: docs/models/articulated.md.
#include "backend/reference/strands/rod_model.hpp"

#include <plait/constants.h>

#include <algorithm>
#include <limits>

namespace plait::reference {
namespace {

Mat3 cross_matrix(const Vec3& t) {
    Mat3 m;
    m << 0, -t.z(), t.y(), t.z(), 0, -t.x(), -t.y(), t.x(), 0;
    return m;
}

Quat turned_towards(const Quat& q, const Vec3& direction) {
    return (turn(q * Vec3::UnitX(), direction) * q).normalized();
}

// What Newton's step turns by need not be an exact rotation vector.
Quat turned(const Quat& q, const Vec3& w) {
    return (Quat(1, w.x() / 2, w.y() / 2, w.z() / 2) * q).normalized();
}

Vec3 unit_or(const Vec3& v, const Vec3& instead) {
    const double length = v.norm();
    return length > 1e-30 ? Vec3(v / length) : instead;
}

} // namespace

void RodModel::rebuild() {
    x[0].setZero();
    for (size_t i = 0; i < segments(); ++i)
        x[i + 1] = x[i] + length_[i] * director(i);
}

// The substep's begin as it is stored, where something else moved vertices along their segments.
void RodModel::load() {
    const std::vector<Vec3> start = motion_.relative_start();
    q = q_start_;
    for (size_t i = 0; i < segments(); ++i) {
        const Vec3 along = unit_or(start[i + 1] - start[i], director(i));
        if ((along - director(i)).squaredNorm() > PLAIT_ARTICULATED_MISALIGNED)
            q[i] = turned_towards(q[i], along);
    }
    rebuild();
}

// Every segment towards where inertia takes its end, or to the place above that on the surface to which
// it is pressed, if that is lower.
void RodModel::follow_target() {
    const double stays = energy();
    const RodModel from = *this;
    for (size_t i = 0; i < segments(); ++i) {
        const Vec3 goal = motion_.goal(i + 1, mass_[i + 1]);
        turn_to(i, contacts_ ? contacts_->lifted(i + 1, goal) : goal);
    }
    if (!(energy() <= stays * (1 + PLAIT_ARTICULATED_POTENTIAL_RISE)))
        *this = from;
}

// J' M J, -J' f and the tension; the force on what hangs on a segment comes from the tip on.
void RodModel::add_vertices(Eigen::MatrixXd& H, Eigen::VectorXd& g) const {
    const Eigen::Index n = g.size() / 3;
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(3 * n, 3 * n), MJ = J;
    Eigen::VectorXd f(3 * n);
    for (Eigen::Index j = 0; j < n; ++j) { // of vertex j + 1
        const auto vertex = static_cast<size_t>(j) + 1;
        Mat3 M = vertex_stiffness(vertex) * Mat3::Identity();
        Vec3 force = vertex_force(vertex);
        if (contacts_) {
            M += contacts_->hessian(vertex, x[vertex]);
            force += contacts_->force(vertex, x[vertex]);
        }
        for (Eigen::Index i = 0; i <= j; ++i) {
            const auto segment = static_cast<size_t>(i);
            J.block<3, 3>(3 * j, 3 * i) = -length_[segment] * cross_matrix(director(segment));
        }
        MJ.middleRows<3>(3 * j) = M * J.middleRows<3>(3 * j);
        f.segment<3>(3 * j) = force;
    }
    H += J.transpose() * MJ;
    g -= J.transpose() * f;
    Vec3 pull = Vec3::Zero();
    for (Eigen::Index i = n - 1; i >= 0; --i) {
        const auto segment = static_cast<size_t>(i);
        pull += f.segment<3>(3 * i);
        const Vec3 t = director(segment);
        const double length = length_[segment];
        H.block<3, 3>(3 * i, 3 * i) +=
            std::max(0.0, pull.dot(t)) * length * (Mat3::Identity() - t * t.transpose());
        H.block<3, 3>(3 * i, 3 * i) += PLAIT_ARTICULATED_TWIST * mass_[segment + 1] *
                                       motion_.inertia * length * length * Mat3::Identity();
    }
}

void RodModel::add_joints(Eigen::MatrixXd& H, Eigen::VectorXd& g) const {
    for (Eigen::Index i = 0; i < g.size(); i += 3) {
        const auto segment = static_cast<size_t>(i / 3);
        const Eigen::Index p = i - 3;
        const Quat r = expected(segment) * q[segment].conjugate();
        const double side = std::copysign(1.0, r.w()), c0 = side * r.w();
        const Vec3 e = side * r.vec();
        const double k = bend_[segment] / 4;
        const Mat3 axes = expected(segment).toRotationMatrix();
        const Mat3 K =
            k * Mat3::Identity() + axes * section_[segment].asDiagonal() * axes.transpose() / 4;
        const Mat3 N = c0 * Mat3::Identity() + cross_matrix(e);
        // (u, u.w) turns from expected to q; the section's energy is u.ku/2.
        const Quat u = bent(segment);
        const Vec3 ku = section_[segment].cwiseProduct(u.vec());
        const Vec3 moment = 2 * k * e - axes * (u.w() * ku + u.vec().cross(ku)) / 2;
        H.block<3, 3>(i, i) += K;
        g.segment<3>(i) -= moment;
        if (segment == 0)
            continue;
        H.block<3, 3>(i, p) -= K * N.transpose();
        H.block<3, 3>(p, i) -= N * K;
        H.block<3, 3>(p, p) += N * K * N.transpose() + k * e * e.transpose();
        g.segment<3>(p) += moment;
    }
}

// Past the tip nothing turns; with rows for it the factors of the others would round otherwise. Those tipward of a
// segment that turns by `most` take what is best then.
Eigen::VectorXd RodModel::turns(double most) const {
    const auto own =
        3 * std::count_if(length_.begin(), length_.end(), [](double l) { return l > 0; });
    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(own, own);
    Eigen::VectorXd g = Eigen::VectorXd::Zero(own);
    add_vertices(H, g);
    add_joints(H, g);
    H.triangularView<Eigen::StrictlyUpper>() = H.transpose();
    Eigen::VectorXd w = Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(segments()));
    w.head(own) = H.ldlt().solve(-g);
    for (Eigen::Index i = 0; i < own; i += 3) {
        const double size = w.segment<3>(i).norm();
        if (size <= most)
            continue;
        w.segment<3>(i) *= most / size;
        const Eigen::Index rest = own - i - 3;
        if (rest > 0)
            w.segment(i + 3, rest) =
                H.bottomRightCorner(rest, rest)
                    .ldlt()
                    .solve(-g.tail(rest) - H.bottomLeftCorner(rest, i + 3) * w.head(i + 3));
    }
    return w;
}

// Its end goes towards a place; past the tip there is no direction.
void RodModel::turn_to(size_t segment, const Vec3& place) {
    const Vec3 along = unit_or(place - x[segment], director(segment));
    if (length_[segment] > 0)
        q[segment] = turned_towards(q[segment], along);
    x[segment + 1] = x[segment] + length_[segment] * along;
}

// Where a step would put the segment's end, or where contact leaves it.
void RodModel::place(size_t segment, const Vec3& end, ContactPlacer* placer) {
    if (!placer)
        return turn_to(segment, end);
    const size_t vertex = segment + 1;
    const Vec3 to = placer->place(vertex, contacts_->within(vertex, end));
    const Vec3 along = unit_or(to - x[segment], director(segment));
    const Vec3 left = x[segment] + length_[segment] * along;
    const Vec3 kept = placer->left(vertex, to, x[segment], left);
    turn_to(segment, kept == left ? to : kept);
}

// Turns alone would leave errors of second order that add up along the strand as false velocity:
// every segment goes along where the linear step puts its end.
void RodModel::follow_turns(const RodModel& from, const Eigen::VectorXd& w, ContactPlacer* placer) {
    Vec3 d = Vec3::Zero();
    for (size_t i = 0; i < segments(); ++i) {
        const Vec3 turn = w.segment<3>(3 * static_cast<Eigen::Index>(i));
        d += length_[i] * turn.cross(from.director(i));
        q[i] = turned(from.q[i], turn);
        place(i, from.x[i + 1] + d, placer);
    }
}

// Less of the turns.
void RodModel::follow_less(const RodModel& from, const Eigen::VectorXd& w, double share,
                           ContactPlacer* placer) {
    for (size_t i = 0; i < segments(); ++i) {
        q[i] = turned(from.q[i], share * w.segment<3>(3 * static_cast<Eigen::Index>(i)));
        place(i, x[i] + length_[i] * director(i), placer);
    }
}

void RodModel::turn_segments(ContactPlacer* placer) {
    const double before = energy();
    const double limit = before + std::abs(before) * PLAIT_ARTICULATED_POTENTIAL_RISE +
                         PLAIT_ARTICULATED_POTENTIAL_MIN;
    const auto rose = [&] { // what is placed has another potential than the step had
        return !(energy() <= (touched() ? std::numeric_limits<double>::max() : limit));
    };
    const RodModel from = *this;
    const Eigen::VectorXd w = turns(touched() ? PLAIT_CONTACT_MAX_TURN : INFINITY);
    follow_turns(from, w, placer);
    if (placer)
        placer->placed();
    if (touched() && rose())
        placer->fail();
    double share = 1;
    for (int trial = 0; trial < PLAIT_ARTICULATED_SHORTER_STEPS && rose(); ++trial) {
        share *= PLAIT_ARTICULATED_SHORTEN;
        follow_less(from, w, share, placer);
        if (placer)
            placer->placed();
    }
    if (rose())
        *this = from;
}

// Beyond those that every strand takes: one for what slides, another one for what that turned back, and more
// while the strand is deep in a body.
bool RodModel::wants_step(uint32_t k, const ContactPlacer* placer) const {
    if (k < PLAIT_ARTICULATED_PIN_STEPS && off_pin())
        return true;
    if (!placer)
        return false;
    if (k == 0 || (k < PLAIT_CONTACT_MAX_STEPS && placer->deep()))
        return true;
    return !contacts_->of_strands() &&
           ((k == 1 && placer->slips() && placer->pressed()) || (k == 2 && placer->back()));
}

void RodModel::articulate(uint32_t steps, const std::vector<double>& force) {
    load();
    std::optional<ContactPlacer> contact;
    if (contacts_) {
        std::vector<Vec3> y;
        for (size_t i = 0; i < x.size(); ++i)
            y.push_back(motion_.goal(i, mass_[i]));
        contacts_->aim(std::move(y));
        contact.emplace(*contacts_, force);
    }
    ContactPlacer* placer = contact ? &*contact : nullptr;
    follow_target();
    for (uint32_t k = 0; k < steps || wants_step(k, placer); ++k) {
        if (placer && k > 0)
            placer->press(x);
        turn_segments(placer);
    }
}

void articulated(uint32_t item_count, const plait_lane_params& params,
                 const articulated_args& args) {
    const RodBuffers buffers{args.lane_strand,
                             args.rest,
                             args.pose,
                             args.lane_material,
                             args.lane_rest,
                             args.collider,
                             args.lane_q,
                             args.lane_q_before,
                             {args.lane_x, args.lane_v, args.lane_x_before, args.lane_v_before,
                              args.lane_material, args.lane_acceleration, args.lane_pin,
                              args.lane_plane},
                             args.lane_normal_force,
                             args.lane_hollow};
    for (size_t slot = 0; slot < item_count; ++slot) {
        RodModel rod(buffers, params, slot);
        const Lane lane(slot, params.vertex_stride, params.tile);
        std::vector<double> force;
        for (uint32_t i = 0; i < params.vertex_stride; ++i)
            force.push_back(args.lane_normal_force[lane.index(i, 0, 1)]);
        rod.articulate(params.iterations, force);
        rod.store(buffers);
    }
}

} // namespace plait::reference
