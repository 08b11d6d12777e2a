// tressfx_collide: push vertices out of colliders, with Coulomb friction.
// Friction takes at most mu * (push depth) off the tangential part of the vertex's displacement
// relative to the surface, and never reverses it
// (Mueller et al. 2007, section 3.4, with the depth in place of a restitution model).
#include "backend/reference/base/stages.hpp"
#include "backend/reference/contact/collider.hpp"

#include <algorithm>

namespace plait::reference {
namespace {

Vec3 rub(const Vec3& x, const Vec3& relative, const Surface& at, double friction) {
    const Vec3 tangential = relative - relative.dot(at.normal) * at.normal;
    const double slip = tangential.norm();
    if (slip == 0)
        return x;
    return x - tangential * std::min(1.0, friction * -at.distance / slip);
}

} // namespace

void tressfx_collide(uint32_t item_count, const plait_tressfx_collide_params& params,
                     const tressfx_collide_args& args) {
    for (size_t item = 0; item < item_count; ++item) {
        const auto [strand, i] = strand_vertex(item, params.vertex_stride);
        Vec4& position = args.position[item];
        if (i >= vertices_of(args.vertex_count, strand, params.vertex_stride) || pinned(position))
            continue;
        for (size_t index = 0; index < params.collider_count; ++index) {
            const Collider collider = collider_at(args.collider, params.collider_first + index);
            const Surface at = collider.surface(xyz(position));
            if (!(at.distance < 0))
                continue;
            const Vec3 pushed = xyz(position) - at.distance * at.normal;
            const Vec3 relative = collider.carried_from(pushed) - xyz(args.position_prev[item]);
            set_xyz(position, rub(pushed, relative, at, collider.friction));
        }
    }
}

} // namespace plait::reference
