#include "options.hpp"
#include "common/json_reader.hpp"
#include "common/params_reader.hpp"

#include <CLI/CLI.hpp>

#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace simulate {

namespace {

constexpr const char* footer =
    "Leaves in --out: sheet.png (the motion), ab.png (beside TressFX, "
    "and TressFX with the thesis's\n"
    "inter-hair step), the film motion.mp4, or motion.gif where there is "
    "no ffmpeg, and\n"
    "stats.json. Ctrl-C ends early and keeps what there is.\n"
    "Exit codes: 0 done, 1 the input is at fault, 2 the device is, 130 Ctrl-C ended it early.";

// An option that becomes the scene-file key `key`.
template <typename T>
void option(CLI::App& app, Json& keys, const char* flag, const char* key, const char* type,
            const char* help) {
    app.add_option_function<T>(
           flag,
           [&keys, key, flag](const T& value) {
               if constexpr (std::is_floating_point_v<T>)
                   if (!std::isfinite(value))
                       throw CLI::ValidationError(flag, "is no finite number");
               keys[key] = value;
           },
           help)
        ->type_name(type);
}

// As a scene has it, whose reader refuses what is below 0: an unsigned number of CLI11's would wrap.
void count_option(CLI::App& app, Json& keys, const char* flag, const char* key, const char* type,
                  const char* help) {
    app.add_option_function<int64_t>(
           flag,
           [&keys, key](int64_t value) {
               keys[key] = value < 0 ? Json(value) : Json(static_cast<uint64_t>(value));
           },
           help)
        ->check([](const std::string& given) -> std::string { // CLI11 would read it as octal
            return given.size() > 1 && given[0] == '0' && std::isdigit(given[1])
                       ? given + " begins with 0"
                       : "";
        })
        ->type_name(type);
}

// "tressfx, ... [the library's default]"
std::string model_choices() {
    std::string list;
    for (const char* name : model_names)
        list += (list.empty() ? "" : ", ") + std::string(name);
    return list + " [" + model_names[static_cast<size_t>(Scene::default_sim().model)] + "]";
}

void add_options(CLI::App& app, CommandLine& line) {
    Json& keys = line.keys;
    const auto text = [&](auto... rest) { option<std::string>(app, keys, rest...); };
    const std::string models = model_choices();
    const auto count = [&](auto... rest) { count_option(app, keys, rest...); };
    app.add_option("--scene", line.scene_files,
                   "scene files; options win over them. Of several each leaves its results in a "
                   "folder of its name in --out")
        ->type_name("FILE.json")
        ->allow_extra_args();
    app.add_option_function<std::string>(
           "--part", [&line](const std::string& given) { line.part = read_part(given); },
           "of the scenes only every N-th, from the I-th on: 1/N to N/N are all [1/1]")
        ->type_name("I/N");
    text("--groom", "groom", "NAME|FILE",
         "long, braid, curly, short, ponytail, bob, afro, dreadlocks, beard, fur, ball, or .tfx "
         ".hair .obj .abc .usda .ply .data [long]");
    count("--strands", "strands", "N",
          "strands; of a file, at most so many [10000, all of a file]");
    count("--vertices", "vertices", "V", "vertices per strand, 2..256 [16, as in the file]");
    count("--guides", "guides", "N",
          "strands that are simulated, the others follow by turns [all]");
    count("--level", "level", "K",
          "in place of --guides: of the groom's levels of detail, 0 the finest [none]");
    text("--switch", "switch", "S:K,...",
         "at second S of the motion go over to level K; begins with --level, or with all [none]");
    option<double>(app, keys, "--budget", "budget", "MS",
                   "milliseconds for the hair of a frame, within which levels are chosen [none]");
    count("--crowd", "crowd", "N",
          "heads that share the budget, 0.7 to 30 m away; pictures are of the nearest [1]");
    app.add_option_function<std::string>(
           "--scale",
           [&keys](const std::string& value) {
               char* end = nullptr;
               const double number = std::strtod(value.c_str(), &end);
               if (!value.empty() && *end == 0)
                   keys["scale"] = number;
               else
                   keys["scale"] = value;
           },
           "a file's unit in metres, or auto: the one that makes it as large as a head of hair [1]")
        ->type_name("X|auto");
    text("--program", "program", "NAME",
         "axes and unit of a file in the space of blender, houdini, maya, unreal or unity; not for "
         "what "
         "these turn when they export, as Blender does for .abc [none]");
    text("--axes", "axes", "NAME",
         "of a file: y_up (Maya, Houdini), z_up (Blender), y_up_left_handed (Unity), "
         "z_up_left_handed (Unreal) [y_up]");
    text("--root-end", "root_end", "NAME",
         "of a file's strands: first, last, or agreed: some are stored from tip to root [first]");
    text("--head", "head", "FILE", "mesh under the hair: .tfxmesh, or what assimp reads");
    text("--motion", "motion", "NAME|FILE",
         "still, shake, turn, nod, shake_and_turn, walk, or .csv .json keyframes");
    option<double>(app, keys, "--seconds", "seconds", "S", "length of the motion [4]");
    option<double>(app, keys, "--settle", "settle", "S",
                   "before the motion, the head still [1 for long and curly, else 0]");
    text("--bind", "bind", "NAME",
         "follows take their guides' turns since all hair has settled, hung, or since the groom, "
         "groomed [hung]");
    count("--rate", "rate", "HZ", "steps and frames a second [60]");
    count("--substeps", "substeps", "N", "per step [2]");
    text("--preset", "preset", "NAME",
         "kind of hair: straight, curly, afro, ...; --list-presets names them [the groom's]");
    text("--model", "model", "NAME", models.c_str());
    text("--sag-free", "sag_free", "NAME",
         "off, rest or stiffen: the groom as drawn is in balance with gravity [off for long and "
         "curly, else stiffen where it bends]");
    text("--grid", "grid", "NAME", "the grid between strands: off, slots or exact [exact]");
    text("--device", "device", "TEXT",
         "part of a device's, vendor's or platform's name, as pocl; cpu or gpu [the best]");
    text("--backend", "backend", "NAME", "opencl or reference [the best]");
    text("--out", "out", "FOLDER",
         "where the results go; of several scenes in it a folder each [out]");
    text("--cache", "cache", "FILE",
         "write the trajectory here; .abc or .usda: as curves that move, with velocities");
    count("--restart-every", "restart_every", "FRAMES",
          "keep in --out, after so many frames, what a run that is cut off goes on from [none; 100 "
          "with --resume]");
    app.add_flag_callback(
        "--resume", [&keys] { keys["resume"] = true; },
        "go on from what was kept in --out, to the results of a run that was never cut off; begin "
        "anew where nothing was");
    text("--replay", "replay", "FILE", "draw a trajectory instead of simulating one");
    text("--json", "json", "FILE", "write the statistics here as well");
    app.add_flag_callback(
        "--profile", [&keys] { keys["profile"] = true; },
        "where a frame's time goes, stage by stage, beside a copy of memory");
    text("--trace", "trace", "FILE.json", "write a trace for Perfetto or chrome://tracing");
    count("--seed", "seed", "N", "of everything random [1]");
    app.add_flag_callback(
        "--no-pictures", [&keys] { keys["pictures"] = false; }, "numbers only");
    app.add_flag_callback(
        "--no-compare", [&keys] { keys["compare"] = false; }, "nothing beside it: no ab.png");
    app.add_flag_callback(
        "--no-film", [&keys] { keys["film"] = false; }, "pictures, but no film");
    app.add_flag("--list-devices", line.list_devices, "list the devices and stop");
    app.add_flag("--list-presets", line.list_presets,
                 "list the kinds of hair, in a sentence each, and stop");
    app.add_flag("--list-params", line.list_params,
                 "list the parameters of a scene's params, what each does, and stop");
}

} // namespace

CommandLine read_command_line(int argc, char** argv) {
    CommandLine line;
    CLI::App app("Simulates hair on a moving head and shows what came of it.", "plait-simulate");
    app.footer(footer);
    app.set_version_flag("--version", "plait-simulate " PROGRAM_VERSION);
    add_options(app, line);
    try {
        app.parse(argc, argv);
    } catch (const Failure& failure) { // of --part
        std::fprintf(stderr, "plait-simulate: %s\n", failure.what());
        line.exit_code = static_cast<int>(failure.exit);
    } catch (const CLI::ParseError& error) {
        line.exit_code =
            app.exit(error) == 0 ? static_cast<int>(Exit::ok) : static_cast<int>(Exit::user_error);
    }
    return line;
}

} // namespace simulate
