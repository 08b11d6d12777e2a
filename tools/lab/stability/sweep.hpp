// The stability sweep: which trials there are. A model in every combination of rate, segments,
// stiffness and motion, and one parameter at a time far beyond what hair needs.
#pragma once

#include "trial.hpp"

#include <map>

namespace lab::stability {

// What is tried: a model, or a kernel that stands in for it, and how it is run.
struct Subject {
    std::string label; // "articulated 1x1 BDF2"
    plait_model model;
    uint32_t substeps = 1, iterations = 1;
    bool bdf2 = false;
    plait_context* context = nullptr;
    bool limp = false; // a kernel that bends for nothing, whatever the material is

    bool bends() const { return model == PLAIT_MODEL_ARTICULATED && !limp; }
};

// One place of the map; its strands' motions are its columns.
struct Place {
    double rate = 60;       // Hz
    uint32_t segments = 16; // to 255
    double gamma = 10;      // rho A g L^3 / EI; infinite: limp
};

constexpr double limp = std::numeric_limits<double>::infinity();
constexpr double length = 0.3; // m, of every strand

// How a root is shaken for 2 s.
struct Shake {
    const char* label; // "10 g", "jump 1 L"
    double g;          // largest acceleration at 2 Hz
    double jump;       // in one step after half a second, L
};
const std::vector<Shake>& shakes();

// Every shake, of a straight strand, level, and of a curl: first all straight ones.
Trial map_trial(const Subject& subject, const Place& place);
// One outcome a shake, the worse of the two shapes.
std::vector<Outcome> try_place(const Subject& subject, const Place& place);

// 60 Hz and above, up to 64 segments, gamma 1 and above, up to 10 g: all should pass here.
bool in_envelope(const Place& place, const Shake& shake);

// One parameter at a time; what is not said is 60 Hz, 16 segments, gamma 10, 1 g at 2 Hz.
struct AxisPoint {
    std::string axis, value; // "substeps", "1000"
    std::function<Trial(const Subject&)> trial;
    bool pins = false; // only of a model that takes them
};
std::vector<AxisPoint> axis_points();

} // namespace lab::stability
