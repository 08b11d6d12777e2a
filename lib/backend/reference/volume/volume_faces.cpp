// volume_faces: rows of the complementarity problem of a one-sided pressure, written down from
//     0 <= p + c   and   h D(v') - s >= 0,   not both > 0,
// p0 the pressure over the density of the step before, times the lesser of both steps' densities,
// D the sum over a node's faces of the outward velocity over the edge, v' = v - h grad(p - p0)/rho at
// open faces and the collider's velocity at closed ones, s the share by which hair is to part.
#include "backend/reference/grid/volume.hpp"

#include <plait/constants.h>

#include <algorithm>

namespace plait::reference {
namespace {

class Equations {
  public:
    Equations(const plait_volume_params& params, const volume_faces_args& args)
        : params_(params), args_(args), grid_(params.edge_count) {}

    void write(size_t node) const {
        Vec4 links = Vec4::Zero();
        for (size_t axis = 0; axis < 3; ++axis)
            if (const auto next = grid_.neighbour(node, axis, 1))
                links[static_cast<Eigen::Index>(axis)] = link(node, *next);
        links[3] = before(node);
        args_.volume_link[node] = links;
        args_.volume_pressure[node] = is_hair(node) ? before(node) : 0;
        args_.volume_node[node] = is_hair(node) ? row(node) : Vec4(Vec4::Zero());
    }

  private:
    bool solid(size_t node) const { return args_.volume_solid[node].w() > 0; }
    double density(size_t node) const { return args_.grid_density[node]; }
    double kept(size_t node) const { return params_.share * args_.volume_rest[node]; }
    double cohesion(size_t node) const {
        const double wet = params_.wet ? args_.volume_wetness[node] : 0;
        return double(params_.cohesion) + double(params_.wet_cohesion) * wet;
    }
    double before(size_t node) const {
        if (!params_.carried)
            return 0;
        return args_.volume_before[2 * node] *
               std::min(density(node), args_.volume_before[2 * node + 1]);
    }

    // 1/rho of a face, 0 where it is closed.
    double link(size_t a, size_t b) const {
        const double sum = density(a) + density(b);
        return solid(a) || solid(b) || sum <= 0 ? 0 : 2 / sum;
    }

    double speed(size_t node, size_t other, size_t axis) const {
        const auto i = static_cast<Eigen::Index>(axis);
        if (solid(other))
            return args_.volume_solid[other][i];
        const double a = density(node), b = density(other);
        if (a + b <= 0)
            return 0;
        return params_.fall[axis] +
               (a * args_.grid_velocity[node][i] + b * args_.grid_velocity[other][i]) / (a + b);
    }

    bool is_hair(size_t node) const {
        if (grid_.outermost(node) || solid(node) || density(node) <= PLAIT_VOLUME_LEAST_DENSITY ||
            density(node) <= PLAIT_VOLUME_AIR * kept(node))
            return false;
        double links = 0;
        for_each_face(node, [&](size_t other, size_t, int) { links += link(node, other); });
        return links > 0;
    }

    double part(size_t node) const {
        const double excess = 1 - kept(node) / density(node);
        const double beyond = std::max(0.0, excess - double(params_.slack));
        const double eased = beyond * beyond / (beyond + double(params_.onset));
        return excess > 0 ? std::min(params_.recovery * eased, double(params_.most_recovery))
                          : excess;
    }

    // With lambda = h^2/e^2 the condition is lambda sum links (p - p_c) + (what is left) >= 0.
    Vec4 row(size_t node) const {
        const double steps = double(params_.h) / double(params_.voxel_edge);
        const double lambda = steps * steps;
        double left = -part(node), links = 0;
        for_each_face(node, [&](size_t other, size_t axis, int side) {
            const double between = link(node, other);
            left += steps * side * speed(node, other, axis);
            left -= lambda * between * (before(node) - before(other));
            links += between;
        });
        const bool coheres = density(node) > PLAIT_VOLUME_COHESIVE * kept(node);
        return {left / lambda, coheres ? -cohesion(node) * kept(node) : 0.0,
                PLAIT_VOLUME_RELAXATION / links, 0};
    }

    template <typename Visit> void for_each_face(size_t node, const Visit& visit) const {
        for (size_t axis = 0; axis < 3; ++axis)
            for (const int side : {-1, 1})
                if (const auto other = grid_.neighbour(node, axis, side))
                    visit(*other, axis, side);
    }

    const plait_volume_params& params_;
    const volume_faces_args& args_;
    NodeGrid grid_;
};

} // namespace

void volume_faces(uint32_t item_count, const plait_volume_params& params,
                  const volume_faces_args& args) {
    const Equations equations(params, args);
    for (size_t node = 0; node < item_count; ++node)
        equations.write(node);
}

} // namespace plait::reference
