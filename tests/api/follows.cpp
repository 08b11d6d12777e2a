// Strands that follow by turns: maps, what they choose, where they put hair, and what they cost when
// there are none.
#include "support.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <numbers>
#include <numeric>
#include <set>

namespace {

using Field = plait_follow_map_field;

class Follows : public OnBackend {};
ON_EVERY_BACKEND(Follows);

// `side` x `side` curls of different lengths, 5 mm apart.
Strands field(size_t side) {
    Strands strands;
    for (size_t i = 0; i < side * side; ++i)
        strands.push_back(
            curl({0.005f * static_cast<float>(i / side), 0, 0.005f * static_cast<float>(i % side)},
                 5 + i % 7, 0.02f, 0.3f * static_cast<float>(i)));
    return strands;
}

Point vertex_of(const std::vector<float>& rows, size_t vertex) {
    return {rows[4 * vertex], rows[4 * vertex + 1], rows[4 * vertex + 2]};
}
float distance(const Point& a, const Point& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

plait::SimDesc with(const plait::FollowMap& map, plait_model model = PLAIT_MODEL_ARTICULATED) {
    plait::SimDesc desc;
    desc.model = model;
    desc.follow_map = map;
    return desc;
}

// Farthest that a vertex of a sim is from where `place` takes that of the groom.
template <typename Place>
float farthest(plait::Sim& sim, const plait::FollowMap& map, const Strands& strands, Place place) {
    const auto positions = sim.read(PLAIT_FIELD_POSITION);
    const auto counts = sim.read<uint32_t>(PLAIT_FIELD_VERTEX_COUNT);
    const auto origin = map.read<uint32_t>(PLAIT_FOLLOW_MAP_FIELD_STRANDS);
    const size_t row = sim.describe().vertices_per_strand;
    float most = 0;
    EXPECT_EQ(origin.size(), strands.size());
    for (size_t s = 0; s < origin.size(); ++s) {
        const Strand& rest = strands[origin[s]];
        EXPECT_EQ(counts[s], rest.size());
        for (size_t i = 0; i < row; ++i)
            most = std::max(most, distance(vertex_of(positions, s * row + i),
                                           place(rest[std::min(i, rest.size() - 1)])));
    }
    return most;
}

TEST_P(Follows, AreAtRestWhereTheGroomHasThem) {
    const Strands strands = field(6);
    for (const plait_model model : {PLAIT_MODEL_ARTICULATED, PLAIT_MODEL_TRESSFX}) {
        const auto [groom, map] = make_groom(strands).guides(5);
        plait::Sim sim(context, groom, with(map, model));
        EXPECT_EQ(sim.describe().guides, 5u);
        EXPECT_EQ(sim.describe().strands, 36u);
        EXPECT_LT(farthest(sim, map, strands, [](const Point& p) { return p; }), 1e-6f);
        const float half = std::sqrt(0.5f); // a quarter about y
        sim.teleport(head_at({1, 2, 3}, {0, half, 0, half}));
        EXPECT_LT(farthest(sim, map, strands,
                           [](const Point& p) {
                               return Point{1 + p[2], 2 + p[1], 3 - p[0]};
                           }),
                  2e-6f);
    }
}

// On a head that shakes, whatever moves the guides.
TEST_P(Follows, KeepTheirLengths) {
    const Strands strands = field(6);
    for (const plait_model model : {PLAIT_MODEL_TRESSFX, PLAIT_MODEL_ARTICULATED}) {
        const auto [groom, map] = make_groom(strands).guides(4, 7);
        const auto origin = map.read<uint32_t>(PLAIT_FOLLOW_MAP_FIELD_STRANDS);
        plait::Sim sim(context, groom, with(map, model));
        const size_t row = sim.describe().vertices_per_strand;
        float most = 0, moved = 0;
        for (int i = 0; i < 30; ++i) {
            const float angle = 0.4f * std::sin(0.4f * static_cast<float>(i));
            sim.set_roots(head_at({0, 0, 0}, {0, std::sin(angle), 0, std::cos(angle)}));
            sim.step(frame);
            const auto now = sim.read(PLAIT_FIELD_POSITION);
            for (size_t s = 4; s < origin.size(); ++s) {
                const Strand& rest = strands[origin[s]];
                for (size_t v = 0; v + 1 < rest.size(); ++v)
                    most = std::max(most, std::abs(distance(vertex_of(now, s * row + v),
                                                            vertex_of(now, s * row + v + 1)) -
                                                   distance(rest[v], rest[v + 1])));
                moved = std::max(moved,
                                 distance(rest.back(), vertex_of(now, s * row + rest.size() - 1)));
            }
        }
        EXPECT_LT(most, 1e-6f * 0.2f) << model; // of the longest, m
        EXPECT_GT(moved, 0.02f) << model;
    }
}

// One guide that bends in a circle by 90 degrees: so does a follow of another number of segments.
TEST_P(Follows, TurnAsTheirGuideDoesAtTheSameShareOfLength) {
    Strand guide, follow;
    for (int i = 0; i <= 16; ++i)
        guide.push_back({0.01f * static_cast<float>(i), 0, 0});
    for (int i = 0; i <= 64; ++i)
        follow.push_back({0.00125f * static_cast<float>(i), 0, 0.01f});
    const plait::Groom groom = make_groom({guide}), strands = make_groom({follow});
    const std::array<uint32_t, 4> guides{0, 9, 9, 9};
    const std::array<float, 4> weights{1, 0, 0, 0};
    auto desc = plait_follow_map_desc_defaults();
    desc.follows = strands;
    desc.guide_count = 1;
    desc.guides = plait::view(guides, 4);
    desc.weights = plait::view(weights, 4);
    const plait::FollowMap map(desc);
    EXPECT_TRUE(map.read<uint32_t>(PLAIT_FOLLOW_MAP_FIELD_STRANDS).empty());
    plait::Sim sim(context, groom, with(map, PLAIT_MODEL_ARTICULATED));
    const size_t row = sim.describe().vertices_per_strand;
    ASSERT_EQ(row, 65u);
    std::vector<float> bent(4 * row);
    Point x{0, 0, 0};
    for (size_t i = 0; i < row; ++i) {
        std::copy(x.begin(), x.end(), bent.begin() + static_cast<std::ptrdiff_t>(4 * i));
        const float angle = std::numbers::pi_v<float> / 2 * (static_cast<float>(i) + 0.5f) / 16;
        if (i < 16)
            x = {x[0] + 0.01f * std::cos(angle), x[1] + 0.01f * std::sin(angle), 0};
    }
    sim.write(PLAIT_FIELD_POSITION, bent);
    const auto now = sim.read(PLAIT_FIELD_POSITION);
    const float radius = 0.08f / (std::numbers::pi_v<float> / 2);
    for (size_t i = 0; i <= 64; ++i) {
        const float angle = std::numbers::pi_v<float> / 2 * static_cast<float>(i) / 64;
        EXPECT_LT(distance(vertex_of(now, row + i),
                           {radius * std::sin(angle), radius * (1 - std::cos(angle)), 0.01f}),
                  2e-3f * 0.08f)
            << "vertex " << i;
    }
}

TEST_P(Follows, AreShownBetweenStepsAndRestored) {
    const auto [groom, map] = make_groom(field(5)).guides(4);
    auto desc = with(map);
    desc.interpolate_output = 1;
    desc.keep_last_frame = 1;
    plait::Sim sim(context, groom, desc), other(context, groom, desc);
    sim.set_roots(head_at({0.05f, 0, 0}));
    sim.step(0.04);
    const auto before = sim.read(PLAIT_FIELD_POSITION);
    sim.step(0.005); // no step, but time
    EXPECT_EQ(sim.read(PLAIT_FIELD_POSITION_LAST_FRAME), before);
    EXPECT_GT(largest_difference(sim.read(PLAIT_FIELD_POSITION), before), 1e-6f);
    other.restore(sim.save());
    EXPECT_LT(largest_difference(other.read(PLAIT_FIELD_POSITION), sim.read(PLAIT_FIELD_POSITION)),
              1e-6f); // what the reference has beyond float is not saved
}

TEST_P(Follows, OutliveWhatTheyWereMadeOf) {
    auto guides = std::make_unique<plait::Guides>(make_groom(field(4)).guides(3));
    plait::Sim sim(context, guides->groom, with(guides->map)),
        same(context, guides->groom, with(guides->map));
    guides.reset();
    run(sim, 3);
    run(same, 3);
    EXPECT_EQ(sim.read(PLAIT_FIELD_POSITION), same.read(PLAIT_FIELD_POSITION));
}

std::map<std::string, uint64_t> calls(plait::Sim& sim) {
    std::map<std::string, uint64_t> calls;
    for (const plait_stage_time& time : sim.stage_times())
        calls[time.stage] = time.calls;
    return calls;
}

// Without a map, and with one of guides alone: the same launches, bytes and bits. With one, its
// launches and its bytes are the difference, so that nothing of it is there before.
TEST_P(Follows, CostNothingWhereThereAreNone) {
    const plait::Groom all = make_groom(tuft(16, 8)); // all of one length, and so are rows
    const auto [groom, map] = all.guides(16);
    plait::Sim plain(context, all), none(context, groom, with(map));
    run(plain, 3);
    run(none, 3);
    EXPECT_EQ(calls(plain), calls(none));
    EXPECT_EQ(calls(plain).count("guide_turns") + calls(plain).count("follow_turns"), 0u);
    EXPECT_EQ(plain.describe().device_bytes, none.describe().device_bytes);
    EXPECT_EQ(plain.hash(), none.hash());

    const auto [few, left] = all.guides(4);
    plait::Sim without(context, few), followed(context, few, with(left));
    run(without, 3);
    run(followed, 3);
    EXPECT_EQ(without.hash(), followed.hash()) << "follows never act back";
    auto more = calls(without);
    // at creation and of each call; tangents of guides are written by the model
    more["guide_turns"] = more["follow_turns"] = more["tangents"] = 1 + 3;
    EXPECT_EQ(more, calls(followed));
    constexpr uint64_t float4 = 16, word = 4, row = 8, follows = 12, guides = 4;
    const uint64_t of_guides = guides * row * float4; // guide_turn
    const uint64_t of_vertices = 2 * float4;          // position, tangent
    const uint64_t of_strands = float4 + 7 * word; // weights; guides, the first again; count, lane
    const uint64_t tile = context.describe().tile, lanes = (follows + tile - 1) / tile * tile;
    EXPECT_EQ(followed.describe().device_bytes - without.describe().device_bytes,
              of_guides + follows * (row * of_vertices + of_strands) +
                  lanes * row * 2 * float4) // follow_place, follow_rest
        << "in tiles of " << tile;
}

// ---- what is chosen -----------------------------------------------------------------------------

TEST(FollowMaps, ChooseEachStrandOnce) {
    const Strands strands = field(9);
    const plait::Groom groom = make_groom(strands);
    for (const size_t count : {1, 2, 20, 81}) {
        const auto [guides, map] = groom.guides(count, 3);
        EXPECT_EQ(guides.describe().strands, count);
        auto origin = map.read<uint32_t>(PLAIT_FOLLOW_MAP_FIELD_STRANDS);
        std::ranges::sort(origin);
        std::vector<uint32_t> all(81);
        std::iota(all.begin(), all.end(), 0u);
        EXPECT_EQ(origin, all);
    }
    const auto one = groom.guides(20, 3), same = groom.guides(20, 3), other = groom.guides(20, 4);
    const auto positions = [](const plait::Guides& g) {
        return g.groom.read<float>(PLAIT_GROOM_FIELD_POSITIONS);
    };
    EXPECT_EQ(positions(one), positions(same));
    EXPECT_NE(positions(one), positions(other));
}

// No root is farther from a guide's than twice as far as 16 of them must leave one: a quarter of
// the field's side, half a cell's diagonal.
TEST(FollowMaps, SpreadGuidesOverTheRoots) {
    const Strands strands = field(16);
    const auto [guides, map] = make_groom(strands).guides(16);
    const auto origin = map.read<uint32_t>(PLAIT_FOLLOW_MAP_FIELD_STRANDS);
    for (const Strand& strand : strands) {
        float nearest = 1;
        for (size_t g = 0; g < 16; ++g)
            nearest = std::min(nearest, distance(strand[0], strands[origin[g]][0]));
        EXPECT_LT(nearest, 2 * 0.02f / std::numbers::sqrt2_v<float>);
    }
}

TEST(FollowMaps, WeighTheNearerMore) {
    const Strands strands = field(12);
    const auto [guides, map] = make_groom(strands).guides(14);
    const auto origin = map.read<uint32_t>(PLAIT_FOLLOW_MAP_FIELD_STRANDS);
    const auto of = map.read<uint32_t>(PLAIT_FOLLOW_MAP_FIELD_GUIDES);
    const auto weights = map.read<float>(PLAIT_FOLLOW_MAP_FIELD_WEIGHTS);
    ASSERT_EQ(weights.size(), 4u * (144 - 14));
    for (size_t f = 0; f < 144 - 14; ++f) {
        float sum = 0, before = 0;
        for (size_t k = 0; k < 4; ++k) {
            const float weight = weights[4 * f + k];
            sum += weight;
            ASSERT_LT(of[4 * f + k], 14u);
            const float apart =
                distance(strands[origin[14 + f]][0], strands[origin[of[4 * f + k]]][0]);
            EXPECT_TRUE(weight == 0 || apart > before - 1e-6f);
            EXPECT_TRUE(k == 0 || weight <= weights[4 * f + k - 1]);
            before = weight > 0 ? apart : before;
        }
        EXPECT_NEAR(sum, 1, 1e-6);
    }
}

// Hair that grows to the left and to the right of a line.
TEST(FollowMaps, KeepToTheirSideOfAParting) {
    Strands strands;
    for (size_t i = 0; i < 200; ++i) {
        const float x = 0.0005f * (static_cast<float>(i) - 99.5f), way = x < 0 ? -1 : 1;
        Strand strand;
        for (int v = 0; v < 8; ++v)
            strand.push_back({x + 0.02f * way * static_cast<float>(v),
                              -0.001f * static_cast<float>(v * v),
                              0.001f * static_cast<float>(i % 5)});
        strands.push_back(strand);
    }
    const auto [guides, map] = make_groom(strands).guides(10);
    const auto origin = map.read<uint32_t>(PLAIT_FOLLOW_MAP_FIELD_STRANDS);
    const auto of = map.read<uint32_t>(PLAIT_FOLLOW_MAP_FIELD_GUIDES);
    for (size_t f = 0; f < 190; ++f)
        for (size_t k = 0; k < 4; ++k)
            EXPECT_EQ(origin[10 + f] < 100, origin[of[4 * f + k]] < 100) << "follow " << f;
}

// Uv, thickness and skin go with their strands.
TEST(FollowMaps, GuidesKeepWhatStrandsHave) {
    const GroomArrays arrays(field(4));
    std::vector<float> thickness, weights;
    std::vector<uint32_t> bones;
    for (uint32_t i = 0; i < 16; ++i) {
        thickness.push_back(1e-5f * static_cast<float>(i + 1));
        weights.insert(weights.end(), {1, 0, 0, 0});
        bones.insert(bones.end(), {i, 0, 0, 0});
    }
    auto desc = arrays.desc();
    desc.thickness = plait::view(thickness);
    desc.bone_weights = plait::view(weights, 4);
    desc.bone_indices = plait::view(bones, 4);
    const auto [guides, map] = plait::Groom(desc).guides(3);
    const auto origin = map.read<uint32_t>(PLAIT_FOLLOW_MAP_FIELD_STRANDS);
    const auto kept = guides.read<float>(PLAIT_GROOM_FIELD_THICKNESS);
    const auto index = guides.read<uint32_t>(PLAIT_GROOM_FIELD_BONE_INDICES);
    for (size_t g = 0; g < 3; ++g) {
        EXPECT_EQ(kept[g], thickness[origin[g]]);
        EXPECT_EQ(index[4 * g], origin[g]);
    }
    EXPECT_EQ(guides.describe().bones, *std::max_element(origin.begin(), origin.begin() + 3) + 1);
}

// ---- what is refused ----------------------------------------------------------------------------

struct MapInput {
    plait::Groom follows = make_groom(tuft(2, 4));
    std::vector<uint32_t> guides = {0, 1, 2, 0, 2, 0, 0, 0};
    std::vector<float> weights = {0.5f, 0.25f, 0.25f, 0, 1, 0, 0, 0};
    plait_follow_map_desc desc = plait_follow_map_desc_defaults();

    MapInput() {
        desc.follows = follows;
        desc.guide_count = 3;
    }
    plait_result make() {
        desc.guides = plait::view(guides, 4);
        desc.weights = plait::view(weights, 4);
        plait_follow_map* map = nullptr;
        const plait_result result = plait_follow_map_create(&desc, &map);
        EXPECT_EQ(map == nullptr, result != PLAIT_OK);
        plait_follow_map_destroy(map);
        return result;
    }
};

void refused(const char* sentence, const std::function<void(MapInput&)>& change) {
    MapInput input;
    change(input);
    EXPECT_EQ(input.make(), PLAIT_INVALID_ARGUMENT) << sentence;
    EXPECT_NE(std::string(plait_last_error()).find(sentence), std::string::npos)
        << "\"" << sentence << "\" is not in: " << plait_last_error();
}

TEST(FollowMaps, SayWhatIsWrongWithThem) {
    EXPECT_EQ(MapInput().make(), PLAIT_OK) << plait_last_error();
    refused("follows is NULL", [](MapInput& m) { m.desc.follows = nullptr; });
    refused("guide_count is 0", [](MapInput& m) { m.desc.guide_count = 0; });
    refused("guides.count is 1, there are 2", [](MapInput& m) { m.guides.resize(4); });
    refused("weights.count is 3, there are 2", [](MapInput& m) { m.weights.resize(12); });
    refused("guides[0][2] is 3, range is [0, 2]", [](MapInput& m) { m.guides[2] = 3; });
    refused("weights[1][0] is nan, range is [0, 1]", [](MapInput& m) { m.weights[4] = NAN; });
    refused("weights[0][1] is -0.25", [](MapInput& m) { m.weights[1] = -0.25f; });
    refused("weights[1] add up to 0.5, range is 1 +- 0.001",
            [](MapInput& m) { m.weights[4] = .5f; });
    refused("struct_size", [](MapInput& m) { m.desc.struct_size = 3; });
    MapInput unread;
    unread.guides[3] = unread.guides[5] = 99; // of weight 0
    EXPECT_EQ(unread.make(), PLAIT_OK) << plait_last_error();
}

TEST(FollowMaps, AreOfTheirGuidesAlone) {
    const auto context = make_context("reference");
    const plait::Groom all = make_groom(field(4));
    const auto [groom, map] = all.guides(5);
    plait_sim* sim = nullptr;
    auto desc = with(map);
    EXPECT_EQ(plait::create_sim(context, all, desc, &sim), PLAIT_INVALID_ARGUMENT);
    EXPECT_NE(std::string(plait_last_error()).find("of 5 guides, the groom has 16 strands"),
              std::string::npos)
        << plait_last_error();
    desc.follows_per_guide = 2;
    EXPECT_EQ(plait::create_sim(context, groom, desc, &sim), PLAIT_INVALID_ARGUMENT);
    EXPECT_NE(std::string(plait_last_error()).find("follows_per_guide is 2 and follow_map"),
              std::string::npos)
        << plait_last_error();
    plait_groom* out = nullptr;
    plait_follow_map* made = nullptr;
    for (const size_t count : {0, 17}) {
        EXPECT_EQ(plait_groom_guides(all, count, 0, &out, &made), PLAIT_INVALID_ARGUMENT);
        EXPECT_NE(std::string(plait_last_error()).find("range is [1, 16]"), std::string::npos)
            << plait_last_error();
    }
    EXPECT_TRUE(!sim && !out && !made) << "written on failure";
    size_t size = 0;
    EXPECT_EQ(plait_follow_map_read(map, static_cast<Field>(3), nullptr, &size),
              PLAIT_INVALID_ARGUMENT);
    size = 4;
    uint32_t word = 0;
    EXPECT_EQ(plait_follow_map_read(map, PLAIT_FOLLOW_MAP_FIELD_GUIDES, &word, &size),
              PLAIT_INVALID_ARGUMENT);
}

} // namespace
