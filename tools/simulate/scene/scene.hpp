// What to simulate and what to leave behind: the whole of a scene file and the command line.
// docs/simulate.md lists every key with its unit, range and default.
#pragma once

#include "body.hpp"
#include "common.hpp"
#include "crowd.hpp"
#include "detail.hpp"
#include "materials.hpp"
#include "meshes.hpp"
#include "motion.hpp"

#include "generator/generator.hpp"

#include <plait/plait.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace simulate {

using Vector = std::array<float, 3>;

struct Collider {
    plait_collider_desc shape;
    bool moves_with_head = true;
    std::vector<Keyframe> keyframes =
        {}; // of its own motion about its middle; then it is drawn, too
};

// Hair within `radius` of `at` in the groom is held where it is.
struct Tie {
    Vector at{};                      // m
    float radius = 0.0f;              // m
    float stiffness = PLAIT_PIN_HELD; // N/m, of each vertex
    bool moves_with_head = true;
};

// From a moment of the motion on.
struct LevelSwitch {
    float second = 0.0f;
    uint32_t level = 0; // of the groom's levels of detail
};

struct GroomChoice {
    std::string name = "long";         // a generated style, or a file
    plait_generator::Style style;      // when generated
    uint32_t strands = 0;              // 0: 10,000 when generated, all of a file
    uint32_t vertices = 0;             // 0: 16 when generated, as in the file
    uint32_t guides = 0;               // strands that are simulated, the others follow; 0: all
    std::optional<uint32_t> level;     // of detail, in place of `guides`; absent: none
    std::vector<LevelSwitch> switches; // in the order of time; from `level`, or the finest, on
    float scale = 1.0f;                // file units to metres
    bool scale_by_size = false;        // "auto": the library's likely_scale
    plait_axes axes = PLAIT_AXES_Y_UP; // of a file, as root_end
    plait_root_end root_end = PLAIT_ROOT_END_FIRST;
    bool generated = true;

    bool on_ball() const { // and not on the mannequin
        return generated && is_on_ball(style.hairstyle);
    }
};

struct HeadChoice {
    std::string file;                         // "": the mannequin with a generated groom, else none
    std::optional<std::array<float, 2>> neck; // heights between which the mesh ceases to turn, m
    std::optional<Vector> pivot;              // about which the head turns, m
};

struct CameraChoice {
    std::optional<float> azimuth; // degrees from +z towards +x; absent: where the hair hangs
    float elevation = 4.0f;       // degrees
    float zoom = 1.0f;
    float field_of_view = 28.0f;
    std::optional<Vector> eye, target; // m; absent: fitted to the groom and the head
};

struct PictureChoice {
    bool wanted = true;
    bool video = true;
    uint32_t width = 360, height = 450; // of one picture, pixels
    uint32_t samples = 16;              // per pixel of a sheet
    uint32_t video_samples = 4;
    uint32_t video_rate = 15;                  // frames a second, at most `rate`
    uint32_t cells = 8;                        // pictures on the contact sheet
    float hair_width = 0.0f;                   // m; 0: by the number of strands
    std::optional<Vector> hair_root, hair_tip; // linear RGB
};

// What hair collides with.
enum class Mannequin { Meshes, Capsules };

// Since when follows take the turns of their guides: the groom, or when all hair has settled.
enum class Bind { groomed, hung };
inline constexpr const char* bind_names[] = {"groomed", "hung"};

struct Scene {
    GroomChoice groom;
    CrowdChoice crowd;
    HeadChoice head;
    CameraChoice camera;
    PictureChoice pictures;
    std::optional<std::vector<Collider>> colliders; // absent: made for the groom
    Mannequin mannequin = Mannequin::Meshes;        // where those are the mannequin
    std::vector<Collider> moving_colliders;         // beside those
    std::vector<MeshChoice> meshes;                 // beside those
    std::optional<BodyChoice> body;                 // beside those; it moves the head
    std::vector<Tie> pins;
    std::optional<plait_wind_desc> wind;
    std::vector<MaterialChoice> materials;
    std::vector<float> wetness; // one for all strands, or of each of the groom's; empty: dry
    Detail detail;
    std::vector<DetailChoice> compare_detail; // rows of the comparison, in place of TressFX's
    std::string motion = "shake_and_turn";    // a name or a file
    float seconds = 4.0f;
    float settle = 0.0f; // s before the motion, with the head as it begins
    Bind bind = Bind::hung;
    uint32_t rate = 60; // fixed steps and frames a second
    uint32_t substeps = 2;
    uint64_t seed = 1;
    std::string preset; // kind of hair; "": none
    plait::SimDesc sim = default_sim();
    plait::SimDesc unhung = default_sim();          // without what its hairstyle asks of `sim`
    plait_tressfx_desc tressfx = default_tressfx(); // of the TressFX beside it
    bool compare = true;
    std::string device, backend; // "": the best
    std::string out = "out", cache, json, replay;
    uint32_t restart_every = 0; // frames after which a run keeps what it can go on from; 0: never
    bool resume = false;        // goes on from that
    std::string inputs;         // inputs_of() it, where it keeps
    bool profile = false;
    std::string trace; // file; "": none

    uint32_t frames() const;
    bool changes_level() const;          // as it runs
    bool head_is_mesh() const;           // of the colliders
    bool mannequin_is_meshes() const;    // of the colliders, beside those of a file
    static plait::SimDesc default_sim(); // what long hair needs under real gravity
    static plait_tressfx_desc default_tressfx();
};

// `file` may be ""; `command_line` holds keys of a scene file and wins over it. Throws Failure.
Scene make_scene(const std::string& file, const Json& command_line);

} // namespace simulate
