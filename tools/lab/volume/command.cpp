// plait-lab volume: ways of keeping hair's volume, side by side.
#include "command.hpp"
#include "volume.hpp"

#include "common/file.hpp"

#include <cstdio>

namespace lab {

using namespace volume;

Exit run(const Command<VolumeOptions>& command) {
    const VolumeOptions& options = command.run;
    Contexts contexts(command.device.backend, command.device.device);
    const auto rows = measure_volume(contexts, options);
    std::fputs((command.print.csv ? volume_csv(rows) : volume_text(rows)).c_str(), stdout);
    const std::string path = options.out + "/volume";
    make_folder(options.out);
    write_text(volume_csv(rows), path + ".csv");
    write_text(volume_curves(rows), path + "_curves.csv");
    draw_volume(rows, options);
    return Exit::ok;
}

} // namespace lab
