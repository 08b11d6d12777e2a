// Follow maps that are bound where hair hangs: what they place, what they cost, what learns from them, and
// what is refused.
#include "support.hpp"

#include <algorithm>
#include <functional>

namespace {

class FollowBind : public OnBackend {};
ON_EVERY_BACKEND(FollowBind);

constexpr double slightly_more = frame + 1e-9; // so that every call makes one step

plait_roots shaken(int i) {
    const float angle = 0.4f * std::sin(0.35f * static_cast<float>(i));
    return head_at({0.1f, -0.2f, 0.3f}, {0, std::sin(angle), 0, std::cos(angle)});
}

plait_view points(const std::vector<float>& rows) {
    return {rows.data(), rows.size() / 4, 16};
}

plait::SimDesc with(const plait::FollowMap& map) {
    plait::SimDesc desc;
    desc.follow_map = map;
    desc.params.drag = 4;
    return desc;
}

plait::SimDesc alone() {
    plait::SimDesc desc;
    desc.params.drag = 4;
    return desc;
}

// Rows of float4 of the groom, padded.
std::vector<float> rows_of(const Strands& strands, size_t row) {
    std::vector<float> rows;
    for (const Strand& strand : strands)
        for (size_t i = 0; i < row; ++i) {
            const Point& p = strand[std::min(i, strand.size() - 1)];
            rows.insert(rows.end(), {p[0], p[1], p[2], 1});
        }
    return rows;
}

// Strands of a sim in the groom's order.
std::vector<float> in_order(const std::vector<float>& positions,
                            const std::vector<uint32_t>& origin) {
    const size_t row = positions.size() / origin.size();
    std::vector<float> ordered(positions.size());
    for (size_t s = 0; s < origin.size(); ++s)
        std::copy_n(&positions[s * row], row, &ordered[origin[s] * row]);
    return ordered;
}

TEST_P(FollowBind, IsBitForBitThatOfTheGroomWhereTheGroomIsWhatHangs) {
    const Strands strands = field(6);
    const plait::Groom all = make_groom(strands);
    const auto [groom, map] = all.guides(5);
    const auto rest = rows_of(strands, all.describe().max_vertices);
    const plait::FollowMap bound = map.bind(all, plait_roots_defaults(), points(rest));
    plait::Sim plain(context, groom, with(map)), sim(context, groom, with(bound));
    for (int i = 0; i < 20; ++i) {
        for (plait::Sim* each : {&plain, &sim}) {
            each->set_roots(shaken(i));
            each->step(slightly_more);
        }
        ASSERT_EQ(plain.read(PLAIT_FIELD_POSITION), sim.read(PLAIT_FIELD_POSITION)) << i;
    }
    const size_t vertices = 5 * plain.describe().vertices_per_strand;
    EXPECT_EQ(sim.describe().device_bytes - plain.describe().device_bytes, 16 * vertices);
    EXPECT_EQ(stages_of(plain), stages_of(sim));
}

// Half a second after, on a head that is elsewhere, turned, and half as large as the groom.
TEST_P(FollowBind, PlacesFollowsWhereTheyHung) {
    const Strands strands = field(6);
    const plait::Groom all = make_groom(strands);
    const auto [groom, map] = all.guides(5);
    const auto origin = map.read<uint32_t>(PLAIT_FOLLOW_MAP_FIELD_STRANDS);
    plait_roots roots = shaken(3);
    roots.scale = 0.5f;
    plait::Sim truth(context, all, alone()), plain(context, groom, with(map));
    for (plait::Sim* each : {&truth, &plain}) {
        each->teleport(roots);
        for (int i = 0; i < 30; ++i)
            each->step(slightly_more);
    }
    const auto hung = truth.read(PLAIT_FIELD_POSITION);
    const plait::FollowMap bound = map.bind(all, roots, points(hung));
    plait::Sim sim(context, groom, with(bound));
    sim.teleport(roots);
    for (int i = 0; i < 30; ++i)
        sim.step(slightly_more);
    const size_t row = sim.describe().vertices_per_strand;
    const auto counts = truth.read<uint32_t>(PLAIT_FIELD_VERTEX_COUNT);
    const auto away = [&](const std::vector<float>& rows) {
        float most = 0;
        for (size_t s = 0; s < counts.size(); ++s)
            for (size_t i = 4 * s * row; i < 4 * (s * row + counts[s]); ++i)
                most = std::max(most, i % 4 < 3 ? std::abs(rows[i] - hung[i]) : 0);
        return most;
    };
    EXPECT_LT(away(in_order(sim.read(PLAIT_FIELD_POSITION), origin)), 2e-6f);
    EXPECT_GT(away(in_order(plain.read(PLAIT_FIELD_POSITION), origin)), 5e-3f) << "nothing to bind";
    EXPECT_EQ(bound.read<uint32_t>(PLAIT_FOLLOW_MAP_FIELD_STRANDS), origin);
    EXPECT_EQ(bound.read<float>(PLAIT_FOLLOW_MAP_FIELD_WEIGHTS),
              map.read<float>(PLAIT_FOLLOW_MAP_FIELD_WEIGHTS));
}

// Hair that hangs, as arrays: strands [from, to) of a sim of them all in the order of a map.
Strands hung_strands(const plait::Groom& all, const std::vector<float>& hung,
                     const std::vector<uint32_t>& origin, size_t from, size_t to) {
    const size_t row = all.describe().max_vertices;
    const auto counts = all.read<uint32_t>(PLAIT_GROOM_FIELD_VERTEX_COUNTS);
    Strands strands;
    for (size_t s = from; s < to; ++s) {
        Strand strand;
        for (size_t i = 0; i < counts[origin[s]]; ++i) {
            const float* const p = &hung[4 * (origin[s] * row + i)];
            strand.push_back({p[0], p[1], p[2]});
        }
        strands.push_back(strand);
    }
    return strands;
}

std::vector<float> hang(const plait::Context& context, const plait::Groom& all) {
    plait::Sim sim(context, all, alone());
    for (int i = 0; i < 30; ++i)
        sim.step(slightly_more);
    return sim.read(PLAIT_FIELD_POSITION);
}

plait::FollowMap of_arrays(const plait::Groom& follows, const plait::FollowMap& weights,
                           uint32_t guides, const std::vector<float>& bound) {
    const auto of = weights.read<uint32_t>(PLAIT_FOLLOW_MAP_FIELD_GUIDES);
    const auto shares = weights.read<float>(PLAIT_FOLLOW_MAP_FIELD_WEIGHTS);
    auto desc = plait_follow_map_desc_defaults();
    desc.follows = follows;
    desc.guide_count = guides;
    desc.guides = plait::view(of, 4);
    desc.weights = plait::view(shares, 4);
    desc.guides_bound = plait::view(bound, 3);
    return plait::FollowMap(desc);
}

TEST(FollowBinds, OfArraysAreThoseOfHangingHair) {
    const auto context = make_context("reference");
    const plait::Groom all = make_groom(field(5));
    const auto [groom, map] = all.guides(4);
    const auto origin = map.read<uint32_t>(PLAIT_FOLLOW_MAP_FIELD_STRANDS);
    const auto hung = hang(context, all);
    const plait::Groom follows = make_groom(hung_strands(all, hung, origin, 4, 25));
    const GroomArrays guides(hung_strands(all, hung, origin, 0, 4));
    plait::Sim given(context, groom, with(of_arrays(follows, map, 4, guides.positions)));
    plait::Sim bound(context, groom, with(map.bind(all, plait_roots_defaults(), points(hung))));
    for (plait::Sim* each : {&given, &bound}) {
        each->set_roots(shaken(1));
        each->step(slightly_more);
    }
    EXPECT_EQ(given.read(PLAIT_FIELD_POSITION), bound.read(PLAIT_FIELD_POSITION));
}

// As those that are learnt of a groom that is drawn as hair hangs.
TEST(FollowBinds, TeachTheSameAsAGroomThatHangs) {
    const auto context = make_context("reference");
    const plait::Groom all = make_groom(field(5));
    const auto [groom, map] = all.guides(4);
    const auto origin = map.read<uint32_t>(PLAIT_FOLLOW_MAP_FIELD_STRANDS);
    const auto hung = hang(context, all);
    const plait::FollowMap bound = map.bind(all, plait_roots_defaults(), points(hung));
    const plait::Groom follows = make_groom(hung_strands(all, hung, origin, 4, 25));
    const plait::Groom drawn = make_groom(hung_strands(all, hung, origin, 0, 25));
    plait::FollowLearner learner(all, bound), other(drawn, of_arrays(follows, map, 4, {})),
        groomed(all, map);
    plait::Sim sim(context, all, alone());
    for (int i = 0; i < 60; ++i) {
        sim.set_roots(shaken(i));
        sim.step(slightly_more);
        const auto now = sim.read(PLAIT_FIELD_POSITION);
        learner.add_frame(shaken(i), points(now));
        groomed.add_frame(shaken(i), points(now));
        std::vector<float> sorted(now.size());
        const size_t row = now.size() / 25;
        for (size_t s = 0; s < 25; ++s)
            std::copy_n(&now[origin[s] * row], row, &sorted[s * row]);
        other.add_frame(shaken(i), points(sorted));
    }
    auto info = plait_follow_fit_info_defaults(), of_groom = plait_follow_fit_info_defaults();
    const plait::FollowMap learnt = learner.learn(&info);
    EXPECT_EQ(learnt.read<float>(PLAIT_FOLLOW_MAP_FIELD_WEIGHTS),
              other.learn().read<float>(PLAIT_FOLLOW_MAP_FIELD_WEIGHTS));
    groomed.learn(&of_groom);
    EXPECT_LT(info.rms_before, 0.9 * of_groom.rms_before);
    // what is learnt is bound as the map was
    plait::Sim given(context, groom, with(learnt));
    const plait::FollowMap again = learnt.bind(all, plait_roots_defaults(), points(hung));
    plait::Sim anew(context, groom, with(again));
    EXPECT_EQ(given.read(PLAIT_FIELD_POSITION), anew.read(PLAIT_FIELD_POSITION));
}

// ---- what is refused ----------------------------------------------------------------------------

struct Input {
    Strands strands = field(3);
    plait::Groom all = make_groom(strands);
    plait::Guides guides = all.guides(2);
    size_t row = all.describe().max_vertices;
    std::vector<float> x = rows_of(strands, row);
    std::vector<uint32_t> origin = guides.map.read<uint32_t>(PLAIT_FOLLOW_MAP_FIELD_STRANDS);
    plait_roots roots = plait_roots_defaults();
    size_t points = 9 * row;
    std::vector<float> bones;

