// What a run is set beside, on the comparison sheet and in the report: the same hair, moved the
// same way, by less of the system, or with other detail.
#pragma once

#include "scene/scene.hpp"

#include <string>
#include <vector>

namespace simulate {

struct Variant {
    std::string label;
    plait::SimDesc sim;
    Detail detail;
    bool dry = false; // though the scene is wet

    std::string short_label() const; // in few letters, for films
    Scene of(Scene scene) const;     // the scene run this way, one head without a budget
};

// "TressFX", "TressFX + inter-hair step of the thesis", "articulated + inter-hair step (slots)"
std::string label_of(const plait::SimDesc& sim);

// That of the run itself, its detail after the simulation in it: "articulated + clumps, frizz".
std::string label_of(const Scene& scene);

// ", within 4 ms"
std::string within(const CrowdChoice& crowd);

// The same in few letters, for films: "TressFX", "TressFX + thesis's step", "articulated".
std::string short_label_of(const plait::SimDesc& sim);

// What the model TressFX is set to, in words: its stiffness and stretch are iteration counts.
std::string tressfx_settings(const Scene& scene);

// The scene's other details; without any, TressFX alone, and with the inter-hair step as the thesis
// has it: those of the two that are not the run itself; and the run without volume, where it has
// volume. A run within a budget stands beside all strands alone, one whose hair is wet beside itself dry.
std::vector<Variant> variants_beside(const Scene& scene);

} // namespace simulate
