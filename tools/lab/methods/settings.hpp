// The settings a method is run with on a scene: of explicit baselines as many substeps as they
// need.
#pragma once

#include "models.hpp"
#include "scene/scene.hpp"

namespace lab {

constexpr uint32_t most_substeps = 1000; // the library's own limit

// Of the scene's stiffest motion, rad/s: a segment's stretch, or bending over two segments.
double stiffest(const Scene& scene);

// Of an explicit method at w rad/s and so many steps a second: 0.9 of the longest step it bears.
uint32_t substeps_of(const Model& model, double rate, double w);

// With nothing left to the scene: as many substeps of an explicit method as it needs, at most 1000.
Setting resolved(const Model& model, const Setting& setting, const Scene& scene);
// What a model is run with where the scene asks for nothing: the first of its settings.
Setting default_setting(const Model& model, const Scene& scene);
// What is drawn: the model's settings; of explicit methods the default, half and twice its
// substeps.
std::vector<Setting> settings_of(const Model& model, const Scene& scene);

} // namespace lab