    float& at(size_t strand, size_t vertex, size_t axis) {
        return x[4 * (strand * row + vertex) + axis];
    }
    plait_result bind() {
        roots.bones = plait::view(bones, 12);
        plait_follow_map* map = nullptr;
        const plait_result result = plait_follow_map_bind(guides.map.get(), all.get(), &roots,
                                                          {x.data(), points, 16}, &map);
        EXPECT_EQ(!map, result != PLAIT_OK);
        plait_follow_map_destroy(map);
        return result;
    }
};

void refused(const std::string& sentence, const std::function<void(Input&)>& change,
             plait_result code = PLAIT_INVALID_ARGUMENT) {
    Input input;
    change(input);
    EXPECT_EQ(input.bind(), code) << sentence;
    EXPECT_NE(std::string(plait_last_error()).find(sentence), std::string::npos)
        << "\"" << sentence << "\" is not in: " << plait_last_error();
}

TEST(FollowBinds, SayWhatIsWrongWithHairThatHangs) {
    const std::vector<uint32_t> origin = Input().origin;
    EXPECT_EQ(Input().bind(), PLAIT_OK) << plait_last_error();
    refused("positions[8][2][1], of strand, vertex and axis, is nan",
            [](Input& i) { i.at(8, 2, 1) = NAN; });
    refused("positions.count is 9, range is 9 strands times one number",
            [](Input& i) { i.points = 9; });
    refused("roots->head: quaternion norm is 2", [](Input& i) { i.roots.head.q[3] = 2; });
    refused("positions: guide 0 has its root 0.5 m from where its groom has it, range is [0, ",
            [](Input& i) { i.roots.head.t[1] = 0.5f; });
    refused("positions: guide 1 has vertex 3 where the one before it is", [&](Input& i) {
        for (size_t axis = 0; axis < 3; ++axis)
            i.at(origin[1], 3, axis) = i.at(origin[1], 2, axis);
    });
    refused("positions: follow 4 has vertex 1 where the one before it is", [&](Input& i) {
        for (size_t axis = 0; axis < 3; ++axis)
            i.at(origin[6], 1, axis) = i.at(origin[6], 0, axis);
    });
    refused("the groom has 16 strands, the map is of 2 guides and 7 follows", [](Input& i) {
        i.all = make_groom(field(4));
        i.x.resize(4 * 16 * i.row);
        i.points = 16 * i.row;
    });
    refused(
        "roots->bones are given: give root_poses", [](Input& i) { i.bones.assign(12, 1.0f); },
        PLAIT_UNSUPPORTED);
}

TEST(FollowBinds, SayWhatIsWrongWithBoundGuides) {
    const auto context = make_context("reference");
    const plait::Groom all = make_groom(field(3)), follows = make_groom(tuft(7, 5));
    const auto [groom, map] = all.guides(2);
    const auto rest = groom.read<float>(PLAIT_GROOM_FIELD_POSITIONS);
    const auto refused = [&](const std::string& sentence,
                             const std::function<void(std::vector<float>&)>& change) {
        auto bound = rest;
        change(bound);
        std::string said;
        try {
            plait::Sim(context, groom, with(of_arrays(follows, map, 2, bound)));
        } catch (const plait::Error& error) {
            said = error.what();
            EXPECT_EQ(error.code(), PLAIT_INVALID_ARGUMENT);
        }
        EXPECT_NE(said.find(sentence), std::string::npos)
            << "\"" << sentence << "\" is not in: " << said;
    };
    plait::Sim(context, groom, with(of_arrays(follows, map, 2, rest)));
    refused("desc->guides_bound[3][1] is inf, range is [-1e6, 1e6] m",
            [](auto& x) { x[10] = INFINITY; });
    refused("guides_bound has " + std::to_string(rest.size() / 3 - 1) +
                " vertices, the 2 guides' groom has " + std::to_string(rest.size() / 3),
            [](auto& x) { x.resize(x.size() - 3); });
    refused("desc->follow_map, guides_bound: guide 0 has vertex 1 where",
            [](auto& x) { std::copy_n(&x[0], 3, &x[3]); });
    refused("guide 0 has its root 1 m from where its groom has it", [](auto& x) { x[1] += 1; });
}

} // namespace
