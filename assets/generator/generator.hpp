// The hairstyles and the head that plait's tests, benchmarks and pictures use, made by formula.
//
// Pure functions of their arguments. Arithmetic is +, -, *, / and sqrt in double, which IEEE 754
// defines to the last bit, so the same style gives the same bytes on every machine.
// Metres, y up, face towards +z; the origin lies midway between the ear canals, near the joint on
// which a head nods.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace plait_generator {

// ---- head
// ----------------------------------------------------------------------------------------

struct HeadMesh {
    std::vector<float> positions;    // xyz [vertices]
    std::vector<float> normals;      // xyz [vertices], unit, outward
    std::vector<uint32_t> triangles; // 3 [triangles], counter-clockwise seen from outside
};

// A mannequin: head, neck and shoulders, closed at the bottom. Detail 1 has about 4,600 triangles,
// 2 about 19,000, 3 about 42,000. Range [1, 4].
HeadMesh make_head(unsigned detail = 2);

// The same in three closed parts without normals: what turns with the head, the middle of the neck,
// which goes half of the way, and what stays. They overlap, so that no gap opens between them.
struct HeadParts {
    HeadMesh head, neck, torso;
};
HeadParts make_head_parts(unsigned detail = 2);

// Distance to the mannequin's surface in metres, negative inside; first order exact near the
// surface.
double head_distance(double x, double y, double z);

// Height above the hairline in metres: positive where hair grows. For points on the surface.
double scalp_height(double x, double y, double z);

// A capsule whose ends may differ in radius; a == b is a sphere. As plait_collider_desc.
struct Capsule {
    float a[3], b[3]; // m
    float radius_a, radius_b;
    bool moves_with_head; // false: neck and shoulders, which stay when the head turns
};

// What the simulation keeps hair out of: inscribed in the mannequin, so that no hairstyle at rest
// touches it from inside.
std::vector<Capsule> head_colliders();

// The mannequin, coarser, with bones, and a motion that begins and ends alike.
struct Joint {
    const char* name;
    int parent;  // -1: none
    float at[3]; // m, at rest, where no joint is turned
};
struct Character {
    HeadMesh mesh;
    std::vector<Joint> joints;   // chest, neck, head
    std::vector<uint8_t> bones;  // 4 [vertices]
    std::vector<float> weights;  // 4 [vertices], sum 1
    std::vector<float> time;     // s, of the keys
    std::vector<float> turns;    // xyzw [joints][keys]
    std::vector<float> chest_at; // xyz [keys], m
};
// 2,864 triangles; in 4 s the head turns to both sides and nods, two steps a second lift the chest.
Character make_character();

// What hair of the styles `ball` and `fur` lies on in place of the mannequin: a sphere about the origin.
inline constexpr double ball_radius = 0.1;         // m
inline constexpr double ball_hairline = 0.0497571; // m above the middle; hair grows higher up
HeadMesh make_ball();                              // of 20,448 triangles
std::vector<Capsule> ball_colliders();

// ---- hair
// ----------------------------------------------------------------------------------------

enum class Hairstyle : uint32_t {
    Long,       // parted, falling over the shoulders
    Braid,      // combed back into one plait of three bundles
    Curly,      // helices
    Short,      // swept back
    Ponytail,   // combed back through a holder, and free behind it
    Ball,       // in a layer on a ball and past its equator, for measurements: not on the mannequin
    Bob,        // parted and cut in one line below the jaw
    Afro,       // coils that stand away from the scalp on all sides
    Dreadlocks, // a strand is a whole lock, and hangs
    Beard,      // on chin, jaw and upper lip
    Fur         // all over the ball, combed down
};

// Lengths in metres. What each number means and its range: style_fields().
struct Style {
    Hairstyle hairstyle = Hairstyle::Long;
    uint32_t strands = 10000; // [1, 1000000]
    uint32_t vertices = 16;   // per strand, [2, 256]
    uint32_t clumps = 300;    // locks of hair that fall together, [1, 100000]
    uint64_t seed = 1;

    double length = 0.46;
    double length_variation = 0.1;
    double volume = 0.012;
    double lift = 0.5;
    double stiffness = 0.025;
    double part = 0.012;
    double clump_tightness = 0.6;
    double wave_amplitude = 0;
    double wave_length = 0.09;
    double stray = 0.003;
    double curl_radius = 0;
    double curl_pitch = 0.03;
    double curl_variation = 0;
    double bundle_radius = 0.0085;
    double braid_pitch = 0.085;
    double braid_length = 0.3;
    double holder_radius = 0.011;
    double holder_height = 0.035;
    double tail_length = 0.3;
    double cut = -0.095;
};

// "long", "braid", ...: the names above in lower case.
std::string_view hairstyle_name(Hairstyle hairstyle);
inline constexpr size_t hairstyle_count = 11;

// Whether it grows on the ball and not on the mannequin.
bool is_on_ball(Hairstyle hairstyle);

// The defaults of a hairstyle. They are what `plait-groom <name>` starts from.
Style make_style(Hairstyle hairstyle);

// A number of a style that may be varied, by name.
struct StyleField {
    const char* name; // "wave_length"
    const char* meaning;
    double Style::*value;
    double least, most;
};
std::span<const StyleField> style_fields();

// "" if make_groom takes the style; else a sentence with the field, its value and its range.
std::string style_problem(const Style& style);

// As plait_groom_desc takes them. In no particular order of place: any first n strands are spread
// over the whole scalp.
struct Strands {
    std::vector<float> positions;        // xyz [strands][vertices], root first
    std::vector<uint32_t> vertex_counts; // [strands]
    std::vector<float> uv;               // [strands] of the root: seen from above, equal areas
    std::vector<float> thickness;        // diameter [strands]
};

// Requires style_problem(style) == "".
Strands make_groom(const Style& style);

// What holds a hairstyle together, at rest: hair within `radius` of `at`, both m, is held there.
struct Tie {
    float at[3];
    float radius;
};
std::vector<Tie> make_ties(const Style& style);

} // namespace plait_generator
