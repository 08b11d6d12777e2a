#include "comparison.hpp"

namespace simulate {

Scene Variant::of(Scene scene) const {
    scene.sim.model = model;
    if (model == PLAIT_MODEL_TRESSFX)
        scene.sim.sag_free = PLAIT_SAG_FREE_OFF; // its shape constraints know no sag
    scene.sim.params.interhair = interhair;
    return scene;
}

std::string label_of(plait_model model, plait_interhair interhair) {
    std::string label = model == PLAIT_MODEL_TRESSFX ? "TressFX" : model_names[model];
    if (interhair != PLAIT_INTERHAIR_OFF)
        label += std::string(" + inter-hair step (") +
                 (interhair == PLAIT_INTERHAIR_SLOTS ? "slots, as in the thesis" : "exact") + ")";
    return label;
}

std::vector<Variant> variants_beside(const Scene& scene) {
    const plait_model own = scene.sim.model;
    const plait_interhair step = scene.sim.params.interhair;
    std::vector<Variant> variants;
    const auto add = [&](plait_interhair interhair) {
        if (own != PLAIT_MODEL_TRESSFX || step != interhair)
            variants.push_back(
                {label_of(PLAIT_MODEL_TRESSFX, interhair), PLAIT_MODEL_TRESSFX, interhair});
    };
    add(PLAIT_INTERHAIR_OFF);
    if (own != PLAIT_MODEL_TRESSFX)
        add(step == PLAIT_INTERHAIR_OFF ? PLAIT_INTERHAIR_SLOTS : step);
    return variants;
}

} // namespace simulate
