#include "models.hpp"

#include "baselines/source.hpp"

#include <plait/plait.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lab {

namespace {

// How long a step the explicit ones bear at w, rad/s, with the springs' lag t in s
// (baselines/mass_spring.clh): x'' = -w^2 (x + t x'). Explicit Euler and Verlet by the roots of
// their recurrences; midpoint gains (h w)^4/8 a step, which the lag takes out as h t w^2/2;
// Runge-Kutta 4 by its own limit.
constexpr double lag = 2e-5, euler_lag = 1e-4;

double euler_step(double w) {
    const double rest = euler_lag * euler_lag - 4 / (w * w);
    return euler_lag - (rest > 0 ? std::sqrt(rest) : 0);
}
double midpoint_step(double w) {
    return std::cbrt(4 * lag / (w * w));
}
double runge_kutta_step(double w) {
    return 2 * std::numbers::sqrt2 / w;
}
double verlet_step(double w) { // (h w)^2 + 2 h t w^2 < 4
    return std::sqrt(lag * lag + 4 / (w * w)) - lag;
}

// Every baseline takes the place of the stage `articulated`.
Model baseline(std::string label, std::string source, bool bends, bool twists,
               std::vector<Setting> settings) {
    return {std::move(label),
            PLAIT_MODEL_ARTICULATED,
            "articulated",
            std::move(source),
            "",
            bends,
            twists,
            true,
            1,
            std::move(settings)};
}

Model explicit_one(const char* name, bool bends, double (*longest_step)(double)) {
    Model model = baseline(std::string(name) + (bends ? "" : "_limp"), std::string(name) + ".cl",
                           bends, false, {{0, 1, false}});
    model.define = bends ? "" : "SPRING_LIMP";
    model.longest_step = longest_step;
    return model;
}

// tools/lab/docs/baselines.md says what they are.
std::vector<Model> make_baselines() {
    const std::vector<Setting> pbd{{20, 1, false}, {1, 2, false},  {1, 10, false}, {1, 50, false},
                                   {5, 1, false},  {10, 1, false}, {50, 1, false}, {100, 1, false}};
    const std::vector<Setting> xpbd{{20, 1, false}, {1, 4, false},  {1, 20, false},
                                    {6, 1, false},  {50, 1, false}, {100, 1, false}};
    std::vector<Model> all{baseline("pbd", "pbd.cl", false, false, pbd),
                           baseline("xpbd", "xpbd.cl", true, true, xpbd),
                           baseline("xpbd_heavy", "xpbd_heavy.cl", true, true, xpbd)};
    for (const bool bends : {false, true}) {
        all.push_back(explicit_one("explicit_euler", bends, euler_step));
        all.push_back(explicit_one("rk2", bends, midpoint_step));
        all.push_back(explicit_one("rk4", bends, runge_kutta_step));
        all.push_back(explicit_one("verlet", bends, verlet_step));
    }
    return all;
}

// What were models of plait, and are measured against.
std::vector<Model> make_retired() {
    const std::vector<Setting> chain{{1, 1, false},  {1, 0, false}, {2, 1, false}, {4, 1, false},
                                     {4, 0, false},  {8, 1, false}, {1, 1, true},  {4, 1, true},
                                     {16, 1, false}, {16, 1, true}};
    const std::vector<Setting> cosserat{{1, 3, false}, {1, 1, false}, {1, 2, false}, {1, 5, false},
                                        {2, 2, false}, {4, 2, false}, {1, 3, true},  {2, 2, true},
                                        {4, 2, true},  {8, 2, true},  {16, 2, true}};
    const std::vector<Setting> rod{{1, 1, false}, {1, 2, false}, {2, 1, false},
                                   {4, 1, false}, {1, 1, true},  {2, 1, true},
                                   {4, 1, true},  {8, 1, true},  {16, 1, true}};
    std::vector<Model> all{baseline("chain", "chain.cl", false, false, chain),
                           baseline("cosserat", "cosserat.cl", true, true, cosserat),
                           baseline("rod", "rod.cl", true, true, rod)};
    const Setting quality[] = {{4, 1, false}, {4, 2, true}, {2, 1, true}};
    for (size_t i = 0; i < all.size(); ++i) {
        all[i].quality = quality[i];
        all[i].pins = true;
    }
    return all;
}

std::vector<Model> make_models() {
    const std::vector<Setting> tressfx{{1, 2, false},  {2, 2, false},  {4, 2, false},
                                       {8, 2, false},  {1, 8, false},  {1, 32, false},
                                       {4, 32, false}, {16, 2, false}, {1, 128, false}};
    const std::vector<Setting> articulated{{1, 1, true}, {1, 1, false}, {1, 2, true}, {2, 1, true},
                                           {4, 1, true}, {8, 1, true},  {16, 1, true}};
    const Setting quality[] = {{1, 32, false}, {2, 1, true}};
    std::vector<Model> all{
        {"tressfx", PLAIT_MODEL_TRESSFX, nullptr, "", "", true, false, false, 2, tressfx},
        {"articulated", PLAIT_MODEL_ARTICULATED, nullptr, "", "", true, true, true, 1, articulated},
    };
    for (size_t i = 0; i < all.size(); ++i)
        all[i].quality = quality[i];
    all[1].pins = true;
    for (Model& retired : make_retired())
        all.push_back(std::move(retired));
    for (Model& baseline : make_baselines())
        all.push_back(std::move(baseline));
    return all;
}

} // namespace

