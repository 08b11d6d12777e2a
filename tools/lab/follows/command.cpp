// plait-lab follows: hair of which some is simulated, against all of it.
#include "command.hpp"
#include "follows.hpp"

#include "common/file.hpp"

#include <cstdio>

namespace lab {

using namespace follows;

Exit run(const Command<FollowOptions>& command) {
    const FollowOptions& options = command.run;
    Contexts contexts(command.device.backend, command.device.device);
    const auto rows = measure_follows(contexts, options);
    std::fputs((command.print.csv ? follows_csv(rows) : follows_text(rows)).c_str(), stdout);
    const std::string path = options.out + "/follows";
    make_folder(options.out);
    write_text(follows_csv(rows), path + ".csv");
    write_text(follows_curves(rows), path + "_curves.csv");
    draw_follows(rows, options);
    return Exit::ok;
}

} // namespace lab
