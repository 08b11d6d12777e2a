// plait-lab all: the table, the figures, the features, stability, and a page of them.
#include "command.hpp"
#include "page.hpp"

#include "common/progress.hpp"

#include <cstdio>
#include <iostream>

namespace lab {

namespace {

stability::SweepOptions stability_options(const AllOptions& o) {
    stability::SweepOptions sweep;
    sweep.models.clear();
    for (const Model* model : models_of(o.choice.models, true))
        sweep.models.push_back(model->label);
    sweep.out = o.choice.out;
    sweep.fresh = o.choice.fresh;
    sweep.few_baselines = true;
    return sweep;
}

// Those that were models once, and of the others of each kind the cheapest, some minutes. None where models are named.
AccuracyRun run_baselines(const AllOptions& o) {
    if (!o.choice.models.empty())
        return {};
    AccuracyOptions options = o.accuracy;
    options.models = {"chain", "cosserat",   "rod",         "pbd",
                      "xpbd",  "xpbd_heavy", "verlet_limp", "verlet"};
    return run_accuracy(options);
}

// One after the other, until somebody interrupts.
Page measure_all(const AllOptions& o, const DeviceOptions& device) {
    Page page;
    page.accuracy = run_accuracy(o.accuracy);
    std::cout << accuracy_text(page.accuracy) << std::endl;
    if (!interrupted())
        page.baselines = run_baselines(o);
    if (!page.baselines.methods.empty())
        std::cout << accuracy_text(page.baselines) << std::endl;
    if (!interrupted())
        page.charts = run_charts(o.charts);
    for (const std::string& file : page.charts.files)
        std::printf("wrote %s\n", file.c_str());
    if (!interrupted()) {
        Contexts contexts(device.backend, device.device);
        page.grid = grid::run_grid(contexts, o.choice.out, o.charts.costs);
        std::cout << grid::rows_text(page.grid.rows);
    }
    if (!interrupted())
        page.features = run_features(o.features);
    std::cout << features_text(page.features);
    if (!interrupted()) {
        const auto options = stability_options(o);
        Contexts contexts(device.backend, device.device);
        page.stability = sweep(options, contexts);
        page.places = grid_of(options);
        page.bad_input = try_bad_inputs(options, contexts);
        print_count(page.stability.rows);
    }
    return page;
}

} // namespace

Exit run(const Command<AllOptions>& command) {
    AllOptions o = command.run;
    o.accuracy.device = o.charts.device = o.features.device = command.device.device;
    o.accuracy.backend = o.charts.backend = o.features.backend = command.device.backend;
    for (Choice* choice : {static_cast<Choice*>(&o.accuracy), static_cast<Choice*>(&o.charts),
                           static_cast<Choice*>(&o.features)})
        *choice = o.choice;
    const Page page = measure_all(o, command.device);
    if (o.write.empty())
        return Exit::ok;
    if (interrupted())
        throw Failure("interrupted: no page is written of half a run; the same command takes it up",
                      ended());
    for (const std::string& file : write_page(o.write, page, o.choice.out))
        std::printf("wrote %s\n", file.c_str());
    return Exit::ok;
}

} // namespace lab
