// Loose hairstyles: every strand falls on its own, then is drawn to its clump's middle, waved or
// wound into a curl, and cut into vertices.
#include "ball.hpp"
#include "braid.hpp"
#include "fall.hpp"
#include "fur.hpp"
#include "generator.hpp"
#include "head_shape.hpp"
#include "ponytail.hpp"
#include "random.hpp"
#include "scalp.hpp"
#include "scatter.hpp"

namespace plait_generator {
namespace {

// Streams of random numbers; 1 to 9 are the roots'.
enum Stream : uint64_t {
    strand_length = 10,
    strand_layer,
    strand_phase,
    strand_stray,
    strand_thickness,
    clump_length,
    clump_phase,
    clump_hand,
    clump_radius,
    clump_pitch,
    clump_side,
    clump_spread
};

constexpr double clearance = 0.0008;        // m from the head once a strand has left it
constexpr double least_clearance = 0.00015; // m, of every vertex but the root

class LooseHair {
  public:
    LooseHair(const Style& style, const std::vector<Vec3>& roots)
        : style_(style), roots_(roots),
          middles_(scatter_roots(std::min<size_t>(style.clumps, roots.size()), scramble(style.seed),
                                 style.hairstyle == Hairstyle::Beard)),
          grid_(middles_, 0.02) {
        for (uint32_t c = 0; c < middles_.size(); ++c)
            axes_.push_back(resample(fall_from(middles_[c], c, c), samples));
    }

    Path strand(uint32_t i) const {
        const uint32_t clump = nearest_clump(roots_[i]);
        Path path = resample(fall_from(roots_[i], i, clump), samples);
        draw_together(path, axes_[clump]);
        path = shaped(path, i, clump);
        push_out(path, field_, clearance, 0.01);
        return path;
    }

  private:
    static constexpr size_t samples = 128;

    double own(Stream stream, uint32_t i) const { return random(style_.seed, stream, i); }
    double own_signed(Stream stream, uint32_t i) const { return 2 * own(stream, i) - 1; }

    // Long hair would come to lie on the shoulders, where none stays: a clump falls before or
    // behind.
    Vec3 comb(Vec3 p, uint32_t clump) const {
        if (style_.hairstyle == Hairstyle::Short)
            return comb_back(p);
        if (style_.hairstyle == Hairstyle::Beard)
            return comb_beard(p);
        const Vec3 parted = comb_parted(p, style_.part);
        return style_.hairstyle == Hairstyle::Long || style_.hairstyle == Hairstyle::Dreadlocks
                   ? comb_past_shoulder(parted, p, falls_before(clump), own(clump_spread, clump))
                   : parted;
    }

    // What grows in front of the ears, with a ragged border.
    bool falls_before(uint32_t clump) const {
        return middles_[clump].z > 0.02 + 0.02 * (own(clump_side, clump) - 0.5);
    }

    // The ends of loose long hair meet nearly in one line: hair that grows lower is shorter.
    double length_of(Vec3 root, uint32_t i, uint32_t clump) const {
        const double uneven = 0.3 * own(strand_length, i) + 0.7 * own(clump_length, clump);
        const double lower = std::clamp((0.13 - root.y) / 0.21, 0.0, 1.0);
        return style_.length * (1 - style_.length_variation * uneven) * (1 - 0.3 * lower) *
               fringe(root);
    }

    // Curls that grow above the brow would fall before the eyes: they are cut to a fringe. Share of
    // the length that is left.
    double fringe(Vec3 root) const {
        if (style_.hairstyle != Hairstyle::Curly)
            return 1;
        const double aside = std::abs(root.x);
        return mix(1.0, 0.45, smoothstep(0.01, 0.06, root.z) * smoothstep(0.06, 0.03, aside));
    }

    // Straight away from the scalp and from the head's middle, and past the ears, as coils that hold one
    // another up.
    Path stand_from(Vec3 root, uint32_t i) const {
        const double length = style_.length * (1 - style_.length_variation * own(strand_length, i));
        const double room = style_.curl_radius * (1 + style_.curl_variation) + clearance;
        Vec3 way = unit(head_normal(root) + unit(root - Vec3{0, -0.02, -0.015}));
        Path path;
        bool meets = true;
        for (int tries = 0; tries < 12 && meets; ++tries) {
            path = {root};
            meets = false;
            Vec3 away;
            for (double along = walk_step; along <= length; along += walk_step) {
                path.push_back(root + along * way);
                const Surroundings here = field_.at(path.back());
                if (here.distance < room * std::min(along / (3 * room), 1.0))
                    away += here.normal;
            }
            meets = dot(away, away) > 0;
            way = unit(way + 0.2 * unit(away, {0, 0, 0}));
        }
        return path;
    }

    Path fall_from(Vec3 root, uint32_t i, uint32_t clump) const {
        if (style_.hairstyle == Hairstyle::Afro)
            return stand_from(root, i);
        const double line = style_.cut + 0.006 * own_signed(strand_length, i);
        const auto cut = [&](Vec3 p) { return style_.hairstyle == Hairstyle::Bob && p.y < line; };
        const double layer = style_.volume * mix(0.25, 1.0, own(strand_layer, i));
        return fall(
            field_, root, [&](Vec3 p) { return comb(p, clump); },
            {length_of(root, i, clump), style_.stiffness, clearance, layer, style_.lift,
             style_.hairstyle != Hairstyle::Beard},
            cut);
    }

