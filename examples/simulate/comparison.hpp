// What a run is set beside, on the comparison sheet and in the report: the same hair, moved the
// same way, by less of the system.
#pragma once

#include "scene.hpp"

#include <string>
#include <vector>

namespace simulate {

struct Variant {
    std::string label;
    plait_model model;
    plait_interhair interhair;

    Scene of(Scene scene) const; // the scene run this way
};

// "TressFX", "TressFX + inter-hair step (slots)", "cosserat + ..."
std::string label_of(plait_model model, plait_interhair interhair);

// TressFX alone, and with the thesis's step: those of the two that are not the run itself.
std::vector<Variant> variants_beside(const Scene& scene);

} // namespace simulate
