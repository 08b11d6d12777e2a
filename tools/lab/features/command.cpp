// plait-lab features: what each feature costs, and does.
#include "command.hpp"
#include "features.hpp"

#include <iostream>

namespace lab {

Exit run(const Command<FeatureOptions>& command) {
    const FeatureRun done = run_features(command.on_device());
    if (command.print.json)
        std::cout << features_json(done);
    else if (command.print.csv)
        std::cout << features_csv(done);
    else
        std::cout << features_text(done) << "wrote " << command.run.out << "/features.csv\n";
    return Exit::ok;
}

} // namespace lab
