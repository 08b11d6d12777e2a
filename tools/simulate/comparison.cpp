#include "comparison.hpp"

#include <algorithm>
#include <cstdio>
#include <iterator>

namespace simulate {

namespace {

bool has_thesis_step(const plait_sim_params& params) {
    return params.interhair == PLAIT_INTERHAIR_SLOTS &&
           params.slot_hash == PLAIT_SLOT_HASH_RULE_THESIS &&
           params.diffuse_rule == PLAIT_DIFFUSE_RULE_THESIS;
}

plait_sim_desc tressfx_alone(const Scene& scene) {
    plait_sim_desc sim = scene.sim;
    if (sim.model != PLAIT_MODEL_TRESSFX)
        take_tressfx(scene.tressfx, sim.params);
    sim.model = PLAIT_MODEL_TRESSFX;
    sim.sag_free = PLAIT_SAG_FREE_OFF; // its shape constraints know no sag
    sim.params.interhair = PLAIT_INTERHAIR_OFF;
    sim.params.volume = PLAIT_VOLUME_OFF; // which it refuses
    return sim;
}

plait_sim_desc without_volume(plait_sim_desc sim) {
    sim.params.volume = PLAIT_VOLUME_OFF;
    return sim;
}

// With the thesis's ratio and factor, unless the scene gives its own.
plait_sim_desc tressfx_and_thesis(const Scene& scene) {
    plait_sim_desc sim = tressfx_alone(scene);
    sim.params.interhair = PLAIT_INTERHAIR_SLOTS;
    sim.params.slot_hash = PLAIT_SLOT_HASH_RULE_THESIS;
    sim.params.diffuse_rule = PLAIT_DIFFUSE_RULE_THESIS;
    sim.params.diffuse_ratio = scene.unhung.diffuse_ratio;
    sim.params.diffuse_factor = scene.unhung.diffuse_factor;
    return sim;
}

} // namespace

std::string Variant::short_label() const {
    return label == label_of(sim) ? short_label_of(sim) : label;
}

Scene Variant::of(Scene scene) const {
    scene.sim = sim;
    scene.detail = detail;
    if (dry)
        scene.wetness.clear();
    scene.profile = false;
    scene.trace.clear();
    return scene;
}

std::string label_of(const plait_sim_desc& sim) {
    std::string label = sim.model == PLAIT_MODEL_TRESSFX ? "TressFX" : model_names[sim.model];
    if (sim.params.interhair == PLAIT_INTERHAIR_OFF)
        return label;
    if (has_thesis_step(sim.params))
        return label + " + inter-hair step of the thesis";
    if (sim.params.volume != PLAIT_VOLUME_OFF)
        return label + " + volume";
    return label + " + inter-hair step (" + interhair_names[sim.params.interhair] + ")";
}

std::string label_of(const Scene& scene) {
    std::string label = label_of(scene.sim);
    if (!scene.wetness.empty())
        label += ", wet";
    if (!scene.detail)
        return label;
    const plait_detail_desc& detail = *scene.detail;
    const std::pair<const float(&)[4], const char*> kinds[] = {
        {detail.clump, "clumps"}, {detail.curl, "curls"}, {detail.frizz, "frizz"}};
    const char* between = " + ";
    for (const auto& [ramp, name] : kinds)
        if (std::any_of(std::begin(ramp), std::end(ramp), [](float knot) { return knot > 0; })) {
            label += between + std::string(name);
            between = ", ";
        }
    return label;
}

std::string short_label_of(const plait_sim_desc& sim) {
    const std::string model = sim.model == PLAIT_MODEL_TRESSFX ? "TressFX" : model_names[sim.model];
    if (sim.params.volume != PLAIT_VOLUME_OFF)
        return model + " + volume";
    return has_thesis_step(sim.params) ? model + " + thesis's step" : model;
}

std::string tressfx_settings(const Scene& scene) {
    const plait_sim_params& p =
        scene.sim.model == PLAIT_MODEL_TRESSFX ? scene.sim.params : scene.tressfx;
    char text[160];
    std::snprintf(
        text, sizeof text,
        "TressFX with %u length iterations, local shape %g in %u iterations, global shape "
        "%g over %g of a strand",
        p.length_iterations, double(p.local_stiffness), p.local_iterations,
        double(p.global_stiffness), double(p.global_range));
    return text;
}

std::vector<Variant> variants_beside(const Scene& scene) {
    if (!scene.compare)
        return {};
    if (!scene.compare_detail.empty()) {
        std::vector<Variant> variants;
        for (const DetailChoice& choice : scene.compare_detail)
            variants.push_back({choice.name, scene.sim, choice.detail});
        return variants;
    }
    if (!scene.wetness.empty())
        return {{label_of(scene.sim) + ", dry", scene.sim, scene.detail, true}};
    const bool own = scene.sim.model == PLAIT_MODEL_TRESSFX;
    const plait_sim_params& params = scene.sim.params;
    std::vector<Variant> variants;
    const auto add = [&](const plait_sim_desc& sim) {
        variants.push_back({label_of(sim), sim, scene.detail});
    };
    if (!own || params.interhair != PLAIT_INTERHAIR_OFF)
        add(tressfx_alone(scene));
    if (!own || !has_thesis_step(params))
        add(tressfx_and_thesis(scene));
    if (params.volume != PLAIT_VOLUME_OFF)
        add(without_volume(scene.sim));
    return variants;
}

} // namespace simulate
