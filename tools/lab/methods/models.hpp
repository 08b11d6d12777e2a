// What can be run: the library's models, and baselines, which replace one stage by a kernel of
// ours.
#pragma once

#include "common.hpp"

#include <optional>
#include <string>
#include <vector>

namespace lab {

// One way to spend time on accuracy.
struct Setting {
    uint32_t substeps = 1; // 0: as many as an explicit method needs on the scene
    uint32_t iterations = 1;
    bool bdf2 = false;
    std::string label() const; // "4x2 BDF2": substeps x iterations; "auto": as many as it needs
    bool operator==(const Setting&) const = default;
};

struct Model {
    std::string label;
    plait_model model;
    const char* stage;  // what a baseline replaces; null: nothing
    std::string source; // its kernel, a file in baselines/
    std::string define; // what it is built with, if anything
    bool bends, twists;
    bool half_tip;                       // masses: half a segment's at the tip, or a whole one
    uint32_t pinned;                     // vertices
    std::vector<Setting> settings;       // of the charts; the first is the one for real time
    std::optional<Setting> quality = {}; // for accuracy at several times the cost
    // Of explicit methods: the longest step, s, borne by a motion of w rad/s.
    double (*longest_step)(double w) = nullptr;
    bool pins = false; // takes them

    bool baseline() const { return stage != nullptr; }
};

const std::vector<Model>& models();
const Model* find_model(const std::string& label); // null: none
const Model& default_model();                      // the library's own default
const std::vector<std::string>& model_labels();

// What to run a scene with: a model and how.
struct Method {
    const Model* model;
    Setting setting;
    std::string label() const { return model->label + " " + setting.label(); }
};

// Contexts, made when first needed, one for each baseline, which are kernels: on OpenCL whatever the
// backend of the others is. Making one may compile for seconds.
class Contexts {
  public:
    Contexts(std::string backend, std::string device, bool profile = false);
    ~Contexts();
    plait_context* of(const Model& model);
    plait_device_info device();

  private:
    std::string backend_, device_;
    bool profile_;
    std::vector<std::pair<std::string, ContextHandle>> made_; // by baseline; "": the library's
};

} // namespace lab