    // Of the clumps on the same side of the parting.
    uint32_t nearest_clump(Vec3 root) const {
        uint32_t best = 0;
        double best_gap = 1e9;
        const auto consider = [&](uint32_t c) {
            const bool across = (middles_[c].x < style_.part) != (root.x < style_.part);
            const double gap = length(middles_[c] - root) + (across ? 0.05 : 0);
            if (gap < best_gap || (gap == best_gap && c < best)) {
                best = c;
                best_gap = gap;
            }
        };
        grid_.for_each_near(root, consider);
        if (best_gap > 0.02)
            for (uint32_t c = 0; c < middles_.size(); ++c)
                consider(c);
        return best;
    }

    void draw_together(Path& path, const Path& axis) const {
        for (size_t k = 1; k < path.size(); ++k) {
            const double t = static_cast<double>(k) / static_cast<double>(path.size() - 1);
            path[k] = mix(path[k], axis[k], style_.clump_tightness * smoothstep(0, 0.7, t));
        }
    }

    // Stray wander of the strand, then the clump's wave or curl.
    Path shaped(const Path& path, uint32_t i, uint32_t clump) const {
        const double phase = own(clump_phase, clump) + 0.06 * own_signed(strand_phase, i);
        const double hand = own(clump_hand, clump) < 0.5 ? -1 : 1;
        Path out = wind(
            path, {style_.stray * own(strand_stray, i), 0.07, own(strand_phase, i), hand, 0.08});
        if (style_.wave_amplitude > 0)
            out = wind(out, {style_.wave_amplitude, style_.wave_length, phase, hand, 0.15});
        if (style_.curl_radius > 0) {
            const double radius = 1 + style_.curl_variation * own_signed(clump_radius, clump);
            const double pitch = 1 + style_.curl_variation * own_signed(clump_pitch, clump);
            out = wind(resample(out, 3 * samples),
                       {style_.curl_radius * radius, style_.curl_pitch * pitch, phase, hand, 0.02});
        }
        return out;
    }

    const Style& style_;
    const std::vector<Vec3>& roots_;
    Field field_;
    std::vector<Vec3> middles_; // roots of the clumps
    PointGrid grid_;
    std::vector<Path> axes_; // [clumps][samples]
};

// Vertices between a path's points may cut a corner into the head by less than the field's error.
Vec3 outside(Vec3 p) {
    return head_distance(p) < least_clearance ? to_distance(p, least_clearance) : p;
}

void append(Strands& strands, const Path& vertices, Uv uv, const Style& style, uint32_t i) {
    for (const Vec3 p : vertices)
        for (const double value : {p.x, p.y, p.z})
            strands.positions.push_back(static_cast<float>(value));
    strands.uv.push_back(static_cast<float>(uv.u));
    strands.uv.push_back(static_cast<float>(uv.v));
    strands.vertex_counts.push_back(style.vertices);
    // Diameters of Caucasian scalp hair, 70 to 90 micrometres.
    strands.thickness.push_back(
        static_cast<float>(7e-5 + 2e-5 * random(style.seed, strand_thickness, i)));
}

template <typename Hair> Strands cut(const Hair& hair, const Style& style) {
    Strands strands;
    strands.positions.reserve(size_t{3} * style.strands * style.vertices);
    for (uint32_t i = 0; i < style.strands; ++i) {
        const Path path = hair.strand(i);
        Path vertices = resample(path, style.vertices, 4);
        for (size_t k = 1; k < vertices.size(); ++k)
            vertices[k] = outside(vertices[k]);
        append(strands, vertices, scalp_uv(path.front()), style, i);
    }
    return strands;
}

template <typename Hair> Strands on_ball(const Hair& hair, const Style& style) {
    Strands strands;
    strands.positions.reserve(size_t{3} * style.strands * style.vertices);
    for (uint32_t i = 0; i < style.strands; ++i)
        append(strands, hair.strand(i), hair.uv(i), style, i);
    return strands;
}

} // namespace

Strands make_groom(const Style& style) {
    if (style.hairstyle == Hairstyle::Ball)
        return on_ball(BallHair(style), style);
    if (style.hairstyle == Hairstyle::Fur)
        return on_ball(FurHair(style), style);
    const bool beard = style.hairstyle == Hairstyle::Beard;
    const std::vector<Vec3> roots = scatter_roots(style.strands, style.seed, beard);
    if (style.hairstyle == Hairstyle::Braid)
        return cut(BraidedHair(style, roots), style);
    if (style.hairstyle == Hairstyle::Ponytail)
        return cut(TiedHair(style, roots), style);
    return cut(LooseHair(style, roots), style);
}

// Twice the holder's radius: of every strand a vertex or two, in and beside it.
std::vector<Tie> make_ties(const Style& style) {
    if (style.hairstyle != Hairstyle::Ponytail)
        return {};
    const std::vector<Vec3> none;
    const Vec3 at = TiedHair(style, none).holder();
    return {{{static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z)},
             static_cast<float>(2 * style.holder_radius)}};
}

} // namespace plait_generator
