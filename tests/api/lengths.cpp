// Strands of different lengths in one sim: each as in a sim of its length alone, and at its cost.
#include "support.hpp"

#include <algorithm>

namespace {

class Lengths : public OnBackend {};
ON_EVERY_BACKEND(Lengths);

constexpr size_t strands = 240, shorter = 4, longer = 22;

bool is_long(size_t strand) {
    return strand % 20 == 4;
}

// Straight along x and of one length, in coordinates that float32 has exactly: so is the mean
// length, by which contact is scaled, whichever strands are there.
Strand straight(size_t strand, size_t vertices) {
    constexpr float length = 21.0f / 128;
    const float row = static_cast<float>(strand / 16) / 64,
                place = static_cast<float>(strand % 16) / 64;
    Strand list;
    for (size_t i = 0; i < vertices; ++i)
        list.push_back(
            {length * static_cast<float>(i) / static_cast<float>(vertices - 1), row, place});
    return list;
}

// Those of which `wanted` holds.
template <typename Wanted> std::vector<size_t> list_strands(const Wanted& wanted) {
    std::vector<size_t> list;
    for (size_t i = 0; i < strands; ++i)
        if (wanted(i))
            list.push_back(i);
    return list;
}
const auto of_both = [](size_t) { return true; };
const auto of_short = [](size_t i) { return !is_long(i); };

Strands groom_of(const std::vector<size_t>& list) {
    Strands groom;
    for (const size_t i : list)
        groom.push_back(straight(i, is_long(i) ? longer : shorter));
    return groom;
}

plait_material material(uint32_t index) {
    auto m = plait_material_defaults();
    m.line_density = index ? 2e-5f : 5e-6f;
    m.bend_stiffness = index ? 3e-7f : 5e-8f;
    m.curl = index ? 1.0f : 0.5f;
    return m;
}

// A sim of some of the strands, with all that belongs to single ones.
class Some {
  public:
    Some(const plait::Context& context, std::vector<size_t> list,
         uint32_t bdf2 = PLAIT_BDF2_OF_MODEL)
        : list_(std::move(list)), sim_(make(context, bdf2)) {
        row_ = sim_.describe().vertices_per_strand;
        std::vector<plait_pin> pins;
        for (uint32_t i = 0; i < list_.size(); ++i)
            if (list_[i] % 5 == 0)
                pins.push_back({i, last(i), PLAIT_PIN_FRAME_REST, {0, 0, 0}, PLAIT_PIN_HELD});
        sim_.set_pins(pins);
        std::vector<float> pull(4 * list_.size() * row_, 0.0f);
        for (size_t i = 0; i < list_.size(); ++i)
            for (size_t k = 0; k <= last(i); ++k)
                pull[4 * (i * row_ + k) + 2] = list_[i] % 3 ? 2.0f : 0.0f;
        sim_.write(PLAIT_FIELD_ACCELERATION, pull);
    }

    void take(const std::vector<uint32_t>& substeps) {
        std::vector<uint32_t> own;
        for (const size_t i : list_)
            own.push_back(substeps[i]);
        take_substeps(sim_, own);
    }
    // Of each strand of `list`, its own vertices alone.
    std::vector<float> read(plait_field field, const std::vector<size_t>& list) {
        const auto all = sim_.read(field);
        std::vector<float> own;
        for (size_t i = 0; i < list_.size(); ++i)
            if (std::ranges::find(list, list_[i]) != list.end())
                own.insert(own.end(), all.begin() + static_cast<long>(4 * i * row_),
                           all.begin() + static_cast<long>(4 * (i * row_ + last(i) + 1)));
        return own;
    }
    plait::Sim& sim() { return sim_; }

  private:
    plait::Sim make(const plait::Context& context, uint32_t bdf2) {
        plait::SimDesc desc;
        desc.params.bdf2 = bdf2;
        desc.acceleration.on = true;
        const std::vector<plait_material> materials{material(0), material(1),
                                                    plait_material_defaults()};
        std::vector<uint32_t> of;
        for (const size_t i : list_)
            of.push_back(i % 2 ? 2 : static_cast<uint32_t>(i / 2 % 2));
        desc.materials = materials.data();
        desc.material_count = materials.size();
        desc.strand_material = plait::view(of);
        return plait::Sim(context, make_groom(groom_of(list_)), desc);
    }
    uint32_t last(size_t i) const {
        return static_cast<uint32_t>((is_long(list_[i]) ? longer : shorter) - 1);
    }

