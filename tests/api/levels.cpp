// Levels of detail of a groom: nested guides, in one order of strands, bound where hair hangs; and what is
// refused.
#include "support.hpp"

#include <plait/plait_levels.h>

#include <algorithm>
#include <bit>
#include <functional>
#include <memory>

namespace {

using LevelsHandle = std::unique_ptr<plait_levels, decltype(&plait_levels_destroy)>;

constexpr double slightly_more = frame + 1e-9; // so that every call makes one step

plait_levels_desc desc_of(const plait::Groom& groom, const std::vector<uint32_t>& guides = {}) {
    auto desc = plait_levels_desc_defaults();
    desc.groom = groom;
    desc.level_count = static_cast<uint32_t>(guides.size());
    std::ranges::copy(guides, desc.guides);
    return desc;
}

LevelsHandle make(const plait_levels_desc& desc) {
    plait_levels* levels = nullptr;
    EXPECT_EQ(plait_levels_create(&desc, &levels), PLAIT_OK) << plait_last_error();
    return {levels, plait_levels_destroy};
}

std::vector<plait_level> list(const LevelsHandle& levels) {
    size_t count = 0;
    EXPECT_EQ(plait_levels_list(levels.get(), nullptr, &count), PLAIT_OK);
    std::vector<plait_level> list(count, plait_level_defaults());
    EXPECT_EQ(plait_levels_list(levels.get(), list.data(), &count), PLAIT_OK);
    return list;
}

std::vector<uint32_t> guides_of(const LevelsHandle& levels) {
    std::vector<uint32_t> guides;
    for (const plait_level& level : list(levels))
        guides.push_back(level.guides);
    return guides;
}

struct Taken {
    std::unique_ptr<plait_groom, decltype(&plait_groom_destroy)> guides{nullptr,
                                                                        plait_groom_destroy};
    std::unique_ptr<plait_follow_map, decltype(&plait_follow_map_destroy)> map{
        nullptr, plait_follow_map_destroy};

