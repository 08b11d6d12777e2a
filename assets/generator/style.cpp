// The defaults and allowed ranges of styles.
#include "generator.hpp"

#include <cstdio>

namespace plait_generator {
namespace {

constexpr StyleField fields[] = {
    {"length", "longest strand, m", &Style::length, 0.01, 1},
    {"length_variation", "share of its length that a strand may lack", &Style::length_variation, 0,
     0.9},
    {"volume", "thickness of the hair that lies on the head, m", &Style::volume, 0.002, 0.05},
    {"lift", "share of the scalp's normal in the direction a strand leaves", &Style::lift, 0, 1},
    {"stiffness", "way in which a strand turns to the combed direction, m", &Style::stiffness,
     0.005, 0.5},
    {"part", "where the parting is, to the left of the nose, m", &Style::part, -0.05, 0.05},
    {"clump_tightness", "how far tips are drawn to their clump's middle", &Style::clump_tightness,
     0, 1},
    {"wave_amplitude", "of a clump's waves, m", &Style::wave_amplitude, 0, 0.05},
    {"wave_length", "of a clump's waves, m", &Style::wave_length, 0.01, 1},
    {"stray", "how far single strands wander, m", &Style::stray, 0, 0.05},
    {"curl_radius", "of curly hair's helices, m", &Style::curl_radius, 0, 0.05},
    {"curl_pitch", "advance of a curl per turn, m", &Style::curl_pitch, 0.005, 0.5},
    {"curl_variation", "share by which clumps differ in radius and pitch", &Style::curl_variation,
     0, 0.9},
    {"bundle_radius", "of one of a braid's three bundles at its top, m", &Style::bundle_radius,
     0.002, 0.03},
    {"braid_pitch", "way down the braid until a bundle is back on its side, m", &Style::braid_pitch,
     0.02, 0.5},
    {"braid_length", "from the gathering at the nape to the tie, m", &Style::braid_length, 0.05, 1},
    {"holder_radius", "of what holds a ponytail, inside, m", &Style::holder_radius, 0.004, 0.03},
    {"holder_height", "of what holds a ponytail, above the ears, m", &Style::holder_height, -0.05,
     0.12},
    {"tail_length", "of a ponytail behind its holder, m", &Style::tail_length, 0.05, 1},
    {"cut", "height of the line in which a bob ends, m", &Style::cut, -0.3, 0.05},
};

std::string out_of_range(const char* field, double value, double least, double most) {
    char text[160];
    std::snprintf(text, sizeof text, "%s is %.9g; its range is [%.9g, %.9g]", field, value, least,
                  most);
    return text;
}

Style make_long() {
    Style style;
    style.wave_amplitude = 0.004;
    return style;
}

Style make_braid() {
    Style style;
    style.hairstyle = Hairstyle::Braid;
    style.strands = 5000;
    style.vertices = 64;
    style.volume = 0.006;
    style.lift = 0.1;
    style.stray = 0.0006;
    style.length_variation = 0.5; // of the tuft after the tie
    return style;
}

Style make_curly() {
    Style style;
    style.hairstyle = Hairstyle::Curly;
    style.vertices = 32;
    style.length = 0.16; // before its weight draws the curls out
    style.length_variation = 0.3;
    style.volume = 0.03;
    style.lift = 0.7;
    style.stiffness = 0.05;
    style.clumps = 400;
    style.clump_tightness = 0.85;
    style.stray = 0.0015;
    style.curl_radius = 0.009;
    style.curl_pitch = 0.022;
    style.curl_variation = 0.2;
    return style;
}

Style make_short() {
    Style style;
    style.hairstyle = Hairstyle::Short;
    style.vertices = 8;
    style.length = 0.08;
    style.length_variation = 0.35;
    style.volume = 0.016;
    style.lift = 0.45;
    style.stiffness = 0.03;
    style.clumps = 500;
    style.clump_tightness = 0.35;
    style.stray = 0.002;
    return style;
}

Style make_ponytail() {
    Style style;
    style.hairstyle = Hairstyle::Ponytail;
    style.strands = 5000;
    style.vertices = 32;
    style.volume = 0.006;
    style.lift = 0.1;
    style.stray = 0.0006;
    style.length_variation = 0.35; // of the tail
    return style;
}

// 2 to 31 mm above the ball: of the layer, what a strand is off the ball is drawn evenly.
Style make_ball_style() {
    Style style;
    style.hairstyle = Hairstyle::Ball;
    style.strands = 2000;
    style.length = 0.25;
    style.length_variation = 0;
    style.volume = 0.03;
    return style;
}

// Long enough that nearly all of it is cut.
Style make_bob() {
    Style style;
    style.hairstyle = Hairstyle::Bob;
    style.length = 0.32;
    style.length_variation = 0;
    style.volume = 0.018;
    style.lift = 0.55;
    style.clumps = 400;
    style.clump_tightness = 0.35;
    style.stray = 0.002;
    return style;
}

Style make_afro() {
    Style style;
    style.hairstyle = Hairstyle::Afro;
    style.vertices = 32;
    style.length = 0.095; // from the scalp to the tip of a coil
    style.length_variation = 0.15;
    style.stray = 0.01;
    style.curl_radius = 0.004;
    style.curl_pitch = 0.024;
    style.curl_variation = 0.15;
    return style;
}

// A lock is as thick as a finger: there are few.
Style make_dreadlocks() {
    Style style;
    style.hairstyle = Hairstyle::Dreadlocks;
    style.strands = 160;
    style.vertices = 20;
    style.clumps = 160;
    style.length = 0.4;
    style.length_variation = 0.25;
    style.volume = 0.04;
    style.lift = 0.6;
    style.stiffness = 0.035;
    style.clump_tightness = 0;
    style.stray = 0.006;
    return style;
}

Style make_beard() {
    Style style;
    style.hairstyle = Hairstyle::Beard;
    style.strands = 4000;
    style.vertices = 8;
    style.length = 0.055;
    style.length_variation = 0.35;
    style.volume = 0.02;
    style.lift = 0.5;
    style.stiffness = 0.02;
    style.clumps = 300;
    style.clump_tightness = 0.45;
    style.stray = 0.0025;
    return style;
}

Style make_fur() {
    Style style;
    style.hairstyle = Hairstyle::Fur;
    style.vertices = 8;
    style.length = 0.03;
    style.length_variation = 0.3;
    style.lift = 0.45;
    style.stray = 0.003;
    return style;
}

constexpr std::string_view names[] = {"long", "braid", "curly",      "short", "ponytail", "ball",
                                      "bob",  "afro",  "dreadlocks", "beard", "fur"};
static_assert(std::size(names) == hairstyle_count);

} // namespace

std::string_view hairstyle_name(Hairstyle hairstyle) {
    return names[static_cast<uint32_t>(hairstyle)];
}

bool is_on_ball(Hairstyle hairstyle) {
    return hairstyle == Hairstyle::Ball || hairstyle == Hairstyle::Fur;
}

Style make_style(Hairstyle hairstyle) {
    switch (hairstyle) {
    case Hairstyle::Long:
        break;
    case Hairstyle::Braid:
        return make_braid();
    case Hairstyle::Curly:
        return make_curly();
    case Hairstyle::Short:
        return make_short();
    case Hairstyle::Ponytail:
        return make_ponytail();
    case Hairstyle::Ball:
        return make_ball_style();
    case Hairstyle::Bob:
        return make_bob();
    case Hairstyle::Afro:
        return make_afro();
    case Hairstyle::Dreadlocks:
        return make_dreadlocks();
    case Hairstyle::Beard:
        return make_beard();
    case Hairstyle::Fur:
        return make_fur();
    }
    return make_long();
}

std::span<const StyleField> style_fields() {
    return fields;
}

std::string style_problem(const Style& style) {
    if (style.strands < 1 || style.strands > 1000000)
        return out_of_range("strands", style.strands, 1, 1e6);
    if (style.vertices < 2 || style.vertices > 256)
        return out_of_range("vertices", style.vertices, 2, 256);
    if (style.clumps < 1 || style.clumps > 100000)
        return out_of_range("clumps", style.clumps, 1, 1e5);
    for (const StyleField& field : fields) {
        const double value = style.*field.value;
        if (!(value >= field.least && value <= field.most))
            return out_of_range(field.name, value, field.least, field.most);
    }
    return {};
}

} // namespace plait_generator
