#include "methods.hpp"

#include <algorithm>
#include <cmath>

namespace lab::volume {

namespace {

constexpr double friction = 5;   // 1/s: hair takes its surroundings' velocity, as volume_viscosity
constexpr double correction = 5; // 1/s: hair that is too dense parts no faster, as volume_rate
// m^2/s^2: of 0.1, 0.3, 0.6, 1, 2 and 3 the one that ends with the best height.
constexpr double repulsion = 1;
// m^2/s^2, of the state equation: a soft one; of the powers of two the greatest that comes to rest
// at 60 Hz; the next, which does not.
constexpr double soft = 1, stiff = 16, beyond = 32;
constexpr int sweeps = 50; // of the projection, from zero
constexpr double relaxation = 1.5;

// v + share (V - v), V the mean velocity on the grid: momentum is kept.
std::vector<Vec3> blended(const Nodes& nodes, const Cloud& cloud, double share) {
    std::vector<Vec3> mean(nodes.count());
    for (size_t n = 0; n < mean.size(); ++n)
        mean[n] = nodes.velocity(n);
    std::vector<Vec3> change(cloud.size(), Vec3::Zero());
    for (size_t i = 0; i < cloud.size(); ++i)
        if (cloud.moves[i] && !nodes.around(cloud.x[i]).empty())
            change[i] = share * (nodes.gather<Vec3>(mean, cloud.x[i], Vec3::Zero()) - cloud.v[i]);
    return change;
}

std::vector<Vec3> at_vertices(const Nodes& nodes, const Cloud& cloud,
                              const std::vector<Vec3>& field, double factor) {
    std::vector<Vec3> all(cloud.size(), Vec3::Zero());
    for (size_t i = 0; i < cloud.size(); ++i)
        if (cloud.moves[i])
            all[i] = factor * nodes.gather<Vec3>(field, cloud.x[i], Vec3::Zero());
    return all;
}

// Petrovic, Henne & Anderson 2005, "Volumetric methods for simulation and rendering of hair": a
// force down the density's gradient, and velocities drawn to those of the grid. Over the mean
// density of the groom, so that the factor does not depend on how many strands there are.
class Petrovic : public Program {
  public:
    explicit Petrovic(const Cube& cube) : nodes_(cube, 0) {} // it knows no bodies

    Change act(const Cloud& cloud, double h) override {
        nodes_.add_up(cloud);
        double mass = 0, sum = 0;
        for (size_t i = 0; i < cloud.size(); ++i) {
            mass += cloud.mass[i];
            sum += cloud.mass[i] * cloud.wanted[i];
        }
        std::vector<Vec3> gradient(nodes_.count(), Vec3::Zero());
        nodes_.for_each([&](size_t node, uint32_t) {
            for (int axis = 0; axis < 3; ++axis) {
                const size_t step = nodes_.stride(axis);
                gradient[node][axis] = (nodes_.density(node + step) - nodes_.density(node - step)) /
                                       (2 * nodes_.voxel());
            }
        });
        return {blended(nodes_, cloud, 1 - std::exp(-friction * h)),
                at_vertices(nodes_, cloud, gradient, -repulsion * mass / sum)};
    }

  private:
    Nodes nodes_;
};

// Hadap & Magnenat-Thalmann 2001, "Modeling dynamic hair as a continuum": hair as a fluid whose
// pressure follows from its density alone. p = k rho max(0, rho/wanted - 1).
class StateEquation : public Program {
  public:
    StateEquation(const Cube& cube, double closed_radius, double stiffness)
        : nodes_(cube, closed_radius), stiffness_(stiffness) {}

    Change act(const Cloud& cloud, double h) override {
        nodes_.add_up(cloud);
        std::vector<double> pressure(nodes_.count(), 0.0);
        nodes_.for_each([&](size_t node, uint32_t) {
            const double rho = nodes_.density(node);
            if (nodes_.is_hair(node))
                pressure[node] = stiffness_ * rho * std::max(0.0, rho / nodes_.wanted(node) - 1);
        });
        return {blended(nodes_, cloud, 1 - std::exp(-friction * h)),
                at_vertices(nodes_, cloud, nodes_.pull_of(pressure), 1)};
    }

  private:
    Nodes nodes_;
    double stiffness_; // m^2/s^2
};

// McAdams et al. 2009, "Detail preserving continuum simulation of straight hair": velocities after
// a step are projected so that dense hair does not come closer, each time from no pressure.
class Projection : public Program {
  public:
    Projection(const Cube& cube, double closed_radius) : nodes_(cube, closed_radius) {}

