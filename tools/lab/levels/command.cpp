// plait-lab levels: levels of detail, error over cost.
#include "command.hpp"
#include "levels.hpp"

#include "common/file.hpp"

#include <cstdio>

namespace lab {

using namespace levels;

Exit run(const Command<LevelsOptions>& command) {
    const LevelsOptions& options = command.run;
    Contexts contexts(command.device.backend, command.device.device);
    const auto rows = measure_levels(contexts, options);
    std::fputs((command.print.csv ? levels_csv(rows) : levels_text(rows)).c_str(), stdout);
    make_folder(options.out);
    write_text(levels_csv(rows), options.out + "/levels.csv");
    draw_levels(rows, options);
    if (options.transfer) {
        const auto transfers = transfer_of(rows);
        if (!command.print.csv)
            std::printf("\n%s", transfer_text(transfers).c_str());
        write_text(transfer_csv(rows), options.out + "/transfer.csv");
    }
    return Exit::ok;
}

} // namespace lab