std::string Setting::label() const {
    if (substeps == 0)
        return "auto";
    return std::to_string(substeps) + "x" + std::to_string(iterations) + (bdf2 ? " BDF2" : "");
}

const std::vector<Model>& models() {
    static const std::vector<Model> all = make_models();
    return all;
}

const Model* find_model(const std::string& label) {
    for (const Model& model : models())
        if (model.label == label)
            return &model;
    return nullptr;
}

const Model& default_model() {
    const plait_model wanted = plait::SimDesc().model;
    for (const Model& model : models())
        if (model.model == wanted && !model.baseline())
            return model;
    throw Failure("the library's default is model " + std::to_string(wanted) +
                  ", which is not in the list");
}

const std::vector<std::string>& model_labels() {
    static const std::vector<std::string> labels = [] {
        std::vector<std::string> names;
        for (const Model& model : models())
            names.push_back(model.label);
        return names;
    }();
    return labels;
}

Contexts::Contexts(std::string backend, std::string device, bool profile)
    : backend_(std::move(backend)), device_(std::move(device)), profile_(profile) {}

Contexts::~Contexts() = default;

plait_context* Contexts::of(const Model& model) {
    const std::string key = model.baseline() ? model.label : "";
    for (const auto& [made, context] : made_)
        if (made == key)
            return context.get();
    plait_context_desc desc = plait_context_desc_defaults();
    desc.backend = model.baseline() ? "opencl" : backend_.empty() ? nullptr : backend_.c_str();
    desc.device = device_.empty() ? nullptr : device_.c_str();
    desc.profile = profile_;
    std::string text = model.define.empty() ? "" : "#define " + model.define + "\n";
    if (model.baseline())
        text += baseline_source(PLAIT_LAB_KERNELS, model.source);
    const plait_stage_source source{model.stage, text.c_str(), model.source.c_str()};
    if (model.baseline()) {
        desc.stage_sources = &source;
        desc.stage_source_count = 1;
    }
    plait_context* context = nullptr;
    check(plait_context_create(&desc, &context));
    made_.emplace_back(key, ContextHandle(context));
    return context;
}

plait_device_info Contexts::device() {
    plait_device_info info = plait_device_info_defaults();
    check(plait_context_describe(made_.empty() ? of(models().front()) : made_[0].second.get(),
                                 &info));
    return info;
}

} // namespace lab
