// plait-lab features: what each feature costs, and does.
#include "commands.hpp"
#include "common/json_reader.hpp"
#include "features.hpp"

#include <iostream>

namespace lab {

namespace {

using Options = TableCommand<FeatureOptions>;

Exit run(const Options& options) {
    const FeatureRun done = run_features(options.on_device());
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
    add_table_options(*command, *options);
    add_cost_options(*command, options->run.costs);
    command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

} // namespace lab
