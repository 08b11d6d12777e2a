// Detail of follows after the simulation: clumps, curl, frizz; and that it costs nothing where it is
// off.
#include "support.hpp"

#include <algorithm>
#include <functional>
#include <numbers>
#include <set>

namespace {

class Detail : public OnBackend {};
ON_EVERY_BACKEND(Detail);

constexpr float strand_length = 0.2f; // m
constexpr size_t row = 33;
constexpr size_t guide_count = 4;

// `side` x `side` straight strands, 5 mm apart, that grow along a direction of their own.
Strands field(size_t side) {
    Strands strands;
    for (size_t i = 0; i < side * side; ++i) {
        const float a = 0.2f * std::sin(static_cast<float>(i)),
                    b = 0.2f * std::cos(2 * static_cast<float>(i)),
                    c = std::sqrt(1 - a * a - b * b);
        const Point root{0.005f * static_cast<float>(i / side), 0,
                         0.005f * static_cast<float>(i % side)};
        Strand strand;
        for (size_t k = 0; k < row; ++k) {
            const float s = strand_length * static_cast<float>(k) / (row - 1);
            strand.push_back({root[0] + a * s, root[1] + c * s, root[2] + b * s});
        }
        strands.push_back(strand);
    }
    return strands;
}

Point vertex_of(const std::vector<float>& rows, size_t vertex) {
    return {rows[4 * vertex], rows[4 * vertex + 1], rows[4 * vertex + 2]};
}
Point minus(const Point& a, const Point& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
float dot(const Point& a, const Point& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
float length(const Point& a) {
    return std::sqrt(dot(a, a));
}
float distance(const Point& a, const Point& b) {
    return length(minus(a, b));
}

plait_detail_desc clump_of(std::array<float, 4> ramp, uint32_t clumps = 0) {
    auto detail = plait_detail_desc_defaults();
    std::ranges::copy(ramp, detail.clump);
    detail.clumps = clumps;
    return detail;
}
plait_detail_desc curl_of(float radius, float pitch) {
    auto detail = plait_detail_desc_defaults();
    std::fill_n(detail.curl, 4, radius);
    detail.curl_pitch = pitch;
    return detail;
}
plait_detail_desc frizz_of(float rms, float scale) {
    auto detail = plait_detail_desc_defaults();
    std::fill_n(detail.frizz, 4, rms);
    detail.frizz_length = scale;
    return detail;
}
plait_detail_desc all_of_it() {
    auto detail = clump_of({0, 0.4f, 0.8f, 0.9f}, 5);
    std::fill_n(detail.curl, 4, 0.004f);
    std::fill_n(detail.frizz, 4, 0.001f);
    detail.curl_pitch = 0.06f;
    return detail;
}

// A sim whose follows are of a map, or beside its guides; no gravity, so that it stays at rest.
plait::Sim sim_of(plait::Context& context, bool map, plait_model model = PLAIT_MODEL_ARTICULATED) {
    const plait::Groom all = make_groom(field(6));
    const auto [groom, follows] = all.guides(guide_count);
    plait::SimDesc desc;
    desc.model = model;
    desc.params.gravity[1] = 0;
    if (map)
        desc.follow_map = follows;
    else
        desc.follows_per_guide = 8;
    return plait::Sim(context, groom, desc);
}
plait::Sim detailed(plait::Context& context, bool map, const plait_detail_desc& detail,
                    plait_model model = PLAIT_MODEL_ARTICULATED) {
    plait::Sim sim = sim_of(context, map, model);
    sim.set_detail(detail);
    sim.reset();
    return sim;
}

void shake(plait::Sim& sim, int i) {
    const float angle = 0.4f * std::sin(0.4f * static_cast<float>(i));
    sim.set_roots(head_at({0, 0, 0}, {0, 0, std::sin(angle), std::cos(angle)}));
    sim.step(frame);
}

constexpr plait_model models[] = {PLAIT_MODEL_TRESSFX, PLAIT_MODEL_ARTICULATED};

// Never set, set to nothing, set to ramps of 0, dropped: the same launches, bytes and bits.
TEST_P(Detail, CostsNothingWhereThereIsNone) {
    for (const bool map : {true, false}) {
        plait::Sim plain = sim_of(context, map);
        const auto stages = stages_of(plain);
        const auto positions = plain.read(PLAIT_FIELD_POSITION);
        const std::function<void(plait::Sim&)> ways[] = {
            [](plait::Sim& sim) { sim.drop_detail(); },
            [](plait::Sim& sim) { sim.set_detail(plait_detail_desc_defaults()); },
            [](plait::Sim& sim) {
                sim.set_detail(all_of_it());
                sim.drop_detail();
            }};
        for (const auto& way : ways) {
            plait::Sim sim = sim_of(context, map);
            way(sim);
            EXPECT_EQ(stages_of(sim), stages);
            EXPECT_EQ(sim.read(PLAIT_FIELD_POSITION), positions);
            EXPECT_EQ(sim.describe().device_bytes, plain.describe().device_bytes);
            EXPECT_EQ(sim.hash(), plain.hash());
        }
        plait::Sim sim = detailed(context, map, all_of_it());
        run(sim, 3);
        EXPECT_EQ(sim.hash(), plain.hash()) << "it never acts back";
        constexpr uint64_t follows = 32, of_strand = 4 + 16, of_vertex = 4 + 4;
        EXPECT_EQ(sim.describe().device_bytes - plain.describe().device_bytes,
                  follows * (of_strand + row * of_vertex));
    }
}

// In both models, on a head that shakes.
TEST_P(Detail, ClumpedStrandsKeepTheirLengths) {
    for (const plait_model model : models)
        for (const bool map : {true, false}) {
            plait::Sim plain = sim_of(context, map, model),
                       sim = detailed(context, map, clump_of({0.5f, 0.2f, 1, 0.7f}), model);
            float most = 0, moved = 0;
            for (int i = 0; i < 20; ++i) {
                shake(plain, i);
                shake(sim, i);
                const auto a = plain.read(PLAIT_FIELD_POSITION), b = sim.read(PLAIT_FIELD_POSITION);
                for (size_t v = guide_count * row; v + 1 < a.size() / 4; ++v)
                    if (v % row + 1 < row)
                        most = std::max(most,
                                        std::abs(distance(vertex_of(a, v), vertex_of(a, v + 1)) -
                                                 distance(vertex_of(b, v), vertex_of(b, v + 1))));
                moved = std::max(moved, largest_difference(a, b));
                EXPECT_EQ(std::vector(a.begin(), a.begin() + 4 * guide_count * row),
                          std::vector(b.begin(), b.begin() + 4 * guide_count * row));
            }
            EXPECT_LT(most, 1e-5f * strand_length) << model << map;
            EXPECT_GT(moved, map ? 0.003f : 0.001f) << model << map;
        }
}

// With a ramp of 1 from a third on, each comes to the line of its centre and stays there: a tenth of
// the distance is left. Along that line it ends earlier, by what its way there took.
TEST_P(Detail, ClumpsCloseUpAtTheirCentres) {
    plait::Sim plain = sim_of(context, true), sim = detailed(context, true, clump_of({0, 1, 1, 1}));
    const auto of = sim.read<uint32_t>(PLAIT_FIELD_FOLLOW_GUIDE);
    const auto before = plain.read(PLAIT_FIELD_POSITION), after = sim.read(PLAIT_FIELD_POSITION);
    for (size_t f = 0; f < of.size(); ++f) {
        const size_t strand = (guide_count + f) * row, guide = of[f] * row;
        EXPECT_EQ(vertex_of(after, strand), vertex_of(before, strand)) << "root of " << f;
        const auto to_centre = [&](const std::vector<float>& rows) {
            const Point root = vertex_of(rows, guide);
            const Point line = minus(vertex_of(rows, guide + row - 1), root);
            const Point tip = minus(vertex_of(rows, strand + row - 1), root);
            const float along = dot(tip, line) / dot(line, line);
            return distance(tip, {along * line[0], along * line[1], along * line[2]});
        };
        EXPECT_LT(to_centre(after), 0.1f * to_centre(before)) << "follow " << f;
        // no sharper than the turn to the path, 45 degrees, and that of the path itself
        for (size_t i = 1; i + 1 < row; ++i) {
            const Point a = minus(vertex_of(after, strand + i), vertex_of(after, strand + i - 1)),
                        b = minus(vertex_of(after, strand + i + 1), vertex_of(after, strand + i));
            const float cosine = dot(a, b) / length(a) / length(b);
            EXPECT_GT(cosine, std::cos(std::numbers::pi_v<float> / 4)) << f << " at " << i;
        }
    }
}

// So many strands stay where they are as there are clumps; given centres take their place.
TEST_P(Detail, CentresAreSpreadOrGiven) {
    plait::Sim plain = sim_of(context, true);
    const auto before = plain.read(PLAIT_FIELD_POSITION);
    const auto centres_of = [&](const plait_detail_desc& detail) {
        plait::Sim sim = detailed(context, true, detail);
        const auto after = sim.read(PLAIT_FIELD_POSITION);
        std::set<size_t> still;
        for (size_t strand = guide_count; strand < before.size() / 4 / row; ++strand)
            if (vertex_of(before, strand * row + row - 1) ==
                vertex_of(after, strand * row + row - 1))
                still.insert(strand);
        return still;
    };
    for (const uint32_t clumps : {1u, 7u, 32u})
        EXPECT_EQ(centres_of(clump_of({0, 1, 1, 1}, clumps)).size(), clumps);
    std::vector<uint32_t> centres(32, guide_count + 9);
    centres[3] = 2; // a guide
    centres[20] = guide_count + 20;
    auto detail = clump_of({0, 1, 1, 1});
    detail.clump_centres = plait::view(centres);
    EXPECT_EQ(centres_of(detail), (std::set<size_t>{guide_count + 9, guide_count + 20}));
}

// About straight hair, a helix: so far from it, so much longer.
TEST_P(Detail, CurlsAreHelices) {
    constexpr float radius = 0.004f, pitch = 0.1f;
    for (const bool map : {true, false}) {
        plait::Sim plain = sim_of(context, map),
                   sim = detailed(context, map, curl_of(radius, pitch));
        const auto a = plain.read(PLAIT_FIELD_POSITION), b = sim.read(PLAIT_FIELD_POSITION);
        const float chord =
            2 * radius *
            std::sin(std::numbers::pi_v<float> * strand_length / (row - 1) / pitch); // per segment
        const float segment = std::hypot(chord, strand_length / (row - 1));
        for (size_t v = guide_count * row; v < a.size() / 4; ++v) {
            if (v % row == 0) {
                EXPECT_EQ(vertex_of(a, v), vertex_of(b, v)) << "a root";
                continue;
            }
            EXPECT_NEAR(distance(vertex_of(a, v), vertex_of(b, v)), radius, 1e-5 * strand_length);
            if (v % row > 1) {
                EXPECT_NEAR(distance(vertex_of(b, v - 1), vertex_of(b, v)), segment,
                            1e-5f * strand_length);
            }
        }
    }
}

// Of one clump: all turn together, unless they are scattered.
TEST_P(Detail, CurlsOfAClumpTurnTogether) {
    const auto spread_of = [&](float scatter) {
        auto detail = curl_of(0.004f, 0.1f);
        detail.clumps = 1;
        detail.curl_scatter = scatter;
        plait::Sim plain = sim_of(context, true), sim = detailed(context, true, detail);
        const auto a = plain.read(PLAIT_FIELD_POSITION), b = sim.read(PLAIT_FIELD_POSITION);
        float most = 0;
        const auto offset = [&](size_t strand) {
            return minus(vertex_of(b, strand * row + 16), vertex_of(a, strand * row + 16));
        };
        for (size_t strand = guide_count; strand < a.size() / 4 / row; ++strand)
            most = std::max(most, distance(offset(strand), offset(guide_count)));
        return most;
    };
    EXPECT_LT(spread_of(0), 0.4f * 0.004f); // strands are up to 23 degrees apart
    EXPECT_GT(spread_of(1), 1.5f * 0.004f);
}

// Its rms over many strands is what was asked for, and no two strands have the same.
TEST_P(Detail, FrizzIsNoiseOfItsRms) {
    constexpr float rms = 0.002f;
    plait::Sim plain = sim_of(context, true), sim = detailed(context, true, frizz_of(rms, 0.013f));
    const auto a = plain.read(PLAIT_FIELD_POSITION), b = sim.read(PLAIT_FIELD_POSITION);
    double squares = 0, products = 0;
    size_t count = 0;
    for (size_t strand = guide_count; strand + 1 < a.size() / 4 / row; ++strand)
        for (size_t i = 1; i < row; ++i, ++count) {
            const auto offset = [&](size_t of) {
                return minus(vertex_of(b, of * row + i), vertex_of(a, of * row + i));
            };
            const Point one = offset(strand), next = offset(strand + 1);
            squares += double(dot(one, one));
            products += double(dot(one, next));
        }
    EXPECT_NEAR(std::sqrt(squares / 2 / double(count)), double(rms), 0.15 * double(rms));
    EXPECT_LT(std::abs(products / squares), 0.15);
}

// Nothing of it depends on time or place: the same bits whenever guides are where they were, and
// turned with a head that is turned by 90 degrees.
TEST_P(Detail, StaysWithTheHair) {
    for (const bool map : {true, false}) {
        plait::Sim sim = detailed(context, map, all_of_it());
        const auto first = sim.read(PLAIT_FIELD_POSITION);
        const std::vector<float> guides(first.begin(), first.begin() + 4 * guide_count * row);
        run(sim, 3); // guides move by their rounding
        EXPECT_LT(largest_difference(sim.read(PLAIT_FIELD_POSITION), first), 1e-5f * strand_length);
        sim.write(PLAIT_FIELD_POSITION, guides);
        EXPECT_EQ(sim.read(PLAIT_FIELD_POSITION), first);
        const float half = std::sqrt(0.5f); // a quarter about y
        sim.teleport(head_at({1, 2, 3}, {0, half, 0, half}));
        const auto turned = sim.read(PLAIT_FIELD_POSITION);
        for (size_t v = 0; v < first.size() / 4; ++v) {
            const Point p = vertex_of(first, v);
            EXPECT_LT(distance(vertex_of(turned, v), {1 + p[2], 2 + p[1], 3 - p[0]}),
                      1e-5f * strand_length + 1e-6f)
                << v; // 3 m away from the origin, to float's rounding
        }
    }
}

TEST_P(Detail, IsShownBetweenStepsAndAfterRestoring) {
    const auto [groom, map] = make_groom(field(5)).guides(guide_count);
    plait::SimDesc desc;
    desc.follow_map = map;
    desc.interpolate_output = 1;
    plait::Sim sim(context, groom, desc), other(context, groom, desc);
    sim.set_detail(all_of_it());
    other.set_detail(all_of_it());
    sim.set_roots(head_at({0.05f, 0, 0}));
    sim.step(0.04);
    const auto before = sim.read(PLAIT_FIELD_POSITION);
    sim.step(0.005); // no step, but time
    EXPECT_GT(largest_difference(sim.read(PLAIT_FIELD_POSITION), before), 1e-6f);
    other.restore(sim.save());
    EXPECT_LT(largest_difference(other.read(PLAIT_FIELD_POSITION), sim.read(PLAIT_FIELD_POSITION)),
              2e-6f); // what the reference has beyond float is not saved
}

// ---- what is refused ----------------------------------------------------------------------------

struct Refusal {
    std::function<void(plait_detail_desc&)> change;
    const char* message;
};

void expect_refused(plait::Sim& sim, const Refusal& refusal) {
    auto detail = all_of_it();
    refusal.change(detail);
    EXPECT_EQ(plait_sim_set_detail(sim, &detail), PLAIT_INVALID_ARGUMENT) << refusal.message;
    EXPECT_NE(std::string(plait_last_error()).find(refusal.message), std::string::npos)
        << plait_last_error();
}

TEST_P(Detail, RefusesWhatIsOutOfRange) {
    using D = plait_detail_desc;
    plait::Sim sim = detailed(context, true, all_of_it());
    const auto before = sim.read(PLAIT_FIELD_POSITION);
    std::vector<uint32_t> few(31), far(32), circle(32, guide_count);
    far[5] = 36;
    circle[0] = guide_count + 1;
    const auto given = [](const std::vector<uint32_t>& centres) {
        return [&](D& d) {
            d.clumps = 0;
            d.clump_centres = plait::view(centres);
        };
    };
    for (const Refusal& refusal : std::initializer_list<Refusal>{
             {[](D& d) { d.clump[2] = 1.5f; }, "clump[2] is 1.5, range is [0, 1]"},
             {[](D& d) { d.curl[3] = -1; }, "curl[3] is -1, range is [0, 1]"},
             {[](D& d) { d.frizz[0] = NAN; }, "frizz[0] is nan, range is [0, 1]"},
             {[](D& d) { d.curl_pitch = 0; }, "curl_pitch is 0, range is [0.0001, 100]"},
             {[](D& d) { d.curl_scatter = 2; }, "curl_scatter is 2, range is [0, 1]"},
             {[](D& d) { d.frizz_length = 101; }, "frizz_length is 101, range is [0.0001, 100]"},
             {[](D& d) { d.clumps = 33; }, "clumps is 33, range is [0, 32]"},
             {[&](D& d) { d.clump_centres = plait::view(far); }, "clumps is 5, range is [0, 0]"},
             {given(few), "clump_centres.count is 31, the sim has 32 follows"},
             {given(far), "clump_centres[5] is 36, range is [0, 35]"},
             {given(circle), "clump_centres[0] is 5, a strand whose own is 4"}})
        expect_refused(sim, refusal);
    sim.reset();
    EXPECT_EQ(sim.read(PLAIT_FIELD_POSITION), before) << "what was refused changed something";
}

TEST_P(Detail, NeedsFollows) {
    plait::Sim sim(context, make_groom(tuft(2, 6)));
    const auto detail = all_of_it();
    EXPECT_EQ(plait_sim_set_detail(sim, &detail), PLAIT_INVALID_STATE);
    EXPECT_NE(std::string(plait_last_error()).find("no follow strands"), std::string::npos);
    sim.drop_detail();
}

} // namespace
