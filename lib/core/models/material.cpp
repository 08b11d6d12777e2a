#include "core/models/material.hpp"

#include <plait/params.h>

#include <Eigen/Geometry>

namespace plait {
namespace {

using Vec3 = Eigen::Vector3d;
using Quat = Eigen::Quaterniond;

constexpr double allowed_stretch = 0.01;    // where EA is not given,
constexpr double allowed_at = 10 * 9.80665; // at this acceleration, m/s^2
constexpr size_t components = PLAIT_LANE_MATERIAL_COMPONENTS;

Vec3 vertex(const float* strand, uint32_t i) {
    return {strand[3 * i], strand[3 * i + 1], strand[3 * i + 2]};
}

// Calls visit(strand, first vertex, count) for every strand.
template <typename Visit> void for_each_strand(const RestStrands& strands, const Visit& visit) {
    const float* first = strands.positions.data();
    for (size_t strand = 0; strand < strands.counts.size(); ++strand) {
        const uint32_t count = strands.counts[strand];
        visit(strand, first, count);
        first += 3 * count;
    }
}

double strand_length(const float* first, uint32_t count) {
    double length = 0;
    for (uint32_t i = 0; i + 1 < count; ++i)
        length += (vertex(first, i + 1) - vertex(first, i)).norm();
    return length;
}

// EA such that the strand's own weight at 10 g stretches it by 1 % at the root.
double stretch_stiffness(const Material& material, double length) {
    if (material.stretch_stiffness > 0)
        return double(material.stretch_stiffness);
    return double(material.line_density) * length * allowed_at / allowed_stretch;
}

} // namespace

std::pmr::vector<float> lane_material(const RestStrands& strands, const LaneLayout& layout,
                                      const Material& material, std::pmr::memory_resource* memory) {
    std::pmr::vector<float> rows(layout.rows() * components, 0.0f, memory);
    const auto at = [&](size_t strand, size_t row, size_t component) -> float& {
        return rows[layout.index(strand, row, component, components)];
    };
    for (size_t strand = 0; strand < layout.padded_strands(); ++strand)
        for (uint32_t i = 0; i < layout.row; ++i)
            at(strand, i, PLAIT_LANE_MASS) = 1;
    for_each_strand(strands, [&](size_t strand, const float* first, uint32_t count) {
        const double length = strand_length(first, count);
        const double EA = stretch_stiffness(material, length);
        const double density = double(material.line_density);
        double before = 0, along = 0;
        for (uint32_t i = 0; i < count; ++i) {
            const double after =
                i + 1 < count ? (vertex(first, i + 1) - vertex(first, i)).norm() : 0;
            const double mass = material.equal_masses ? before : 0.5 * (before + after);
            at(strand, i, PLAIT_LANE_MASS) = static_cast<float>(density * mass);
            if (after > 0) {
                // the clamp is a joint of half the first segment
                const double joint = i == 0 ? 0.5 * after : 0.5 * (before + after);
                const double scale = 1 + (double(material.tip_stiffness) - 1) * along / length;
                at(strand, i, PLAIT_LANE_LENGTH) = static_cast<float>(after);
                at(strand, i, PLAIT_LANE_STRETCH) = static_cast<float>(EA / after);
                at(strand, i, PLAIT_LANE_BEND) =
                    static_cast<float>(4 * double(material.bend_stiffness) * scale / joint);
            }
            along += after;
            before = after;
        }
    });
    return rows;
}

std::pmr::vector<float> lane_rest(const RestStrands& strands, const LaneLayout& layout,
                                  std::pmr::memory_resource* memory) {
    std::pmr::vector<float> rows(layout.rows() * 4, 0.0f, memory);
    const auto store = [&](size_t strand, size_t row, const Quat& q) {
        for (int c = 0; c < 4; ++c)
            rows[layout.index(strand, row, static_cast<size_t>(c), 4)] =
                static_cast<float>(q.coeffs()[c]);
    };
    for (size_t strand = 0; strand < layout.padded_strands(); ++strand)
        for (uint32_t i = 0; i < layout.row; ++i)
            store(strand, i, Quat::Identity());
    for_each_strand(strands, [&](size_t strand, const float* first, uint32_t count) {
        Quat frame = Quat::Identity();
        for (uint32_t i = 0; i + 1 < count; ++i) {
            const Vec3 along = vertex(first, i + 1) - vertex(first, i);
            const Vec3 director = frame * Vec3::UnitX();
            const Quat next = (Quat::FromTwoVectors(director, along) * frame).normalized();
            store(strand, i, frame.conjugate() * next);
            frame = next;
        }
    });
    return rows;
}

} // namespace plait
