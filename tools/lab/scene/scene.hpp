// A scene of the laboratory: everything physical about strands, their motion and what is measured.
// tools/lab/docs/lab.md lists every key with its unit, range and default.
#pragma once

#include "motion.hpp"
#include "strand.hpp"

#include <plait/plait.hpp>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace lab {

struct Material {
    double line_density = 5e-6;     // rho A, kg/m
    double bend_stiffness = 4.7e-9; // EI, N m^2; 0: limp
    double stretch_stiffness = 0;   // EA, N; 0: the library's choice for the length
    double twist_ratio = 0;         // GJ / EI; 0: as it bends
    double tip_stiffness = 1;       // EI at the tip / at the root
};

struct SceneCollider {
    plait_collider_desc shape;
    Motion motion;
};

// What the tip of every strand is pinned to.
struct TipPin {
    Vec3 at;                                   // m, in the world
    double stiffness = double(PLAIT_PIN_HELD); // N/m
};

// What a number is compared with: a table of tests/data, the scene's own strand let go in its plane
// (plane_fall.hpp), its converged run, or the limit of many segments (continuum.hpp).
struct Reference {
    std::string table;                   // "" when `plane` or `converged`
    bool plane = false;                  // with the masses and the joint of the model it is for
    std::string converged;               // a model, run in float64, or a baseline
    uint32_t substeps = 64;              // of `converged`, BDF2 with two iterations
    uint32_t segments = 0;               // it goes to the limit from; 0: it has the scene's own
    std::map<std::string, double> where; // only rows with these values in these columns
    std::vector<std::string> columns{"x", "y", "z"};
    double length_unit = 1, time_unit = 1; // m and s in the table's units
};

// One number to report.
struct Measure {
    std::string metric;
    double from = 0, to = 1e9;          // s of the recording that count
    std::optional<double> expect;       // the metric's ideal, where it wants one
    std::map<std::string, double> pass; // by model; "" for all: the largest that passes
    std::optional<double> at_least;     // instead: the smallest that passes
    uint32_t strand = 0;
    std::optional<Reference> reference; // else the scene's
};

struct Scene {
    std::string title, file;
    std::string physics;              // a name for all that is not method, measure or title
    std::string physics_but_segments; // the same, however many the strand has
    std::vector<Strand> strands;
    uint32_t follows_per_guide = 0;
    Material material;
    Vec3 gravity{0, -standard_gravity, 0};        // m/s^2
    double drag = 1;                              // 1/s
    plait::SimDesc sim;                           // what else is set, by the library's own names
    double rate = 60;                             // steps a second
    double duration = 2;                          // s, recorded
    double settle = 0;                            // s before, not recorded,
    double settle_drag = 0;                       // at this drag, 1/s,
    Vec3 settle_gravity{0, -standard_gravity, 0}; // and in this gravity, m/s^2
    double unit_time = 1;                         // s per unit of time in the file
    std::string model;                            // its label; absent: the library's default
    std::optional<uint32_t> substeps, iterations, bdf2; // absent: the model's own
    std::string device, backend;
    Motion motion;
    std::vector<SceneCollider> colliders;
    std::optional<TipPin> tip_pin;
    std::optional<Reference> reference;
    std::vector<Measure> measures;

    double length() const; // m, of the first strand
    double gamma() const;  // rho A g L^3 / EI of the first strand; infinite when limp
    double bend_stiffness(const Strand& strand) const; // its EI, N m^2; 0: limp
    double first_mode(const Strand& strand) const;     // hanging, of small swings, rad/s
    uint32_t frames() const;
    uint32_t settle_frames() const;
};

// `overrides` wins over the file: an object of the same shape. Throws Failure.
Scene read_scene(const std::string& file, const Json& overrides);
// The same of a document in memory, whose messages name `origin`.
Scene read_scene(const Json& document, const Origin& origin);

// {"strand.length", 2} -> {"strand": {"length": 2}} into `overrides`.
void set_path(Json& overrides, const std::string& path, const Json& value);

} // namespace lab
