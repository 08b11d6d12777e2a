// A strand's way in the limit of many segments: what E_total is measured from.
#pragma once

#include "scene/scene.hpp"

namespace lab {

// Places along the strand that are compared: eighths of its length, where 8, 16, ... segments meet.
constexpr uint32_t places = 8;

struct Continuum {
    std::vector<double> times;             // s
    std::vector<std::vector<Vec3>> points; // at each of them: the places, from the root, m
    double error = 0;                      // that it may still have, rms / L; see continuum_of()
};

// A scene's strand by `reference.converged` in float64, from `reference.segments` and half of them
// extrapolated: order 2 where the tip has half a mass, else 1. Its error is taken to be that of the
// finer one, by how far the limit is from it, and what the coarser moves by when its step is
// doubled. Run once a process for each scene. No times: somebody interrupted.
const Continuum& continuum_of(const Scene& scene, const Reference& reference, uint32_t strand);

} // namespace lab
