// wind_shelter: Beer's law along the wind, from plane to plane. A node's optical depth is that of the point
// of the plane before through which its wind came, bilinear between its nodes, and the trapezoidal rule
// over the way from there; outside of the grid there is neither depth nor extinction. Of the air
// e^-depth is wind, and the rest has the velocity of the hair.
#include "backend/reference/base/math.hpp"
#include "backend/reference/base/stages.hpp"

#include <algorithm>
#include <cmath>

namespace plait::reference {
namespace {

// A plane of nodes across an axis of the grid.
struct NodePlane {
    size_t nodes, axis, at;

    size_t voxel(size_t a, size_t b) const {
        size_t cell[3];
        cell[axis] = at;
        cell[axis == 0 ? 1 : 0] = a;
        cell[axis == 2 ? 1 : 2] = b;
        return (cell[1] * nodes + cell[2]) * nodes + cell[0];
    }
    double value(const auto& values, double a, double b) const {
        double sum = 0;
        for (size_t i = 0; i < nodes; ++i)
            for (size_t j = 0; j < nodes; ++j) {
                const double weight = std::max(0.0, 1 - std::abs(a - double(i))) *
                                      std::max(0.0, 1 - std::abs(b - double(j)));
                if (weight > 0)
                    sum += weight * double(values[voxel(i, j)]);
            }
        return sum;
    }
};

// The plane of that number as the wind meets them.
void shelter_plane(const plait_wind_shelter_params& params, const wind_shelter_args& args,
                   size_t number) {
    const size_t n = params.edge_count, plane = params.reversed ? n - 1 - number : number;
    const NodePlane here{n, params.axis, plane};
    const NodePlane before{n, params.axis, params.reversed ? plane + 1 : plane - 1};
    for (size_t item = 0; item < n * n; ++item) {
        const size_t node = here.voxel(item % n, item / n);
        double depth = 0;
        if (number > 0) {
            const double a = double(item % n) - params.foot[0],
                         b = double(item / n) - params.foot[1];
            const double last = double(n - 1);
            depth = args.wind_extinction[node] * params.way / 2;
            if (a >= 0 && a <= last && b >= 0 && b <= last)
                depth += before.value(args.wind_depth, a, b) +
                         before.value(args.wind_extinction, a, b) * params.way / 2;
        }
        args.wind_depth[node] = depth;
        Vec3 wind = vec3(params.air);
        if (params.turbulent)
            wind += xyz(args.wind_velocity[node]);
        const Vec3 hair = args.grid_density[node] > 0
                              ? quat(params.q) * xyz(args.grid_velocity[node])
                              : vec3(params.still);
        const double open = std::exp(-depth);
        args.wind_velocity[node] = with_w(open * wind + (1 - open) * hair, open);
    }
}

} // namespace

void wind_shelter(uint32_t item_count, const plait_wind_shelter_params& params,
                  const wind_shelter_args& args) {
    const size_t n = params.edge_count;
    if (params.axis > 2 || params.plane >= n)
        throw BadDispatch(format("axis is %u, plane %u of %zu", params.axis, params.plane, n));
    for (size_t number = params.plane; item_count > 0 && number < n; ++number)
        shelter_plane(params, args, number);
}

} // namespace plait::reference
