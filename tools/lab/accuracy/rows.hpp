// The rows of the accuracy table, as assets/lab/accuracy.json has them: a scene, what is varied in
// it, what is measured, and the mark that passes.
#pragma once

#include "common/json_reader.hpp"
#include "methods/models.hpp"
#include "scene/scene.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace lab {

struct Variant {
    std::string name;
    Json overrides = Json::object(); // of the scene
};

struct Row {
    std::string id, title;
    std::string scene; // file
    std::vector<Variant> variants;
    Json measure;        // as in a scene
    bool spread = false; // one number of all variants: how far their resting shapes differ
    std::vector<std::string> needs;
    std::optional<Variant> over = {}; // what is measured counts over the same there, less 1
};

// "" or why the model cannot do the row: it lacks what the row needs.
std::string why_not(const Row& row, const Model& model);

std::vector<Row> read_rows(const std::string& file);

// The row's scene in one variant, measuring what the row does, and what identifies all of that.
struct RowScene {
    Scene scene;
    std::string fingerprint;
};
RowScene scene_of(const Row& row, const Variant& variant);

} // namespace lab
