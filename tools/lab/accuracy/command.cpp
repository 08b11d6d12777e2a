// plait-lab accuracy: the table.
#include "accuracy.hpp"
#include "commands.hpp"

#include "common/file.hpp"
#include "common/json_reader.hpp"

#include <iostream>

namespace lab {

namespace {

using Options = TableCommand<AccuracyOptions>;

Exit run(const Options& options) {
    const AccuracyRun done = run_accuracy(options.on_device());
    Json all = Json::array();
    for (const Result& result : done.results)
        all.push_back(to_json(result));
    if (options.print.json)
        std::cout << all.dump(2) << '\n';
    else if (options.print.csv)
        std::cout << csv_of(done.results);
    else
        std::cout << accuracy_text(done) << "wrote " << options.run.out << "/accuracy.csv\n";
    write_text(accuracy_markdown(done), options.run.out + "/accuracy.md");
    return Exit::ok;
}

} // namespace

void add_accuracy(CLI::App& app, Command& chosen) {
    auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("accuracy", "every row of the accuracy table");
    command->add_option("--rows", options->run.rows, "only these, say 1,4,18")->delimiter(',');
    command->add_option("--table", options->run.table, "the rows [assets/lab/accuracy.json]");
    command->add_flag("--baselines", options->run.baselines, "the baselines, too");
    command->add_flag("--all-settings", options->run.all_settings,
                      "all settings of a model, not only for real time and for quality");
    add_table_options(*command, *options);
    command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

} // namespace lab
