// plait-lab stability: where methods fail, as a map.
#include "command.hpp"
#include "search.hpp"

#include "common/file.hpp"
#include "common/json_reader.hpp"

#include <cstdio>
#include <iostream>

namespace lab {

using namespace stability;

namespace {

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

} // namespace

Exit run(const Command<SweepOptions>& command) {
    const SweepOptions& options = command.run;
    Contexts contexts(command.device.backend, command.device.device);
    const Sweep done = sweep(options, contexts);
    const auto verdicts = try_bad_inputs(options, contexts);
    const Json json{
        {"device", done.device}, {"trials", to_json(done.rows)}, {"bad_input", to_json(verdicts)}};
    write_json(json, options.out + "/stability.json");
    if (command.print.json) {
        std::cout << json_text(json);
    } else if (command.print.csv) {
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

} // namespace lab
