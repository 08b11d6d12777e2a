// A vertex that two surfaces hold. Ours; the formulae are those of docs/stages/strands.md.
#include "backend/reference/contact/contact_placer.hpp"

#include <plait/constants.h>

#include <algorithm>
#include <cmath>

namespace plait::reference {
namespace {

// Two planes, `one` and `two` m off its centre, cut the sphere of radius `length` in two places: their middle, and the
// way from it to the place nearer to `out`.
struct Cut {
    Vec3 middle, way;
};

std::optional<Cut> on_both(const Vec3& n, double one, const Vec3& m, double two, const Vec3& out,
                           double length) {
    const double same = n.dot(m), square = 1 - same * same;
    if (square < PLAIT_CONTACT_EDGE)
        return {};
    const Vec3 middle = ((one - same * two) * n + (two - same * one) * m) / square;
    const double rest = length * length - middle.squaredNorm();
    if (rest < 0)
        return {};
    const Vec3 along = n.cross(m).normalized();
    return Cut{middle, std::copysign(std::sqrt(rest), along.dot(out)) * along};
}

} // namespace

// The place nearest to `out` where a plane `depth` above it cuts the sphere.
Vec3 ContactPlacer::on_circle(const Vec3& n, const Vec3& out, double depth, double length) {
    const double above = std::clamp(n.dot(out) + depth, -length, length);
    const Vec3 across = out - n.dot(out) * n;
    const double size = across.norm();
    return above * n + std::sqrt((length - above) * (length + above)) *
                           (size > 1e-30 ? Vec3(across / size) : n);
}

// A vertex lies on a surface of normal n, `out` from its leader: where it goes if another surface holds it too deep, in
// an inward box' edge or between two bodies. A corner takes more rounds; where all have failed, the other place on the
// last edge may be less deep.
Vec3 ContactPlacer::in_edge(size_t vertex, const Vec3& leader, Vec3 n, Vec3 out) {
    const double length = contacts_.length_[vertex];
    std::optional<Cut> cut;
    for (int k = 0; k < PLAIT_CONTACT_EDGE_ROUNDS; ++k) {
        const auto other = holder(vertex, leader + out);
        const double same = other ? n.dot(other->normal) : 0;
        if (!other || (same < 0 && 1 - same * same < PLAIT_CONTACT_EDGE)) // against each other
            break;
        if (cut && k + 1 == PLAIT_CONTACT_EDGE_ROUNDS) {
            const Vec3 beyond = cut->middle - cut->way;
            const auto there = holder(vertex, leader + beyond);
            return there && there->gap < other->gap ? out : beyond;
        }
        const Vec3& m = other->normal;
        cut = on_both(n, n.dot(out), m, m.dot(out) - other->gap, out, length);
        out = cut ? Vec3(cut->middle + cut->way) : on_circle(m, out, -other->gap, length);
        n = m;
    }
    return out;
}

} // namespace plait::reference
