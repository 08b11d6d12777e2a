#include "comparison.hpp"
#include "common/params_reader.hpp"

#include <algorithm>
#include <cstdio>
#include <iterator>

namespace simulate {

namespace {

bool has_thesis_step(const plait::SimDesc& sim) {
    return sim.grid.on && sim.grid.form == PLAIT_GRID_FORM_SLOTS &&
           sim.grid.slot_hash == PLAIT_SLOT_HASH_RULE_THESIS &&
           sim.grid.diffuse_rule == PLAIT_DIFFUSE_RULE_THESIS;
}

plait::SimDesc tressfx_alone(const Scene& scene) {
    plait::SimDesc sim = scene.sim;
    if (sim.model != PLAIT_MODEL_TRESSFX)
        sim.tressfx = scene.tressfx;
    sim.model = PLAIT_MODEL_TRESSFX;
    sim.sag_free = PLAIT_SAG_FREE_OFF; // its shape constraints know no sag
    sim.grid.on = false;
    sim.volume.on = sim.strand_contact.on = sim.wetness.on = false; // which it refuses
    return sim;
}

plait::SimDesc without_volume(plait::SimDesc sim) {
    sim.volume.on = false;
    return sim;
}

// With the thesis's ratio and factor, unless the scene gives its own.
plait::SimDesc tressfx_and_thesis(const Scene& scene) {
    plait::SimDesc sim = tressfx_alone(scene);
    sim.grid.on = true;
    sim.grid.form = PLAIT_GRID_FORM_SLOTS;
    sim.grid.slot_hash = PLAIT_SLOT_HASH_RULE_THESIS;
    sim.grid.diffuse_rule = PLAIT_DIFFUSE_RULE_THESIS;
    sim.grid.diffuse_ratio = scene.unhung.grid.diffuse_ratio;
    sim.grid.diffuse_factor = scene.unhung.grid.diffuse_factor;
    return sim;
}

} // namespace

// ", within 4 ms"
std::string within(const CrowdChoice& crowd) {
    char text[32];
    std::snprintf(text, sizeof text, ", within %g ms", static_cast<double>(crowd.budget_ms));
    return text;
}

std::string Variant::short_label() const {
    return label == label_of(sim) ? short_label_of(sim) : label;
}

Scene Variant::of(Scene scene) const {
    scene.sim = sim;
    scene.detail = detail;
    scene.crowd = {};
    if (dry)
        scene.wetness.clear();
    scene.profile = false;
    scene.trace.clear();
    return scene;
}

std::string label_of(const plait::SimDesc& sim) {
    std::string label = sim.model == PLAIT_MODEL_TRESSFX ? "TressFX" : model_names[sim.model];
    if (!sim.grid.on && !sim.volume.on)
        return label;
    if (has_thesis_step(sim))
        return label + " + inter-hair step of the thesis";
    if (sim.volume.on)
        return label + " + volume";
    return label + " + inter-hair step (" + grid_name(sim) + ")";
}

std::string label_of(const Scene& scene) {
    std::string label = label_of(scene.sim);
    if (!scene.wetness.empty())
        label += ", wet";
    if (scene.crowd.directed())
        label += within(scene.crowd);
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

std::string short_label_of(const plait::SimDesc& sim) {
    const std::string model = sim.model == PLAIT_MODEL_TRESSFX ? "TressFX" : model_names[sim.model];
    if (sim.volume.on)
        return model + " + volume";
    return has_thesis_step(sim) ? model + " + thesis's step" : model;
}

std::string tressfx_settings(const Scene& scene) {
    const plait_tressfx_desc& p =
        scene.sim.model == PLAIT_MODEL_TRESSFX ? scene.sim.tressfx : scene.tressfx;
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
    if (scene.crowd.directed())
        return {{"all strands", scene.sim, scene.detail}};
    if (!scene.wetness.empty())
        return {{label_of(scene.sim) + ", dry", scene.sim, scene.detail, true}};
    const bool own = scene.sim.model == PLAIT_MODEL_TRESSFX;
    std::vector<Variant> variants;
    const auto add = [&](const plait::SimDesc& sim) {
        variants.push_back({label_of(sim), sim, scene.detail});
    };
    if (!own || scene.sim.grid.on)
        add(tressfx_alone(scene));
    if (!own || !has_thesis_step(scene.sim))
        add(tressfx_and_thesis(scene));
    if (scene.sim.volume.on)
        add(without_volume(scene.sim));
    return variants;
}

} // namespace simulate
