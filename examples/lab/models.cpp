#include "models.hpp"

#include "baselines/source.hpp"

#include <algorithm>

namespace lab {

namespace {

// As many substeps as a strand of 16 segments needs, and more; see docs/baselines.md.
std::vector<Model> make_baselines() {
    const std::vector<Setting> explicit_euler{{256, 1, false}, {512, 1, false}, {1000, 1, false}};
    const std::vector<Setting> rk2{{128, 1, false}, {64, 1, false}, {256, 1, false}};
    const std::vector<Setting> rk4{
        {64, 1, false}, {16, 1, false}, {32, 1, false}, {48, 1, false}, {128, 1, false}};
    const std::vector<Setting> verlet{
        {64, 1, false}, {16, 1, false}, {32, 1, false}, {48, 1, false}, {128, 1, false}};
    const std::vector<Setting> pbd{{1, 10, false}, {1, 2, false},  {1, 50, false}, {5, 1, false},
                                   {10, 1, false}, {20, 1, false}, {50, 1, false}, {100, 1, false}};
    const std::vector<Setting> xpbd{{20, 1, false}, {1, 4, false},  {1, 20, false},
                                    {6, 1, false},  {50, 1, false}, {100, 1, false}};
    constexpr plait_model limp = PLAIT_MODEL_CHAIN, rod = PLAIT_MODEL_COSSERAT;
    return {
        {"pbd", limp, "chain", "pbd.cl", false, false, false, 1, pbd, nullptr},
        {"explicit_euler_limp", limp, "chain", "explicit_euler.cl", false, false, false, 1,
         explicit_euler, nullptr},
        {"rk2_limp", limp, "chain", "rk2.cl", false, false, false, 1, rk2, nullptr},
        {"rk4_limp", limp, "chain", "rk4.cl", false, false, false, 1, rk4, nullptr},
        {"verlet_limp", limp, "chain", "verlet.cl", false, false, false, 1, verlet, nullptr},
        {"explicit_euler", rod, "cosserat", "explicit_euler.cl", true, false, true, 1,
         explicit_euler, nullptr},
        {"rk2", rod, "cosserat", "rk2.cl", true, false, true, 1, rk2, nullptr},
        {"rk4", rod, "cosserat", "rk4.cl", true, false, true, 1, rk4, nullptr},
        {"verlet", rod, "cosserat", "verlet.cl", true, false, true, 1, verlet, nullptr},
        {"xpbd", rod, "cosserat", "xpbd.cl", true, true, true, 1, xpbd, nullptr},
        {"xpbd_heavy", rod, "cosserat", "xpbd_heavy.cl", true, true, true, 1, xpbd, nullptr},
    };
}

std::vector<Model> make_models() {
    const std::vector<Setting> tressfx{{1, 2, false},  {2, 2, false},  {4, 2, false},
                                       {8, 2, false},  {1, 8, false},  {1, 32, false},
                                       {4, 32, false}, {16, 2, false}, {1, 128, false}};
    const std::vector<Setting> chain{{1, 1, false},  {1, 0, false}, {2, 1, false}, {4, 1, false},
                                     {4, 0, false},  {8, 1, false}, {1, 1, true},  {4, 1, true},
                                     {16, 1, false}, {16, 1, true}};
    const std::vector<Setting> cosserat{{1, 3, false}, {1, 1, false}, {1, 2, false}, {1, 5, false},
                                        {2, 2, false}, {4, 2, false}, {1, 3, true},  {2, 2, true},
                                        {4, 2, true},  {8, 2, true},  {16, 2, true}};
    const std::vector<Setting> rod{{1, 1, false}, {1, 2, false}, {2, 1, false},
                                   {4, 1, false}, {1, 1, true},  {2, 1, true},
                                   {4, 1, true},  {8, 1, true},  {16, 1, true}};
    std::vector<Model> all{
        {"tressfx", PLAIT_MODEL_TRESSFX, nullptr, nullptr, true, false, false, 2, tressfx, nullptr},
        {"chain", PLAIT_MODEL_CHAIN, nullptr, nullptr, false, false, false, 1, chain, nullptr},
        {"cosserat", PLAIT_MODEL_COSSERAT, nullptr, nullptr, true, true, true, 1, cosserat,
         nullptr},
        {"rod", PLAIT_MODEL_ROD, nullptr, nullptr, true, true, true, 1, rod, nullptr},
    };
    const Setting quality[] = {{1, 32, false}, {4, 1, false}, {4, 2, true}, {2, 1, true}};
    for (size_t i = 0; i < all.size(); ++i)
        all[i].quality = quality[i];
    for (Model& baseline : make_baselines())
        all.push_back(std::move(baseline));
    return all;
}

} // namespace

std::string Setting::label() const {
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
    desc.backend = backend_.empty() ? nullptr : backend_.c_str();
    desc.device = device_.empty() ? nullptr : device_.c_str();
    desc.profile = profile_;
    const std::string text =
        model.baseline() ? baseline_source(PLAIT_LAB_KERNELS, model.source) : "";
    const plait_stage_source source{model.stage, text.c_str(), model.source};
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