    std::vector<size_t> list_;
    plait::Sim sim_;
    size_t row_;
};

// Everything that reaches a strand.
template <typename Between> void live(plait::Sim& sim, int steps, const Between& between) {
    auto collider = smooth_collider();
    collider.capsule.radius_a = collider.capsule.radius_b = 0.04f;
    collider.friction = 0.3f;
    collider.pose.t[0] = 0.1f;
    collider.pose.t[1] = -0.02f;
    const auto id = sim.create_collider(collider);
    for (int i = 0; i < steps; ++i) {
        between(i);
        sim.set_roots(head_at({0.05f * std::sin(0.2f * static_cast<float>(i)), 0, 0}));
        collider.pose.t[0] += 0.001f;
        sim.set_collider_pose(id, collider.pose);
        if (i == steps / 3)
            sim.teleport(head_at({1, 2, 3}, {0, 0.6f, 0, 0.8f}));
        if (i == steps / 2) {
            auto params = sim.params();
            params.drag *= 2;
            sim.set_params(params);
        }
        sim.step(frame);
    }
}
constexpr auto nothing = [](int) {};

TEST_P(Lengths, AStrandIsAsInASimOfItsLengthAlone) {
    for (const uint32_t bdf2 : {0u, 1u}) {
        Some both(context, list_strands(of_both), bdf2);
        live(both.sim(), 8, nothing);
        for (const auto& list : {list_strands(is_long), list_strands(of_short)}) {
            Some alone(context, list, bdf2);
            live(alone.sim(), 8, nothing);
            for (const plait_field field : {PLAIT_FIELD_POSITION, PLAIT_FIELD_VELOCITY})
                EXPECT_EQ(both.read(field, list), alone.read(field, list))
                    << ' ' << bdf2 << ' ' << field;
        }
    }
}

// Past its tip a strand has rows of masses that nothing holds: it does not feel them.
TEST_P(Lengths, SoIsAStrandShorterThanItsClass) {
    constexpr long own = 8;
    Strands like, among;
    for (size_t i = 0; i < 9; ++i)
        like.push_back(straight(i, own));
    among = like;
    among.push_back(straight(9, longer));
    const auto strand = [](const std::vector<float>& field, size_t i, size_t row) {
        const auto first = field.begin() + static_cast<long>(4 * row * i);
        return std::vector<float>(first, first + 4 * own);
    };
    plait::SimDesc desc;
    plait::Sim alone(context, make_groom(like), desc), sim(context, make_groom(among), desc);
    live(alone, 20, nothing);
    live(sim, 20, nothing);
    const auto expected = alone.read(PLAIT_FIELD_POSITION), got = sim.read(PLAIT_FIELD_POSITION);
    for (size_t i = 0; i < like.size(); ++i)
        EXPECT_EQ(strand(got, i, longer), strand(expected, i, own));
}

// Switched before every third step.
TEST_P(Lengths, SoIsOneThatSwitchesItsSubsteps) {
    const auto switching = [](Some& some) {
        return [&](int step) {
            std::vector<uint32_t> substeps(strands);
            for (size_t i = 0; i < strands; ++i)
                substeps[i] = 1 + (static_cast<uint32_t>(i) + static_cast<uint32_t>(step / 3)) % 4;
            some.take(substeps);
        };
    };
    Some both(context, list_strands(of_both));
    live(both.sim(), 9, switching(both));
    for (const auto& list : {list_strands(is_long), list_strands(of_short)}) {
        Some alone(context, list);
        live(alone.sim(), 9, switching(alone));
        EXPECT_EQ(both.read(PLAIT_FIELD_POSITION, list), alone.read(PLAIT_FIELD_POSITION, list));
    }
}

TEST_P(Lengths, AreSavedAndRestored) {
    std::vector<uint32_t> substeps(strands);
    for (size_t i = 0; i < strands; ++i)
        substeps[i] = 1 + static_cast<uint32_t>(i) / 2 % 4;
    Some a(context, list_strands(of_both)), b(context, list_strands(of_both));
    run(a.sim(), 3);
    const auto of_one_kind = a.sim().save();
    a.take(substeps);
    run(a.sim(), 3);
    const auto saved = a.sim().save();
    b.sim().restore(saved);
    EXPECT_EQ(substeps_of(b.sim()), substeps_of(a.sim()));
    EXPECT_EQ(b.sim().save(), saved);
    run(a.sim(), 3);
    run(b.sim(), 3);
    const auto list = list_strands(of_both);
    EXPECT_LT(
        largest_difference(a.read(PLAIT_FIELD_POSITION, list), b.read(PLAIT_FIELD_POSITION, list)),
        GetParam() == "opencl" ? 1e-30f : 1e-4f); // `reference` saves floats of its doubles
    b.sim().restore(of_one_kind);
    EXPECT_EQ(b.sim().save(), of_one_kind);
}

TEST_P(Lengths, OfOneKindTakeTheStagesOfOne) {
    using Stages = std::vector<std::pair<std::string, uint64_t>>;
    const Stages of_one = {{"roots", 3}, {"articulated", 3}, {"lane_unpack", 3}};
    const Stages of_two = {{"roots", 3}, {"articulated", 6}, {"lane_unpack", 6}};
    const auto stages = [&](const Strands& groom) {
        plait::Sim sim(context, make_groom(groom));
        return stages_of(sim);
    };
    EXPECT_EQ(stages(tuft(300, 9)), of_one);
    EXPECT_EQ(stages(groom_of(list_strands(of_both))), of_two);
    const auto all = list_strands(of_both);
    EXPECT_EQ(stages(groom_of({all.begin(), all.begin() + 120})), of_one); // too few
}

// Buffers of the lanes are those of both sims. In the sim's own, padded to its longest strand, a
// vertex row has its place at rest, now and a step ago, and its tangent, 16 B each,
// and the length of a segment, 4 B.
TEST_P(Lengths, TakeTheMemoryThatEachTakes) {
    const auto bytes = [&](const std::vector<size_t>& list) {
        plait::Sim sim(context, make_groom(groom_of(list)));
        return sim.describe().device_bytes;
    };
    const uint64_t both = bytes(list_strands(of_both)), long_ones = bytes(list_strands(is_long)),
                   short_ones = bytes(list_strands(of_short));
    const uint64_t padding = 228 * (longer - shorter) * (4 * 16 + 4);
    EXPECT_GT(both, long_ones + short_ones + padding - 4096); // what every sim has, once
    EXPECT_LE(both, long_ones + short_ones + padding);
    Strands all_long;
    for (size_t i = 0; i < strands; ++i)
        all_long.push_back(straight(i, longer));
    plait::Sim padded(context, make_groom(all_long));
    EXPECT_LT(both, padded.describe().device_bytes * 2 / 3);
}

// Every strand has the grid's brake, wherever it lies, and the sums are those of every run.
TEST_P(Lengths, MeetInTheGrid) {
    plait::SimDesc desc;
    desc.grid.on = true;
    desc.grid.diffuse_factor = 0.2f;
    const auto positions = [&](bool grid) {
        desc.grid.on = grid;
        plait::Sim sim(context, make_groom(groom_of(list_strands(of_both))), desc);
        live(sim, 6, nothing);
        EXPECT_EQ(sim.measure().nonfinite, 0u);
        return sim.read(PLAIT_FIELD_POSITION);
    };
    const auto braked = positions(true), free = positions(false);
    EXPECT_EQ(braked, positions(true));
    for (size_t strand : {size_t{3}, size_t{4}}) { // of either length
        float most = 0;
        for (size_t k = 0; k < 4 * longer; ++k)
            most = std::max(
                most, std::abs(braked[4 * longer * strand + k] - free[4 * longer * strand + k]));
        EXPECT_GT(most, 1e-5f) << strand;
    }
}

} // namespace
