#include "scene.hpp"
#include "inputs.hpp"

#include "common/collider_reader.hpp"
#include "common/json_reader.hpp"
#include "common/params_reader.hpp"
#include "common/presets.hpp"

#include <plait/plait_levels.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

namespace simulate {

using plait_generator::Style;

namespace {

using plait_generator::Hairstyle, plait_generator::hairstyle_count;

// "long, braid, ..."
std::string style_names() {
    std::string names;
    for (size_t i = 0; i < hairstyle_count; ++i)
        names += (i ? ", " : "") + std::string(hairstyle_name(static_cast<Hairstyle>(i)));
    return names;
}

std::optional<Hairstyle> style_called(const std::string& name) {
    for (size_t i = 0; i < hairstyle_count; ++i)
        if (name == hairstyle_name(static_cast<Hairstyle>(i)))
            return static_cast<Hairstyle>(i);
    return std::nullopt;
}

// A path in a scene file is relative to that file, one on the command line to the working
// directory.
std::string resolve(const std::string& path, const char* key, const Origin& origin) {
    if (origin.command_line.contains(key) || origin.file.empty())
        return path;
    return (std::filesystem::path(origin.file).parent_path() / path).string();
}

// Ranges are the generator's: style_problem() below.
void read_style(const JsonReader& top, const Json& value, Style& style) {
    struct Field {
        const char* key;
        double Style::*member;
    };
    static constexpr Field fields[] = {{"length", &Style::length},
                                       {"length_variation", &Style::length_variation},
                                       {"volume", &Style::volume},
                                       {"lift", &Style::lift},
                                       {"part", &Style::part},
                                       {"clump_tightness", &Style::clump_tightness},
                                       {"wave_amplitude", &Style::wave_amplitude},
                                       {"wave_length", &Style::wave_length},
                                       {"curl_radius", &Style::curl_radius},
                                       {"curl_pitch", &Style::curl_pitch},
                                       {"curl_variation", &Style::curl_variation},
                                       {"bundle_radius", &Style::bundle_radius},
                                       {"braid_pitch", &Style::braid_pitch},
                                       {"braid_length", &Style::braid_length},
                                       {"holder_radius", &Style::holder_radius},
                                       {"holder_height", &Style::holder_height},
                                       {"tail_length", &Style::tail_length},
                                       {"cut", &Style::cut}};
    JsonReader in = top.object(value, "style");
    for (const Field& field : fields)
        in.number(field.key, style.*field.member, -1e6, 1e6);
    in.integer("clumps", style.clumps, 1, 100000);
    in.finish();
}

// A number, or "auto" for files.
bool read_scale(JsonReader& top, GroomChoice& groom) {
    const Json* value = top.value("scale");
    groom.scale_by_size = value && *value == "auto";
    if (value && value->is_string() && !groom.scale_by_size)
        top.fail("scale", "is " + value->dump() + ", neither a number nor \"auto\"");
    if (!groom.scale_by_size)
        top.number("scale", groom.scale, 1e-6, 1e6);
    return value;
}

// The axes and the unit of a program's own space; what the scene says of them beside it wins.
bool read_program(JsonReader& top, GroomChoice& groom) {
    constexpr const char* names[] = {"blender", "houdini", "maya", "unreal", "unity"};
    constexpr struct {
        plait_axes axes;
        float scale;
    } programs[] = {{PLAIT_AXES_Z_UP, 1},
                    {PLAIT_AXES_Y_UP, 1},
                    {PLAIT_AXES_Y_UP, 0.01f},
                    {PLAIT_AXES_Z_UP_LEFT_HANDED, 0.01f},
                    {PLAIT_AXES_Y_UP_LEFT_HANDED, 1}};
    size_t program = 0;
    if (!top.choice("program", program, names))
        return false;
    groom.axes = programs[program].axes;
    groom.scale = programs[program].scale;
    return true;
}

// "1:0,2:3": at second 1 level 0, at second 2 level 3.
std::vector<LevelSwitch> read_switches(JsonReader& top, const std::string& text) {
    std::vector<LevelSwitch> list;
    std::istringstream in(text);
    for (std::string item; std::getline(in, item, ',');) {
        LevelSwitch next;
        char colon = 0, rest = 0;
        std::istringstream one(item);
        if (!(one >> next.second >> colon >> next.level) || colon != ':' || one >> rest ||
            !(next.second >= 0) || next.level >= PLAIT_LEVELS_MAX)
            top.fail("switch", "has \"" + item + "\", not SECOND:LEVEL, with a second from 0 on " +
                                   "and a level in [0, " + std::to_string(PLAIT_LEVELS_MAX - 1) +
                                   "]");
        if (!list.empty() && next.second < list.back().second)
            top.fail("switch", "goes back to second " + item.substr(0, item.find(':')));
        list.push_back(next);
    }
    return list;
}

// `key` is switch or budget.
void refuse_with_levels(JsonReader& top, const char* key, const Scene& scene) {
    for (const char* other : {"guides", "follows_per_guide", "detail"})
        if (top.value(other))
            top.fail(key,
                     std::string("is given, and ") + other + ", too: levels choose the guides");
    if (top.value("cache"))
        top.fail(key, "is given, and cache, too: every frame of a cache has the same strands; "
                      "give level instead");
    if (scene.sim.model == PLAIT_MODEL_TRESSFX)
        top.fail(key, "is given, and strands of the model tressfx have no levels");
}

void read_crowd(JsonReader& top, Scene& scene) {
    CrowdChoice& crowd = scene.crowd;
    if (top.number("budget", crowd.budget_ms, 0.01, 1e4)) {
        for (const char* other : {"level", "switch"})
            if (top.value(other))
                top.fail("budget", std::string("is given, and ") + other +
                                       ", too: within a budget the director chooses levels");
        if (top.value("replay"))
            top.fail("budget", "is given, and replay, too, which simulates nothing");
        refuse_with_levels(top, "budget", scene);
    }
    if (top.integer("crowd", crowd.heads, 1, 1000) && !crowd.directed())
        top.fail("crowd", "is given, and no budget: its heads share one; give budget, in ms");
    for (const char* other : {"profile", "trace"})
        if (crowd.heads > 1 && top.value(other))
            top.fail("crowd", "is given, and " + std::string(other) +
                                  ", too, which is of one head; leave crowd out");
}

void read_groom(JsonReader& top, const Origin& origin, Scene& scene) {
    GroomChoice& groom = scene.groom;
    top.integer("strands", groom.strands, 1, 1000000);
    top.integer("vertices", groom.vertices, 2, 256);
    top.integer("guides", groom.guides, 1, 1000000);
    uint32_t level = 0;
    if (top.integer("level", level, 0, PLAIT_LEVELS_MAX - 1))
        groom.level = level;
    if (std::string switches; top.text("switch", switches)) {
        groom.switches = read_switches(top, switches);
        refuse_with_levels(top, "switch", scene);
    }
    read_crowd(top, scene);
    if (groom.level && groom.guides > 0)
        top.fail("level", "is given, and guides, too: a level says how many there are");
    if (groom.level && scene.sim.follows_per_guide > 0)
        top.fail("level", "is given, and follows_per_guide, too: hair follows in one way");
    if (groom.guides > 0 && scene.sim.follows_per_guide > 0)
        top.fail("guides", "are given, and follows_per_guide, too: hair follows in one way");
    const bool has_program = read_program(top, groom);
    const bool has_scale = read_scale(top, groom);
    constexpr const char* axes[] = {"y_up", "z_up", "y_up_left_handed", "z_up_left_handed"};
    constexpr const char* ends[] = {"first", "last", "agreed"};
    const bool has_axes = top.choice("axes", groom.axes, axes);
    const bool has_end = top.choice("root_end", groom.root_end, ends);
    const Json* style = top.value("style");
    const auto known = style_called(groom.name);
    groom.generated = known.has_value();
    if (!groom.generated) {
        if (groom.name.find('.') == std::string::npos)
            top.fail("groom",
                     "is \"" + groom.name + "\", neither a file nor one of " + style_names());
        if (style)
            top.fail("style", "is for generated grooms; \"" + groom.name + "\" is a file");
        groom.name = resolve(groom.name, "groom", origin);
        return;
    }
    if (has_program || has_axes || has_end || has_scale)
        top.fail(has_program ? "program"
                 : has_axes  ? "axes"
                 : has_end   ? "root_end"
                             : "scale",
                 "is for files; \"" + groom.name + "\" is generated");
    groom.style = make_style(*known);
    groom.style.seed = scene.seed;
    groom.style.strands = groom.strands ? groom.strands : groom.style.strands;
    groom.style.vertices = groom.vertices ? groom.vertices : groom.style.vertices;
    if (style)
        read_style(top, *style, groom.style);
    if (const std::string problem = style_problem(groom.style); !problem.empty())
        top.fail("style", problem);
}

template <size_t N>
void read_optional(JsonReader& in, const char* key, std::optional<std::array<float, N>>& target,
                   double least, double most) {
    std::array<float, N> numbers{};
    if (in.numbers(key, numbers, least, most))
        target = numbers;
}

void read_head(JsonReader& top, const Origin& origin, HeadChoice& head) {
    if (top.text("head", head.file))
        head.file = resolve(head.file, "head", origin);
    read_optional(top, "neck", head.neck, -1e6, 1e6);
    read_optional(top, "pivot", head.pivot, -1e6, 1e6);
    if (head.neck && !((*head.neck)[0] < (*head.neck)[1]))
        top.fail("neck", "is not a lower height and a higher one");
}

void read_colliders(JsonReader& top, std::optional<std::vector<Collider>>& colliders) {
    std::vector<Collider> list;
    const bool given = top.each("colliders", [&](JsonReader in) {
        Collider collider{read_collider(in, plait_collider_desc_defaults()), true, {}};
        in.flag("moves_with_head", collider.moves_with_head);
        in.finish();
        list.push_back(collider);
    });
    if (given)
        colliders = std::move(list);
}

// Keyframes as a motion file has them: of the collider about its middle, in its rest orientation.
void read_moving_colliders(JsonReader& top, std::vector<Collider>& colliders) {
    top.each("moving_colliders", [&](JsonReader in) {
        Collider collider{read_collider(in, plait_collider_desc_defaults()), false, {}};
        in.each("keyframes",
                [&](JsonReader key) { collider.keyframes.push_back(read_keyframe(key)); });
        if (const std::string problem = keyframe_problem(collider.keyframes); !problem.empty())
            in.fail("keyframes", problem);
        in.finish();
        colliders.push_back(std::move(collider));
    });
}

// After colliders and meshes, which take its place.
void read_mannequin(JsonReader& top, Scene& scene) {
    constexpr const char* names[] = {"meshes", "capsules"};
    if (!top.choice("mannequin", scene.mannequin, names))
        return;
    if (!scene.groom.generated || scene.groom.on_ball())
        top.fail("mannequin", "is given, and \"" + scene.groom.name + "\" does not grow on it");
    if (scene.colliders || scene.head_is_mesh())
        top.fail("mannequin", "is given, and colliders, meshes or a body take its place");
    if (scene.mannequin == Mannequin::Meshes && scene.sim.model == PLAIT_MODEL_TRESSFX)
        top.fail("mannequin", "is meshes, and strands of the model tressfx meet no meshes");
}

void take_meshes(JsonReader& top, const Origin& origin, Scene& scene) {
    const std::string folder = std::filesystem::path(origin.file).parent_path().string();
    scene.meshes = read_meshes(top, folder);
    const Json* const body = top.value("body");
    if (body)
        scene.body = read_body(top, *body, folder);
    const bool all_hulls = std::ranges::all_of(scene.meshes, &MeshChoice::hull);
    if ((body || !all_hulls) && scene.sim.model == PLAIT_MODEL_TRESSFX)
        top.fail(body ? "body" : "meshes",
                 "are given, and strands of the model tressfx meet no meshes");
}

// Absent: what holds the hairstyle together.
void read_pins(JsonReader& top, Scene& scene) {
    if (scene.groom.generated)
        for (const plait_generator::Tie& tie : make_ties(scene.groom.style))
            scene.pins.push_back({{tie.at[0], tie.at[1], tie.at[2]}, tie.radius});
    std::vector<Tie> list;
    const bool given = top.each("pins", [&](JsonReader in) {
        Tie tie;
        if (!in.numbers("at", tie.at, -1e6, 1e6))
            in.fail("at", "is missing: the middle of what holds the hair, m");
        if (!in.number("radius", tie.radius, 0, 1e6))
            in.fail("radius", "is missing: hair within it is held, m");
        in.number("stiffness", tie.stiffness, 1e-12, double(PLAIT_PIN_HELD));
        in.flag("moves_with_head", tie.moves_with_head);
        in.finish();
        list.push_back(tie);
    });
    if (!given)
        return;
    if (!list.empty() && scene.sim.model == PLAIT_MODEL_TRESSFX)
        top.fail("pins", "are given, and strands of the model tressfx take none");
    scene.pins = std::move(list);
}

// Ranges are the library's.
void read_wind(JsonReader& top, Scene& scene) {
    const Json* value = top.value("wind");
    if (!value)
        return;
    if (scene.sim.model == PLAIT_MODEL_TRESSFX)
        top.fail("wind", "is given, and strands of the model tressfx take the wind in \"params\"");
    plait_wind_desc wind = plait_wind_desc_defaults();
    JsonReader in = top.object(*value, "wind");
    in.numbers("velocity", wind.velocity, -1e3, 1e3);
    in.number("turbulence", wind.turbulence, 0, 1e3);
    in.number("scale", wind.scale, 1e-3, 1e4);
    in.integer("octaves", wind.octaves, 1, 8);
    in.number("gain", wind.gain, 0, 1);
    in.number("gusts", wind.gusts, 0, 2);
    in.number("gust_period", wind.gust_period, 1e-2, 1e4);
    in.number("tangential", wind.tangential, 0, 1);
    in.number("diameter", wind.diameter, 0, 0.1);
    in.number("air_density", wind.air_density, 1e-6, 1e4);
    in.number("viscosity", wind.viscosity, 0, 1);
    in.integer("shelter", wind.shelter, 0, 1);
    in.number("hairs_per_strand", wind.hairs_per_strand, 0, 1e6);
    in.finish();
    wind.seed = static_cast<uint32_t>(scene.seed);
    scene.wind = wind;
}

// A number for all strands, or a file of one for each.
void read_wetness(JsonReader& top, const Origin& origin, Scene& scene) {
    const Json* value = top.value("wetness");
    if (!value && scene.sim.wetness.on) // of the preset
        scene.wetness = {1.0f};
    if (!value)
        return;
    if (scene.sim.model == PLAIT_MODEL_TRESSFX)
        top.fail("wetness", "is given, and strands of the model tressfx have none");
    if (!value->is_string()) {
        scene.wetness.emplace_back();
        top.number("wetness", scene.wetness.front(), 0, 1);
        return;
    }
    const std::string path = resolve(value->get<std::string>(), "wetness", origin);
    std::ifstream file(path);
    if (!file)
        top.fail("wetness", "is the file " + path + ", which cannot be read");
    for (std::string word; file >> word;) {
        size_t end = 0;
        float wetness = -1;
        try {
            wetness = std::stof(word, &end);
        } catch (const std::exception&) {
            end = 0;
        }
        if (end != word.size() || !(wetness >= 0 && wetness <= 1))
            top.fail("wetness", "is the file " + path + ", whose number " +
                                    std::to_string(scene.wetness.size()) + " is " + word +
                                    ", range is [0,1]");
        scene.wetness.push_back(wetness);
    }
    if (scene.wetness.size() < 2)
        top.fail("wetness", "is the file " + path + ", which has no number for each strand");
}

void take_detail(JsonReader& top, Scene& scene) {
    const Json* value = top.value("detail");
    if (value)
        scene.detail = read_detail(top, *value, scene.seed);
    scene.compare_detail = read_details(top, scene.seed);
    if ((value || !scene.compare_detail.empty()) && scene.groom.guides == 0 &&
        scene.sim.follows_per_guide == 0)
        top.fail(value ? "detail" : "compare_detail",
                 "is given, and no strand follows: it is theirs; give guides or follows_per_guide");
}

void read_camera(const JsonReader& top, const Json& value, CameraChoice& camera) {
    JsonReader in = top.object(value, "camera");
    if (float azimuth = 0; in.number("azimuth", azimuth, -360, 360))
        camera.azimuth = azimuth;
    in.number("elevation", camera.elevation, -89, 89);
    in.number("zoom", camera.zoom, 0.01, 100);
    in.number("field_of_view", camera.field_of_view, 1, 120);
    read_optional(in, "eye", camera.eye, -1e6, 1e6);
    read_optional(in, "target", camera.target, -1e6, 1e6);
    in.finish();
}

void read_pictures(const JsonReader& top, const Json& value, PictureChoice& pictures) {
    JsonReader in = top.object(value, "picture");
    in.flag("video", pictures.video);
    in.integer("width", pictures.width, 16, 4096);
    in.integer("height", pictures.height, 16, 4096);
    in.integer("samples", pictures.samples, 1, 256);
    in.integer("video_samples", pictures.video_samples, 1, 256);
    in.integer("video_rate", pictures.video_rate, 1, 240);
    in.integer("cells", pictures.cells, 1, 64);
    in.number("hair_width", pictures.hair_width, 0, 0.1);
    read_optional(in, "hair_root", pictures.hair_root, 0, 1);
    read_optional(in, "hair_tip", pictures.hair_tip, 0, 1);
    in.finish();
}

// How a hairstyle hangs, with models that bend.
struct Hang {
    const char* preset; // the kind of hair that it is; "": the library's defaults
    // In balance as drawn, or settled under its weight before the motion? A groom in balance weighs
    // nothing on the head that it lies on, and is tossed off by the first shake: what falls freely
    // settles. A short cut and a braid are held up by what the models lack, hair beneath hair.
    plait_sag_free sag_free = PLAIT_SAG_FREE_STIFFEN;
    float settle = 0.0f; // s
};

Hang hang_of(const std::string& groom) {
    if (groom == "long")
        return {"straight", PLAIT_SAG_FREE_OFF, 1.0f};
    if (groom == "curly")
        return {"curly", PLAIT_SAG_FREE_OFF, 1.0f};
    if (groom == "dreadlocks")
        return {"dreadlocks", PLAIT_SAG_FREE_OFF, 1.0f};
    if (groom == "ball") // limp: nothing holds it up but volume
        return {"", PLAIT_SAG_FREE_OFF, 0.0f};
    if (groom == "fur")
        return {"short_fur"};
    for (const char* own : {"short", "braid", "ponytail", "bob", "afro", "beard"})
        if (groom == own)
            return {own};
    return {"straight"};
}

void hang(JsonReader& top, Scene& scene) {
    const bool tressfx = scene.sim.model == PLAIT_MODEL_TRESSFX; // which has no bending
    const Hang hang = hang_of(scene.groom.name);
    scene.preset = read_preset(top, tressfx ? "" : hang.preset, scene.sim);
    if (tressfx)
        return;
    scene.sim.sag_free = hang.sag_free;
    scene.settle = hang.settle;
    const bool follows_otherwise =
        top.value("guides") || top.value("level") || top.value("switch") || top.value("budget");
    if (scene.groom.name == "dreadlocks" && !follows_otherwise) {
        // A strand is a lock: this many hairs of it are drawn.
        scene.sim.follows_per_guide = 64;
        scene.sim.follow_radius = 0.005f;
    }
}

// What a scene was made for, its colliders and camera, and another groom would not fit.
void refuse_without_groom(JsonReader& top, bool given) {
    const Json* value = top.value("made_for");
    if (!value)
        return;
    std::string groom, from;
    JsonReader in = top.object(*value, "made_for");
    for (const auto& [key, target] : {std::pair{"groom", &groom}, {"from", &from}})
        if (!in.text(key, *target))
            in.fail(key, "is missing: made_for is { groom, from }");
    in.finish();
    if (!given)
        top.fail("made_for", "is the groom " + groom + ", which is not given: it is public at " +
                                 from + "; --groom FILE takes it");
}

// What is on; what it is like is in "params".
void read_features(JsonReader& top, plait::SimDesc& sim) {
    read_grid(top, sim);
    top.flag("volume", sim.volume.on);
    top.flag("strand_contact", sim.strand_contact.on);
    sim.wetness.on |= top.value("wetness") != nullptr;
}

void read_simulation(JsonReader& top, Scene& scene) {
    refuse_without_groom(top, top.text("groom", scene.groom.name));
    top.number("seconds", scene.seconds, 0.001, 3600);
    top.integer("rate", scene.rate, 1, 1000);
    top.integer("substeps", scene.substeps, 1, 1000);
    top.integer("seed", scene.seed);
    top.choice("model", scene.sim.model, model_names);
    hang(top, scene);
    top.number("settle", scene.settle, 0, 60);
    top.choice("bind", scene.bind, bind_names);
    top.choice("sag_free", scene.sim.sag_free, sag_free_names);
    top.integer("follows_per_guide", scene.sim.follows_per_guide, 0, 64);
    if (top.number("follow_radius", scene.sim.follow_radius, 0, 1) &&
        scene.sim.follows_per_guide == 0)
        top.fail("follow_radius", "is given, and follows_per_guide is 0: hair that follows in "
                                  "another way has roots of its own");
    top.text("device", scene.device);
    top.text("backend", scene.backend);
    const bool own = scene.sim.model == PLAIT_MODEL_TRESSFX;
    if (const Json* params = top.value("tressfx")) {
        if (own)
            top.fail("tressfx",
                     "is of the TressFX beside the model; of the model it is \"params\"");
        read_tressfx(top.object(*params, "tressfx"), scene.tressfx);
    }
    if (own)
        scene.sim.tressfx = scene.tressfx;
    for (plait::SimDesc* sim : {&scene.sim, &scene.unhung})
        read_features(top, *sim);
    scene.unhung.model = scene.sim.model;
    if (const Json* params = top.value("params"))
        for (plait::SimDesc* sim : {&scene.sim, &scene.unhung})
            read_params(top.object(*params, "params"), *sim);
    scene.materials = read_materials(top, scene.sim.material);
    if (!scene.materials.empty() && scene.sim.model == PLAIT_MODEL_TRESSFX)
        top.fail("materials", "are given, and strands of the model tressfx take none");
    scene.sim.step = 1.0f / static_cast<float>(scene.rate);
    scene.sim.substeps = scene.substeps;
    scene.sim.seed = scene.seed;
}

// A file that two outputs write would be that of the last, and a folder that is not there would be noticed when
// the run is over, but for that of the cache, which a run opens first.
void check_files(JsonReader& top, const Scene& scene) {
    namespace fs = std::filesystem;
    const auto whole = [](const std::string& path) {
        return fs::weakly_canonical(path).lexically_normal();
    };
    std::map<fs::path, std::string> written;
    for (const char* name : {"stats.json", "sheet.png", "ab.png", "motion.gif", "motion.mp4"})
        written[whole(scene.out + '/' + name)] = "out";
    for (const auto& [key, path] :
         {std::pair{"cache", &scene.cache}, {"json", &scene.json}, {"trace", &scene.trace}}) {
        if (path->empty())
            continue;
        const fs::path file = whole(*path);
        if (const auto [other, is_new] = written.emplace(file, key); !is_new)
            top.fail(key, "is \"" + *path + "\", which " + other->second + " writes, too");
        if (std::string_view(key) != "cache" && !fs::is_directory(file.parent_path()) &&
            file.parent_path() != whole(scene.out))
            top.fail(key, "is \"" + *path + "\", in a folder that is not there");
    }
}

void read_output(JsonReader& top, const Origin& origin, Scene& scene) {
    for (const auto& [key, target] : {std::pair{"out", &scene.out},
                                      {"cache", &scene.cache},
                                      {"json", &scene.json},
                                      {"trace", &scene.trace},
                                      {"replay", &scene.replay}})
        if (top.text(key, *target))
            *target = resolve(*target, key, origin);
    check_files(top, scene);
    top.flag("pictures", scene.pictures.wanted);
    top.flag("profile", scene.profile);
    if (!scene.replay.empty() && (scene.profile || !scene.trace.empty()))
        top.fail("replay", "draws a run that is over: there is nothing to profile or to trace");
    top.flag("compare", scene.compare);
    if (const Json* camera = top.value("camera"))
        read_camera(top, *camera, scene.camera);
    if (const Json* picture = top.value("picture"))
        read_pictures(top, *picture, scene.pictures);
    top.flag("film", scene.pictures.video);
}

void read_restart(JsonReader& top, Scene& scene) {
    constexpr uint32_t usual = 100; // frames
    top.flag("resume", scene.resume);
    if (scene.resume)
        scene.restart_every = usual;
    top.integer("restart_every", scene.restart_every, 1, 1000000);
    const char* const key = scene.resume ? "resume" : "restart_every";
    if (scene.restart_every == 0)
        return;
    if (scene.crowd.directed())
        top.fail(key, "is given, and budget, too: levels that go by the clock are others in a run "
                      "that is cut off");
    if (scene.profile || !scene.trace.empty())
        top.fail(key, std::string("is given, and ") + (scene.profile ? "profile" : "trace") +
                          ", too: of a run that is cut off it would have a part");
    if (!scene.replay.empty())
        top.fail(key, "is given, and replay, too, which simulates nothing");
}

} // namespace

plait::SimDesc Scene::default_sim() {
    plait::SimDesc sim;
    sim.max_steps_per_call = 1;
    sim.grid.on = true;
    return sim;
}

plait_tressfx_desc Scene::default_tressfx() {
    plait_tressfx_desc p = plait_tressfx_desc_defaults();
    p.global_stiffness = 0.3f;
    p.global_range = 0.3f;
    p.length_iterations = 20;
    return p;
}

uint32_t Scene::frames() const {
    return static_cast<uint32_t>(std::max(1L, std::lround(seconds * static_cast<float>(rate))));
}

bool Scene::changes_level() const {
    return crowd.directed() || !groom.switches.empty();
}

bool Scene::head_is_mesh() const {
    return body || std::ranges::any_of(meshes, &MeshChoice::moves_with_head);
}

bool Scene::mannequin_is_meshes() const {
    return groom.generated && !groom.on_ball() && !colliders && !head_is_mesh() &&
           sim.model != PLAIT_MODEL_TRESSFX && mannequin == Mannequin::Meshes;
}

Scene make_scene(const std::string& file, const Json& command_line) {
    Origin origin{file, command_line, {}};
    Json document = file.empty() ? Json::object() : read_json(origin);
    if (document.is_object())
        document.update(command_line);
    Scene scene;
    JsonReader top(document, origin);
    read_simulation(top, scene); // before the groom, which takes its seed
    read_groom(top, origin, scene);
    read_head(top, origin, scene.head);
    read_colliders(top, scene.colliders);
    read_moving_colliders(top, scene.moving_colliders);
    take_meshes(top, origin, scene);
    read_mannequin(top, scene);
    read_pins(top, scene);
    read_wind(top, scene);
    read_wetness(top, origin, scene);
    take_detail(top, scene);
    const bool moves = top.text("motion", scene.motion);
    if (moves && scene.body)
        top.fail("motion", "is given, and body, too, whose animation moves the head");
    if (moves && scene.motion.find('.') != std::string::npos)
        scene.motion = resolve(scene.motion, "motion", origin);
    read_output(top, origin, scene);
    read_restart(top, scene);
    top.finish();
    if (scene.restart_every > 0)
        scene.inputs = inputs_of(document, origin);
    return scene;
}

} // namespace simulate
