#include "settings.hpp"

#include "metrics/input.hpp"

#include <algorithm>
#include <cmath>

namespace lab {

double stiffest(const Scene& scene) {
    double w = 0;
    const Material& m = scene.material;
    for (const Strand& strand : scene.strands) {
        const double EA = stretch_stiffness(scene, strand.length);
        for (const double l : strand.segment_lengths())
            w = std::max({w, 2 * std::sqrt(EA / m.line_density) / l,
                          4 * std::sqrt(scene.bend_stiffness(strand) / m.line_density) / (l * l)});
    }
    return w;
}

uint32_t substeps_of(const Model& model, double rate, double w) {
    const double steps = std::ceil(1 / (rate * 0.9 * model.longest_step(w)));
    return static_cast<uint32_t>(std::clamp(steps, 1.0, 1.0 * most_substeps));
}

Setting resolved(const Model& model, const Setting& setting, const Scene& scene) {
    Setting own = setting;
    if (own.substeps == 0)
        own.substeps = substeps_of(model, scene.rate, stiffest(scene));
    return own;
}

Setting default_setting(const Model& model, const Scene& scene) {
    return resolved(model, model.settings.front(), scene);
}

std::vector<Setting> settings_of(const Model& model, const Scene& scene) {
    if (!model.longest_step)
        return model.settings;
    const Setting own = default_setting(model, scene);
    std::vector<Setting> all{own, own, own};
    all[1].substeps = std::max(1u, own.substeps / 2);
    all[2].substeps = std::min(most_substeps, 2 * own.substeps);
    return all;
}

} // namespace lab
