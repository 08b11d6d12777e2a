// One strand at rest as the model articulated sees it, in float64: what cl/strands/rod.clh calls l, ks, kb,
// m and r.
#pragma once

#include <Eigen/Geometry>

#include <array>
#include <memory_resource>
#include <span>
#include <vector>

namespace plait {

using Vec3 = Eigen::Vector3d;
using Quat = Eigen::Quaterniond;

// What is so many times as great at the root, a third, two thirds of the length and the tip, and
// linear between.
struct Ramp {
    std::array<double, 4> knots{1, 1, 1, 1};

    double at(double share) const;
    double mean() const { return (knots[0] + 2 * (knots[1] + knots[2]) + knots[3]) / 6; }
    bool operator==(const Ramp&) const = default;
};

// What of the parameters a strand depends on.
struct Material {
    float line_density;      // kg/m
    float bend_stiffness;    // N m^2
    float stretch_stiffness; // N; 0: by the strand's length
    float twist_stiffness;   // N m^2; 0: as bend_stiffness
    float section_ratio;
    float curl;           // scale of the joints' turns at rest
    float clamp;          // scale of the stiffness of the first
    float drag, friction; // scales
    Ramp stiffness, density;
    float groom; // N/m^2, to the groom, beside what the parameters' slider gives
    Ramp groom_ramp;

    void scale(float by) {
        bend_stiffness *= by;
        twist_stiffness *= by;
    }
    bool operator==(const Material&) const = default;
};

struct RestStrand {
    // `positions`: xyz of every vertex, m. Frames are carried along the strand by the shortest
    // turn, so that a strand as groomed has no twist; one that is not round is turned about itself
    // so that it curls about its y axis.
    RestStrand(std::span<const float> positions, const Material& material,
               std::pmr::memory_resource* memory);

    size_t segments() const { return length.size(); }
    Vec3 edge(size_t segment) const { return x[segment + 1] - x[segment]; }
    double hair_of(size_t vertex) const;                     // m that its mass is of
    void frame_along(size_t segment, const Vec3& direction); // from the frame before it
    void scale_curl(double by); // the turn of every joint at rest but the clamp
    Quat frame_before(size_t segment) const {
        return segment == 0 ? Quat::Identity() : frame[segment - 1];
    }

    std::pmr::vector<Vec3> x; // m, as groomed
    double whole = 0;         // length as groomed, m
    double twist = 1;         // GJ/EI
    double cross = 1;         // EI2/EI
    double roll = 0;          // about itself, of the first frame, rad
    // Per segment; the joint of segment i is the one before it, the first one the clamp.
    std::pmr::vector<double> length;  // m
    std::pmr::vector<double> stretch; // EA/l, N/m
    std::pmr::vector<double> bend;    // 4 EI/lbar, N m
    std::pmr::vector<Quat> frame;     // orientation as groomed
    std::pmr::vector<Quat> rest;      // rotation of the joint at rest
    std::pmr::vector<double> mass;    // of every vertex, kg

  private:
    void set_frames();
    double curl_direction() const;
};

} // namespace plait
