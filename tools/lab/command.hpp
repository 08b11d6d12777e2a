// The commands of plait-lab: each is a room with a file command.cpp; its options are read by command_line.cpp.
#pragma once

#include "common.hpp"

#include <string>

namespace lab {

struct DeviceOptions {
    std::string device, backend;
};
// Tables for people, unless one of these is set.
struct Print {
    bool json = false, csv = false;
};
// What a command measures, on which device, and how it prints it.
template <typename Options> struct Command {
    Options run;
    DeviceOptions device;
    Print print;

    // The options of a command that makes its contexts itself.
    Options on_device() const {
        Options chosen = run;
        chosen.device = device.device;
        chosen.backend = device.backend;
        return chosen;
    }
};

struct AccuracyOptions;
struct AllOptions;
struct ChartOptions;
struct FeatureOptions;
struct RunOptions;
namespace follows {
struct FollowOptions;
}
namespace grid {
struct GridOptions;
}
namespace levels {
struct LevelsOptions;
}
namespace stability {
struct SweepOptions;
}
namespace volume {
struct VolumeOptions;
}

Exit run(const Command<AccuracyOptions>& command);
Exit run(const Command<AllOptions>& command);
Exit run(const Command<ChartOptions>& command);
Exit run(const Command<FeatureOptions>& command);
Exit run(const Command<RunOptions>& command);
Exit run(const Command<follows::FollowOptions>& command);
Exit run(const Command<grid::GridOptions>& command);
Exit run(const Command<levels::LevelsOptions>& command);
Exit run(const Command<stability::SweepOptions>& command);
Exit run(const Command<volume::VolumeOptions>& command);

} // namespace lab
