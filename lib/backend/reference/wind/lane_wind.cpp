// lane_wind: drag of a slender cylinder in a stream, with White's C = 1 + 10 Re^(-2/3), on every vertex:
// f as an acceleration, and a spring of stiffness m c/h' to where the vertex would go at the velocity
// it has, which makes f implicit, f - c (v' - v); c the greater of the rates across and along the
// strand. With BDF2, whose history of a velocity goes on when the air changes, (D - D_before)/(2h)
// besides, D = h f/(1 + c h): free hair then moves as by backward Euler.
#include "backend/reference/base/lanes.hpp"
#include "backend/reference/grid/grid.hpp"

#include <plait/constants.h>

#include <algorithm>
#include <cmath>

namespace plait::reference {
namespace {

struct Drag {
    double rate; // 1/s
    Vec3 force;  // m/s^2
    Vec3 change(double h) const { return h * force / (1 + h * rate); }
};

// A vertex in air: which way its strand goes, and rho d/2 of its length over its mass, 1/m.
struct Vertex {
    Vec3 along;
    double share;

    // `u`: the air's velocity against it.
    Drag drag(const plait_lane_wind_params& params, const Vec3& u, double most) const {
        const Vec3 lengthwise = u.dot(along) * along, across = u - lengthwise;
        const double rate = std::min(share * resistance(params, across.norm()), most);
        const double rate_along =
            std::min(params.tangential * share * resistance(params, lengthwise.norm()), most);
        return {std::max(rate, rate_along), rate * across + rate_along * lengthwise};
    }

  private:
    // C times the speed.
    static double resistance(const plait_lane_wind_params& params, double speed) {
        return speed + params.viscous * std::cbrt(speed);
    }
};

// One strand.
class Strand {
  public:
    Strand(const plait_lane_wind_params& params, const lane_wind_args& args, size_t slot)
        : params_(params), args_(args), strand_(strand_of(args.lane_strand, slot)),
          lane_(slot, params.vertex_stride, params.tile),
          root_(root_of(args.rest, pose_of(args.pose, strand_), strand_, params.row_stride)),
          step_(params.bdf2 ? params.h * 2.0 / 3.0 : params.h),
          drag_(params.drag *
                scale_of(lane_, args.lane_material, params.vertex_stride, PLAIT_LANE_DRAG)) {}

    void write() const {
        const uint32_t count = vertices_of(args_.vertex_count, strand_, params_.vertex_stride);
        for (uint32_t i = 0; i < params_.vertex_stride; ++i)
            if (i == 0 || i >= count)
                put(i, Vec3::Zero(), Vec3::Zero(), 0);
            else
                write_vertex(i, i + 1 == count);
    }

  private:
    double material(size_t row, size_t component) const {
        return args_.lane_material[lane_.index(row, component, PLAIT_LANE_MATERIAL_COMPONENTS)];
    }
    Vec3 position(size_t i) const {
        return i == 0 ? Vec3(Vec3::Zero()) : lane_.vector(args_.lane_x, i);
    }
    // Relative to the root at the substep's end: where its velocity is counted from.
    Vec3 history(size_t i) const {
        const Vec3 now = lane_.vector(args_.lane_x, 0) + position(i);
        if (!params_.bdf2)
            return now - root_;
        const Vec3 before =
            lane_.vector(args_.lane_x_before, 0) + lane_.vector(args_.lane_x_before, i);
        return (4 * now - before) / 3 - root_;
    }
    struct Air {
        Vec3 velocity;
        double open; // share of the wind's changes
    };
    Air air_at(const Vec3& x) const;
    Vertex vertex(uint32_t i, bool tip) const {
        const double before = material(i - 1, PLAIT_LANE_LENGTH);
        const double behind = material(i, PLAIT_LANE_LENGTH); // 0 at the tip
        const double length = (before + behind) / 2;
        return {direction(position(tip ? i : i + 1) - position(i - 1)),
                drag_ * length / material(i, PLAIT_LANE_MASS)};
    }
    void write_vertex(uint32_t i, bool tip) const;
    void put(uint32_t i, const Vec3& push, const Vec3& target, double stiffness) const {
        lane_.store(args_.lane_push, i, push);
        for (int c = 0; c < 3; ++c)
            args_.lane_spring[lane_.index(i, static_cast<size_t>(c), 4)] = target[c];
        args_.lane_spring[lane_.index(i, 3, 4)] = stiffness;
    }

    const plait_lane_wind_params& params_;
    const lane_wind_args& args_;
    size_t strand_;
    Lane lane_;
    Vec3 root_;
    double step_; // of the integrator
    double drag_; // rho d/2 of the strand, kg/m^2
};

Strand::Air Strand::air_at(const Vec3& x) const {
    if (!params_.field)
        return {vec3(params_.air), 1};
    Air air{vec3(params_.air), 0};
    plait_lane_grid_params grid{};
    grid.edge_count = params_.edge_count;
    grid.voxel_edge = params_.voxel_edge;
    std::copy_n(params_.q, 4, grid.q);
    std::copy_n(params_.t, 4, grid.t);
    grid.tent = PLAIT_TENT_TRILINEAR;
    const Grid nodes(grid);
    // beyond the outermost nodes as on them
    const double most = params_.edge_count - 0.5;
    const Grid::Nodes around = nodes.nodes(nodes.coordinates(x).cwiseMax(0.5).cwiseMin(most));
    for (size_t n = 0; n < around.count; ++n) {
        const auto& [voxel, weight] = around.node[n];
        air.velocity += weight * xyz(args_.wind_velocity[voxel]);
        air.open += weight * args_.wind_velocity[voxel][3];
    }
    return air;
}

void Strand::write_vertex(uint32_t i, bool tip) const {
    const Vertex hair = vertex(i, tip);
    const double most = PLAIT_AIR_MOST_DRAG / step_;
    const auto [air, open] = air_at(lane_.vector(args_.lane_x, 0) + position(i));
    const Vec3 u = air - lane_.vector(args_.lane_v, i);
    const Drag drag = hair.drag(params_, u, most);
    Vec3 push = drag.force;
    if (params_.bdf2) {
        const Vec3 before = air - open * vec3(params_.jump) - lane_.vector(args_.lane_v_before, i);
        push += (drag.change(params_.h) - hair.drag(params_, before, most).change(params_.h)) /
                (2 * params_.h);
    }
    if (params_.accelerates)
        push += checked_acceleration(args_.acceleration[strand_ * params_.row_stride + i]);
    if (params_.pressure)
        push += lane_.vector(args_.lane_pressure, i);
    Vec3 target = history(i) + step_ * lane_.vector(args_.lane_v, i);
    double stiffness = material(i, PLAIT_LANE_MASS) * drag.rate / step_;
    if (params_.pins) {
        const double pin = args_.lane_spring[lane_.index(i, 3, 4)];
        Vec3 held;
        for (int c = 0; c < 3; ++c)
            held[c] = args_.lane_spring[lane_.index(i, static_cast<size_t>(c), 4)];
        if (pin > 0)
            target = (pin * held + stiffness * target) / (pin + stiffness);
        stiffness += pin;
    }
    put(i, push, target, stiffness);
}

} // namespace

void lane_wind(uint32_t item_count, const plait_lane_wind_params& params,
               const lane_wind_args& args) {
    for (size_t slot = 0; slot < item_count; ++slot)
        Strand(params, args, slot).write();
}

} // namespace plait::reference
