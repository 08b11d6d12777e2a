// Many scenes, one after another or shared out over the tasks of a job array.
#pragma once

#include "common.hpp"
#include "common/json_reader.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace simulate {

// Of `of` tasks that share out scenes.
struct Part {
    uint32_t number = 1, of = 1; // number: from 1 on
};

// "2/5". Throws Failure.
Part read_part(const std::string& text);

// A scene file among others.
struct SceneJob {
    std::string file;
    std::string name; // of the file, without folder and .json; "": the only scene there is
    Json keys;        // the command line's, with the places of what this scene leaves
};

// Without a part and with one scene or none: that scene, whose results lie in `out`. Else every scene has its folder
// in `out`, and of the scenes a part has every N-th. Throws Failure where two would have the same folder.
std::vector<SceneJob> scene_jobs(const std::vector<std::string>& files, const Json& keys,
                                 const std::optional<Part>& part);

// Does `work` of each, whichever of them fail, and says at last which did. Ends after the present one where it is
// interrupted.
Exit do_all(const std::vector<SceneJob>& jobs, const std::function<void(const SceneJob&)>& work);

} // namespace simulate
