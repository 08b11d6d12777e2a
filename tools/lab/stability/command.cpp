// plait-lab stability: where methods fail, as a map.
#include "commands.hpp"
#include "search.hpp"

#include "common/file.hpp"
#include "common/json_reader.hpp"

#include <cstdio>
#include <iostream>

namespace lab::stability {

namespace {

struct Options {
    SweepOptions sweep;
    DeviceOptions device;
    Print print;
};

void print_verdicts(const Verdicts& verdicts) {
    std::puts("\nbad input");
    for (const auto& [model, verdict] : verdicts)
        std::printf("  %-4s %-10s %-32s %s\n", verdict.passed ? "ok" : "FAIL", model.c_str(),
                    verdict.input.c_str(), verdict.what.c_str());
}

Json to_json(const Verdicts& verdicts) {
    Json all = Json::array();
    for (const auto& [model, verdict] : verdicts)
        all.push_back({{"model", model},
                       {"input", verdict.input},
                       {"passed", verdict.passed},
                       {"what", verdict.what}});
    return all;
}

Exit run_sweep(const Options& options) {
    Contexts contexts(options.device.backend, options.device.device);
    const Sweep done = sweep(options.sweep, contexts);
    const auto verdicts = try_bad_inputs(options.sweep, contexts);
    const Json json{
        {"device", done.device}, {"trials", to_json(done.rows)}, {"bad_input", to_json(verdicts)}};
    write_json(json, options.sweep.out + "/stability.json");
    if (options.print.json) {
        std::cout << json.dump(2) << '\n';
    } else if (options.print.csv) {
        write_csv(std::cout, done.rows);
    } else {
        std::printf("%s\n", done.device.c_str());
        print_map(done.rows);
        print_axes(done.rows);
        print_count(done.rows);
        if (!verdicts.empty())
            print_verdicts(verdicts);
    }
    return Exit::ok;
}

} // namespace

} // namespace lab::stability

namespace lab {

void add_stability(CLI::App& app, Command& chosen) {
    auto options = std::make_shared<stability::Options>();
    CLI::App* command =
        app.add_subcommand("stability", "shake models and baselines till they fail");
    command
        ->add_option("--models", options->sweep.models,
                     "models and baselines [tressfx,articulated,chain,cosserat,rod]")
        ->delimiter(',');
    command
        ->add_option("--scenes", options->sweep.scenes,
                     "of these only: " + CLI::detail::join(stability::scene_names(), ", "))
        ->delimiter(',');
    command
        ->add_option("--out", options->sweep.out,
                     "folder of what is found; a run goes on from there")
        ->capture_default_str();
    add_device_options(*command, options->device);
    command->add_flag("--full", options->sweep.full,
                      "all rates, segments, gammas and settings: hours");
    command->add_flag("--fresh", options->sweep.fresh, "forget what an earlier run found");
    add_print(*command, options->print);
    command->add_flag("!--no-pictures", options->sweep.pictures, "do not call gnuplot");
    command->callback(
        [options, &chosen] { chosen = [options] { return stability::run_sweep(*options); }; });
}

} // namespace lab