    std::vector<uint32_t> read(plait_follow_map_field field) const {
        size_t size = 0;
        EXPECT_EQ(plait_follow_map_read(map.get(), field, nullptr, &size), PLAIT_OK);
        std::vector<uint32_t> values(size / 4);
        EXPECT_EQ(plait_follow_map_read(map.get(), field, values.data(), &size), PLAIT_OK);
        return values;
    }
};

Taken take(const LevelsHandle& levels, size_t level) {
    plait_groom* guides = nullptr;
    plait_follow_map* map = nullptr;
    EXPECT_EQ(plait_levels_take(levels.get(), level, &guides, &map), PLAIT_OK)
        << plait_last_error();
    Taken taken;
    taken.guides.reset(guides);
    taken.map.reset(map);
    return taken;
}

using SimHandle = std::unique_ptr<plait_sim, decltype(&plait_sim_destroy)>;

SimHandle make_sim(const plait::Context& context, const Taken& level) {
    plait::SimDesc desc;
    desc.follow_map = level.map.get();
    desc.params.drag = 4;
    plait_sim* sim = nullptr;
    plait::check(plait::create_sim(context, level.guides.get(), desc, &sim));
    return {sim, plait_sim_destroy};
}

std::vector<float> positions_of(const SimHandle& sim) {
    size_t size = 0;
    EXPECT_EQ(plait_sim_read(sim.get(), PLAIT_FIELD_POSITION, nullptr, &size), PLAIT_OK);
    std::vector<float> x(size / 4);
    EXPECT_EQ(plait_sim_read(sim.get(), PLAIT_FIELD_POSITION, x.data(), &size), PLAIT_OK);
    return x;
}

TEST(Levels, SuitTheGroom) {
    const auto guides = [](size_t strands) {
        Strands hair;
        for (size_t i = 0; i < strands; ++i)
            hair.push_back(
                {{1e-3f * static_cast<float>(i), 0, 0}, {1e-3f * static_cast<float>(i), -0.1f, 0}});
        return guides_of(make(desc_of(make_groom(hair))));
    };
    EXPECT_EQ(guides(2000), (std::vector<uint32_t>{2000, 512, 128, 32, 0}));
    EXPECT_EQ(guides(1999), (std::vector<uint32_t>{1999, 249, 62, 15, 0}));
    EXPECT_EQ(guides(500), (std::vector<uint32_t>{500, 62, 15, 8, 0}));
    EXPECT_EQ(guides(30), (std::vector<uint32_t>{30, 8, 0}));
    EXPECT_EQ(guides(5), (std::vector<uint32_t>{5, 0}));
}

TEST(Levels, AreTheFartherOffTheFewerTheirGuides) {
    const plait::Groom groom = make_groom(field(7));
    const auto levels = list(make(desc_of(groom, {49, 48, 40, 32, 9, 1})));
    for (size_t i = 1; i < levels.size(); ++i)
        EXPECT_GE(levels[i].share, levels[i - 1].share) << i;
    EXPECT_EQ(levels[0].share, 0.2f);
    EXPECT_LT(levels[1].share, 0.25f);
    EXPECT_FLOAT_EQ(levels[3].share, 0.7f);
    EXPECT_EQ(list(make(desc_of(groom, {0})))[0].share, 1.1f);
}

TEST(Levels, AreNestedInOneOrderOfStrands) {
    const plait::Groom groom = make_groom(field(7));
    const LevelsHandle levels = make(desc_of(groom, {49, 20, 6, 2}));
    const auto order = take(levels, 0).read(PLAIT_FOLLOW_MAP_FIELD_STRANDS);
    ASSERT_EQ(order.size(), 49u);
    auto sorted = order;
    std::ranges::sort(sorted);
    for (uint32_t i = 0; i < 49; ++i)
        EXPECT_EQ(sorted[i], i) << "each strand once";
    for (size_t level = 1; level < 4; ++level) {
        const Taken taken = take(levels, level);
        EXPECT_EQ(taken.read(PLAIT_FOLLOW_MAP_FIELD_STRANDS), order) << level;
        auto info = plait_groom_info_defaults();
        plait_groom_describe(taken.guides.get(), &info);
        EXPECT_EQ(info.strands, list(levels)[level].guides);
        const auto guides = taken.read(PLAIT_FOLLOW_MAP_FIELD_GUIDES);
        EXPECT_EQ(guides.size(), 4 * (49 - info.strands));
        EXPECT_LT(*std::ranges::max_element(guides), info.strands);
    }
    // the same guides as plait_groom_guides
    auto first = std::vector<uint32_t>(order.begin(), order.begin() + 6);
    std::ranges::sort(first);
    auto chosen = groom.guides(6, 0).map.read<uint32_t>(PLAIT_FOLLOW_MAP_FIELD_STRANDS);
    chosen.resize(6);
    EXPECT_EQ(first, chosen);
}

// Hairs that grow side by side and fall on both sides of a shoulder.
TEST(Levels, FollowWhatHangsBesideThem) {
    const auto falls_ahead = [](uint32_t strand) { return strand % 3 == 0; };
    Strands hair;
    std::vector<float> hung; // level, all else as groomed
    for (uint32_t strand = 0; strand < 64; ++strand) {
        const Point root = {0.005f * static_cast<float>(strand / 8), 0,
                            0.005f * static_cast<float>(strand % 8)};
        hair.emplace_back();
        for (int i = 0; i < 5; ++i) {
            const float along = 0.05f * static_cast<float>(i);
            hair.back().push_back({root[0], -along, root[2]});
            hung.insert(hung.end(), {root[0], 0, root[2] + (falls_ahead(strand) ? along : -along)});
        }
    }
    const plait::Groom groom = make_groom(hair);
    auto desc = desc_of(groom, {64, 16, 8});
    const auto across = [&](size_t level) { // share of weights of guides that fall elsewhere
        const Taken taken = take(make(desc), level);
        const auto order = taken.read(PLAIT_FOLLOW_MAP_FIELD_STRANDS);
        const auto guides = taken.read(PLAIT_FOLLOW_MAP_FIELD_GUIDES);
        const auto bits = taken.read(PLAIT_FOLLOW_MAP_FIELD_WEIGHTS);
        const uint32_t first = list(make(desc))[level].guides;
        double sum = 0;
        for (size_t k = 0; k < guides.size(); ++k)
            if (falls_ahead(order[guides[k]]) != falls_ahead(order[first + k / 4]))
                sum += double(std::bit_cast<float>(bits[k]));
        return sum / static_cast<double>(64 - first);
    };
    EXPECT_GT(across(1), 0.25) << "as groomed nobody knows";
    desc.hung = {hung.data(), hung.size() / 3, 12};
    EXPECT_LT(across(1), 0.02);
    EXPECT_LT(across(2), 0.02);
}

class LevelsOn : public OnBackend {};
ON_EVERY_BACKEND(LevelsOn);

// So a change of level shows nothing where hair is at rest.
TEST_P(LevelsOn, HangAlikeWhereverTheyAreBound) {
    const plait::Groom groom = make_groom(field(6));
    plait::SimDesc alone;
    alone.params.drag = 4;
    plait::Sim all(context, groom, alone);
    const auto roots = head_at({0.2f, 1, -0.1f}, {0, 0.6f, 0, 0.8f});
    all.teleport(roots);
    for (int i = 0; i < 30; ++i)
        all.step(slightly_more);
    const auto hung = all.read(PLAIT_FIELD_POSITION);
    const size_t row = hung.size() / 36;
    auto desc = desc_of(groom, {36, 9, 3});
    desc.hung = {hung.data(), hung.size() / 4, 16};
    desc.roots = &roots;
    const LevelsHandle bound = make(desc), groomed = make(desc_of(groom, {36, 9, 3}));
    float as_groomed = 0;
    for (size_t level = 0; level < 3; ++level) {
        const auto farthest = [&](const LevelsHandle& levels) {
            const Taken taken = take(levels, level);
            const auto order = taken.read(PLAIT_FOLLOW_MAP_FIELD_STRANDS);
            const SimHandle sim = make_sim(context, taken);
            plait::check(plait_sim_teleport(sim.get(), &roots));
            for (int i = 0; i < 30; ++i)
                plait::check(plait_sim_step(sim.get(), slightly_more));
            const auto x = positions_of(sim);
            float most = 0;
            for (size_t s = 0; s < 36; ++s)
                for (size_t i = 0; i < row; ++i)
                    most = std::max(most, std::abs(x[s * row + i] - hung[order[s] * row + i]));
            return most;
        };
        EXPECT_LT(farthest(bound), 5e-6f) << level;
        as_groomed = std::max(as_groomed, farthest(groomed));
    }
    EXPECT_GT(as_groomed, 5e-3f) << "nothing to bind";
}

// ---- what is refused ----------------------------------------------------------------------------

void refused(const std::string& sentence, const std::function<void(plait_levels_desc&)>& change,
             plait_result code = PLAIT_INVALID_ARGUMENT) {
    const plait::Groom groom = make_groom(field(3));
    auto desc = desc_of(groom, {9, 4, 0});
    change(desc);
    plait_levels* levels = nullptr;
    EXPECT_EQ(plait_levels_create(&desc, &levels), code) << sentence;
    EXPECT_EQ(levels, nullptr);
    EXPECT_NE(std::string(plait_last_error()).find(sentence), std::string::npos)
        << "\"" << sentence << "\" is not in: " << plait_last_error();
}

TEST(Levels, SayWhatIsWrongWithThem) {
    refused("desc->groom is NULL", [](auto& d) { d.groom = nullptr; });
    refused("desc->level_count is 7, range is [0, 6]", [](auto& d) { d.level_count = 7; });
    refused("desc->guides[0] is 10, range is [0, 9], the groom's strands",
            [](auto& d) { d.guides[0] = 10; });
    refused("desc->guides[2] is 4, range is [0, 3], fewer than the level before",
            [](auto& d) { d.guides[2] = 4; });
    std::vector<float> hung(3 * 9 * 11, 0.25f);
    auto roots = plait_roots_defaults();
    const auto with_hung = [&](auto& d) { d.hung = plait::view(hung, 3); };
    refused("desc->hung.count is 98, range is 9 strands times one number of vertices, at least the "
            "longest's 11",
            [&](auto& d) {
                with_hung(d);
                d.hung.count = 98;
            });
    refused("desc->hung: guide 0 has vertex 1 where the one before it is", with_hung);
    roots.head.q[3] = 2;
    refused("roots->head: quaternion norm is 2", [&](auto& d) {
        with_hung(d);
        d.roots = &roots;
    });
    hung[3 * 11 + 1] = NAN;
    refused("desc->hung[1][0][1], of strand, vertex and axis, is nan", with_hung);
}

TEST(Levels, WithoutGuidesAreNotTaken) {
    const plait::Groom groom = make_groom(field(3));
    const LevelsHandle levels = make(desc_of(groom, {9, 0}));
    plait_groom* guides = nullptr;
    plait_follow_map* map = nullptr;
    for (const auto& [level, sentence] :
         {std::pair{size_t{1}, "level 1 has no guides"}, {2, "level is 2, range is [0, 1]"}}) {
        EXPECT_EQ(plait_levels_take(levels.get(), level, &guides, &map), PLAIT_INVALID_ARGUMENT);
        EXPECT_NE(std::string(plait_last_error()).find(sentence), std::string::npos)
            << plait_last_error();
        EXPECT_TRUE(!guides && !map);
    }
}

} // namespace
