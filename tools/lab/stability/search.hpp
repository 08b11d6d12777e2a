// The stability sweep as a whole: planned, done where a run before has not, drawn.
#pragma once

#include "bad_input.hpp"
#include "methods/models.hpp"
#include "rows.hpp"

namespace lab::stability {

struct SweepOptions {
    std::vector<std::string> models{"tressfx", "articulated", "chain", "cosserat", "rod"};
    std::vector<std::string> scenes; // of scene_names(); empty: all
    std::string out = "out/stability";
    bool full = false, fresh = false, pictures = true;
    bool few_baselines = false; // at 60 Hz and on the map alone: some take a thousand substeps
};

struct Sweep {
    std::string device;
    std::vector<Row> rows;
    bool interrupted = false;
};

// "map", one for each axis, as "collider_speed", and "bad_input".
std::vector<std::string> scene_names();
// Throws Failure on a name that is none, of a model or a scene.
Sweep sweep(const SweepOptions& options, Contexts& contexts);
// By model; of the library's own where there are `few_baselines`.
using Verdicts = std::vector<std::pair<std::string, Verdict>>;
Verdicts try_bad_inputs(const SweepOptions& options, Contexts& contexts);
std::string verdicts_markdown(const Verdicts& verdicts);
std::string grid_of(const SweepOptions& options); // "30, 60, 240 Hz; N 2, ...; Γ ..."

} // namespace lab::stability
