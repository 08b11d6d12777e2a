#include "strand.hpp"

#include "references/modes.hpp"

#include <cmath>

namespace lab {

namespace {

// Chords of the given lengths on the helix of this curvature and torsion: each keeps the curve's
// turn about the axis and its share of the way along it. Axis along -z, starting at the origin.
std::vector<Vec3> helix(const Strand& strand, const std::vector<double>& lengths) {
    const double kappa = strand.curvature, tau = strand.torsion;
    const double turn = std::hypot(kappa, tau); // rad/m
    std::vector<Vec3> points{Vec3::Zero()};
    double angle = 0;
    for (const double l : lengths) {
        const double advance = turn > 0 ? l * tau / turn : l;
        const double across = std::sqrt(std::max(0.0, l * l - advance * advance));
        const double half = 0.5 * l * turn;
        // the chord of an arc from `angle` to `angle + 2 half` points at right angles to its middle
        const double middle = angle + half;
        points.push_back(points.back() +
                         Vec3(-across * std::sin(middle), -across * std::cos(middle), -advance));
        angle += 2 * half;
    }
    return points;
}

// Columns: `along`, what of `across` is at right angles to it, and their cross product.
Eigen::Matrix3d frame(const Vec3& along, const Vec3& across) {
    Eigen::Matrix3d m;
    m.col(0) = along;
    m.col(1) = (across - along * along.dot(across)).normalized();
    m.col(2) = m.col(0).cross(m.col(1));
    return m;
}

// From the frame of helix() to the strand's.
Quat aimed(const Strand& strand, const Vec3& first_chord) {
    const Vec3 axis(0, 0, -1);
    const double turn = std::hypot(strand.curvature, strand.torsion);
    Vec3 from = axis;
    if (strand.aim == Aim::segment)
        from = first_chord;
    else if (strand.aim == Aim::tangent && turn > 0) // of the curve, where it begins
        from = Vec3(0, -std::abs(strand.curvature) / turn, -strand.torsion / turn);
    if (strand.towards.isZero() || strand.curvature == 0)
        return turn_between(from, strand.direction);
    // Where the first curve's centre is, seen from where it is aimed.
    const Vec3 centre = axis.cross(strand.aim == Aim::tangent ? from : first_chord);
    return Quat(frame(strand.direction, strand.towards) * frame(from, centre).transpose());
}

std::vector<Vec3> bent_into_mode(const Strand& strand, uint32_t pinned, bool half_tip) {
    const HangingChain chain{strand.segment_lengths(), pinned, half_tip, 0};
    const Eigen::VectorXd shape = chain.modes(1).col(strand.mode - 1);
    const Vec3 side = strand.direction.unitOrthogonal();
    std::vector<Vec3> points{strand.root};
    double before = 0;
    for (uint32_t i = 0; i < strand.segments; ++i) {
        const double l = chain.lengths[i];
        const double aside =
            strand.amplitude * strand.length * shape[i + 1] / shape[strand.segments];
        const double across = aside - before;
        const double along = std::sqrt(std::max(0.0, l * l - across * across));
        points.push_back(points.back() + along * strand.direction + across * side);
        before = aside;
    }
    return points;
}

} // namespace

std::vector<double> Strand::segment_lengths() const {
    std::vector<double> lengths;
    if (!points.empty()) {
        for (size_t i = 0; i + 1 < points.size(); ++i)
            lengths.push_back((points[i + 1] - points[i]).norm());
        return lengths;
    }
    double sum = 0;
    for (uint32_t i = 0; i < segments; ++i) {
        const double share = segments > 1 ? static_cast<double>(i) / (segments - 1) : 0.0;
        lengths.push_back(std::pow(segment_ratio, share));
        sum += lengths.back();
    }
    for (double& l : lengths)
        l *= length / sum;
    return lengths;
}

std::vector<Vec3> rest_shape(const Strand& strand, uint32_t pinned, bool half_tip) {
    if (!strand.points.empty())
        return strand.points;
    if (strand.mode > 0 && strand.mode + pinned <= strand.segments + 1) // as many as are free
        return bent_into_mode(strand, pinned, half_tip);
    std::vector<Vec3> points = helix(strand, strand.segment_lengths());
    const Quat turn = Eigen::AngleAxisd(strand.roll * pi / 180, strand.direction) *
                      aimed(strand, points[1].normalized());
    for (Vec3& point : points)
        point = strand.root + turn * point;
    return points;
}

} // namespace lab
