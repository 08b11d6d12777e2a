// tressfx_wind: the published blend of four winds, or aerodynamic drag.
// Published (TressFX 3.1, kept for parity): a = (strand mod 20)/20 picks W between the four winds
// and
//   x_i += -((d x W) x d) h^2,  d = x_i - x_{i+1},   free vertices 2..count-2.
// It pushes hair against the wind, depends on the unit of length, and knows no air speed relative
// to the hair. Drag, what we use otherwise (k = rho_air C_d d / (2 rho A), 1/m):
//   u = wind - v,  u_perp = u - (u.n) n,  a = k |u_perp| u_perp
//   x_i += h u_perp s / (1 + s),  s = h k |u_perp|
// the implicit form of a h^2: equal to it for small s, and never more than the air itself moves.
#include "backend/reference/base/stages.hpp"

#include <vector>

namespace plait::reference {
namespace {

Vec3 published_displacement(const std::vector<Vec3>& x, uint32_t i, size_t strand,
                            const plait_tressfx_wind_params& params) {
    if (i < 2 || i + 1 >= x.size())
        return Vec3::Zero();
    const double a = static_cast<double>(strand % 20) / 20.0;
    const float* corner = params.corner; // four winds, x y z _ each
    const Vec3 wind = a * vec3(corner) + (1 - a) * vec3(corner + 4) + a * vec3(corner + 8) +
                      (1 - a) * vec3(corner + 12);
    const Vec3 d = x[i] - x[i + 1];
    return -d.cross(wind).cross(d) * (static_cast<double>(params.h) * params.h);
}

Vec3 drag_displacement(const std::vector<Vec3>& x, uint32_t i, const Vec3& previous,
                       const plait_tressfx_wind_params& params) {
    const double h = params.h;
    const Vec3 along = direction(i + 1 < x.size() ? x[i + 1] - x[i] : x[i] - x[i - 1]);
    const Vec3 u = vec3(params.wind) - (x[i] - previous) / h;
    const Vec3 across = u - u.dot(along) * along;
    const double s = h * params.drag * across.norm();
    return h * across * (s / (1 + s));
}

} // namespace

void tressfx_wind(uint32_t item_count, const plait_tressfx_wind_params& params,
                  const tressfx_wind_args& args) {
    for (size_t strand = 0; strand < item_count; ++strand) {
        const size_t root = strand * params.vertex_stride;
        std::vector<Vec3> x; // as it was before any vertex is moved
        for (uint32_t i = 0; i < vertices_of(args.vertex_count, strand, params.vertex_stride); ++i)
            x.push_back(xyz(args.position[root + i]));
        for (uint32_t i = 0; i < x.size(); ++i) {
            if (pinned(args.position[root + i]))
                continue;
            const Vec3 moved =
                params.form == PLAIT_WIND_PUBLISHED
                    ? published_displacement(x, i, strand, params)
                    : drag_displacement(x, i, xyz(args.position_prev[root + i]), params);
            set_xyz(args.position[root + i], x[i] + moved);
        }
    }
}

} // namespace plait::reference
