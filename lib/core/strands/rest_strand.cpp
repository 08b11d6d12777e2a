#include "core/strands/rest_strand.hpp"

#include "core/base/turn.hpp"

#include <algorithm>

namespace plait {
namespace {

constexpr double allowed_stretch = 0.01;    // where EA is not given,
constexpr double allowed_at = 10 * 9.80665; // at this acceleration, m/s^2

// EA such that the strand's own weight at 10 g stretches it by 1 % at the root.
double stretch_stiffness(const Material& material, double length) {
    if (material.stretch_stiffness > 0)
        return double(material.stretch_stiffness);
    const double mean_density = double(material.line_density) * material.density.mean();
    return mean_density * length * allowed_at / allowed_stretch;
}

} // namespace

double Ramp::at(double share) const {
    const double place = std::clamp(3 * share, 0.0, 3.0);
    const size_t before = std::min(static_cast<size_t>(place), size_t{2});
    return knots[before] + (place - double(before)) * (knots[before + 1] - knots[before]);
}

RestStrand::RestStrand(std::span<const float> positions, const Material& material,
                       std::pmr::memory_resource* memory)
    : x(memory), length(memory), stretch(memory), bend(memory), frame(memory), rest(memory),
      mass(memory) {
    for (size_t i = 0; i < positions.size(); i += 3)
        x.emplace_back(positions[i], positions[i + 1], positions[i + 2]);
    for (size_t i = 0; i + 1 < x.size(); ++i) {
        length.push_back(edge(i).norm());
        whole += length[i];
    }
    const double EA = stretch_stiffness(material, whole);
    const double EI = double(material.bend_stiffness);
    twist = EI > 0 && material.twist_stiffness > 0 ? double(material.twist_stiffness) / EI : 1;
    cross = double(material.section_ratio);
    double before = 0, along = 0, mass_before = 0;
    for (size_t i = 0; i < segments(); ++i) {
        const double own_mass = double(material.line_density) * length[i] *
                                material.density.at((along + 0.5 * length[i]) / whole);
        // the clamp is a joint of half the first segment
        const double joint = 0.5 * (before + length[i]);
        stretch.push_back(EA / length[i]);
        bend.push_back(4 * EI * material.stiffness.at(along / whole) / joint);
        mass.push_back(0.5 * (mass_before + own_mass));
        along += length[i];
        before = length[i];
        mass_before = own_mass;
    }
    bend.front() *= double(material.clamp);
    mass.push_back(0.5 * mass_before);
    set_frames();
    if (cross != 1) {
        roll = curl_direction();
        set_frames();
    }
}

double RestStrand::hair_of(size_t vertex) const {
    const double before = vertex > 0 ? edge(vertex - 1).norm() : 0;
    const double after = vertex < segments() ? edge(vertex).norm() : 0;
    return 0.5 * (before + after);
}

void RestStrand::set_frames() {
    frame.resize(segments());
    rest.resize(segments());
    for (size_t i = 0; i < segments(); ++i) {
        frame_along(i, edge(i));
        rest[i] = frame_before(i).conjugate() * frame[i];
    }
}

void RestStrand::frame_along(size_t segment, const Vec3& direction) {
    Quat from = frame_before(segment);
    if (segment == 0)
        from = Eigen::AngleAxisd(roll, Vec3::UnitX());
    frame[segment] = (turn(from * Vec3::UnitX(), direction) * from).normalized();
}

void RestStrand::scale_curl(double by) {
    for (size_t i = 1; i < segments(); ++i) {
        const Eigen::AngleAxisd turn(rest[i]);
        rest[i] = Quat(Eigen::AngleAxisd(by * turn.angle(), turn.axis()));
    }
}

// Angle from y towards z of the axis about which the strand bends most: that of the larger
// eigenvalue of the sum of c c', c the turn of each joint but the clamp.
double RestStrand::curl_direction() const {
    double yy = 0, zz = 0, yz = 0;
    for (size_t i = 1; i < segments(); ++i) {
        const double y = rest[i].y(), z = rest[i].z();
        yy += y * y;
        zz += z * z;
        yz += y * z;
    }
    return 0.5 * std::atan2(2 * yz, yy - zz);
}

} // namespace plait
