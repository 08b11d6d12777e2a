// What a scene of assets/lab measures first, with a method, on OpenCL.
#pragma once

#include "common/json_reader.hpp"
#include "metrics/metrics.hpp"
#include "run/recording.hpp"
#include "scene/scene.hpp"

namespace plait::test {

inline lab::Value measured(const char* file, const char* label, const lab::Setting& setting,
                           const lab::Json& overrides = lab::Json::object()) {
    static lab::Contexts contexts("opencl", "");
    const lab::Scene scene = lab::read_scene(std::string(PLAIT_SCENES "/") + file, overrides);
    const lab::Method method{lab::find_model(label), setting};
    return lab::evaluate(scene, method, record(contexts, scene, method), scene.measures[0]);
}

} // namespace plait::test