    Change act(const Cloud& cloud, double h) override {
        nodes_.add_up(cloud);
        Change change{blended(nodes_, cloud, 1 - std::exp(-friction * h)), {}};
        const auto pull = at_vertices(nodes_, cloud, nodes_.pull_of(solve(h)), h);
        for (size_t i = 0; i < cloud.size(); ++i)
            change.velocity[i] += pull[i];
        return change;
    }

  private:
    // What must not be negative, without pressure: h div v, less what hair that is too dense is to
    // part by; hair that is not dense enough may come closer.
    double parting(size_t node, double h) const {
        double sum = 0;
        nodes_.for_each_face(node, [&](size_t other, int axis, int sign) {
            const double a = nodes_.density(node), b = nodes_.density(other);
            sum += sign * (a * nodes_.velocity(node) + b * nodes_.velocity(other))[axis] / (a + b);
        });
        return h * sum / nodes_.voxel() -
               std::min(1 - nodes_.wanted(node) / nodes_.density(node), correction * h);
    }

    // Red-black, projected overrelaxation.
    std::vector<double> solve(double h) const {
        std::vector<double> p(nodes_.count(), 0.0), begin(nodes_.count(), 0.0);
        nodes_.for_each([&](size_t node, uint32_t) {
            if (nodes_.is_hair(node))
                begin[node] = parting(node, h);
        });
        const double factor = h * h / (nodes_.voxel() * nodes_.voxel());
        for (int half = 0; half < 2 * sweeps; ++half)
            nodes_.for_each([&](size_t node, uint32_t colour) {
                if (colour != static_cast<uint32_t>(half & 1) || !nodes_.is_hair(node))
                    return;
                double now = begin[node], own = 0;
                nodes_.for_each_face(node, [&](size_t other, int, int) {
                    const double link = 2 * factor / (nodes_.density(node) + nodes_.density(other));
                    now += link * (p[node] - p[other]);
                    own += link;
                });
                p[node] = own > 0 ? std::max(0.0, p[node] - relaxation * now / own) : 0;
            });
        return p;
    }

    Nodes nodes_;
};

std::unique_ptr<Program> petrovic(const Cube& cube, double) {
    return std::make_unique<Petrovic>(cube);
}
std::unique_ptr<Program> soft_fluid(const Cube& cube, double closed_radius) {
    return std::make_unique<StateEquation>(cube, closed_radius, soft);
}
std::unique_ptr<Program> stiff_fluid(const Cube& cube, double closed_radius) {
    return std::make_unique<StateEquation>(cube, closed_radius, stiff);
}
std::unique_ptr<Program> beyond_fluid(const Cube& cube, double closed_radius) {
    return std::make_unique<StateEquation>(cube, closed_radius, beyond);
}
std::unique_ptr<Program> projection(const Cube& cube, double closed_radius) {
    return std::make_unique<Projection>(cube, closed_radius);
}

void set_nothing(plait::SimDesc&) {}

// Its own grid of eight voxels along an edge, and its own rule.
void set_diffusion(plait::SimDesc& desc) {
    desc.grid.on = true;
    desc.grid.edge_count = 8;
    desc.grid.diffuse_rule = PLAIT_DIFFUSE_RULE_THESIS;
}

void set_volume(plait::SimDesc& desc) {
    desc.grid.on = desc.volume.on = true;
}

} // namespace

const std::vector<Method>& all_methods() {
    static const std::vector<Method> methods{
        {"off", "nothing between hairs", "#777777", set_nothing, nullptr},
        {"diffusion", "Ugurca's velocity diffusion", "#56B4E9", set_diffusion, nullptr},
        {"petrovic", "Petrovic et al. 2005: grid of density and velocity", "#E69F00", set_nothing,
         petrovic},
        {"fluid_soft", "Hadap & Magnenat-Thalmann 2001: fluid, soft", "#CC79A7", set_nothing,
         soft_fluid},
        {"fluid_stiff", "the same, 16 times as stiff", "#D55E00", set_nothing, stiff_fluid},
        {"fluid_beyond", "the same, 32 times as stiff", "#882255", set_nothing, beyond_fluid},
        {"projection", "McAdams et al. 2009: projection", "#0072B2", set_nothing, projection},
        {"volume", "plait: volume", "#009E73", set_volume, nullptr}};
    return methods;
}

} // namespace lab::volume
