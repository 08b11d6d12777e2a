// plait-lab features: what each feature costs, and does.
#include "commands.hpp"
#include "features.hpp"

#include <iostream>

namespace lab {

namespace {

struct Options {
    FeatureOptions run;
    DeviceOptions device;
    Print print;
};

Exit run(Options options) {
    options.run.device = options.device.device;
    options.run.backend = options.device.backend;
    const FeatureRun done = run_features(options.run);
    if (options.print.json)
        std::cout << to_json(done).dump(2) << '\n';
    else if (options.print.csv)
        std::cout << features_csv(done);
    else
        std::cout << features_text(done) << "wrote " << options.run.out << "/features.csv\n";
    return Exit::ok;
}

} // namespace

void add_features(CLI::App& app, Command& chosen) {
    auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("features", "what each feature costs, and does");
    command->add_option("--features", options->run.features, "only these")->delimiter(',');
    command->add_option("--table", options->run.table, "the features [assets/lab/features.json]");
    add_choice(*command, options->run);
    add_scenes(*command, options->run);
    add_print(*command, options->print);
    add_cost_options(*command, options->run.costs);
    add_device_options(*command, options->device);
    command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

} // namespace lab
