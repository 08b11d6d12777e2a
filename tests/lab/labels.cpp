// Where the texts of a figure go.
#include "chart/labels.hpp"

#include <gtest/gtest.h>

namespace {

using lab::Box;
using lab::Label;
using lab::Spot;

constexpr Box area{0, 0, 700, 500};

// Twenty methods whose costs and errors are nearly the same, as three models' are in a figure.
std::vector<Label> crowd() {
    std::vector<Label> labels;
    for (int i = 0; i < 20; ++i)
        labels.push_back({{300.0 + 7 * i, 250.0 + 5 * (i % 7)}, std::to_string(i) + "×1 b"});
    return labels;
}

TEST(LabLabels, lie_on_nothing_that_is_taken) {
    const auto labels = crowd();
    lab::Surroundings around{area, {{280, 262, 380, 274}}, {}};
    for (const Label& label : labels)
        around.taken.push_back(
            {label.marker.x - 6, label.marker.y - 6, label.marker.x + 6, label.marker.y + 6});
    const auto places = lab::place_labels(labels, around);
    ASSERT_EQ(places.size(), labels.size());
    std::vector<Box> taken = around.taken;
    for (size_t i = 0; i < labels.size(); ++i)
        if (places[i]) {
            const Box box = lab::box_of(labels[i].text, *places[i]);
            for (const Box& other : taken)
                EXPECT_FALSE(box.meets(other)) << labels[i].text;
            EXPECT_TRUE(area.holds(box));
            taken.push_back(box);
        }
    EXPECT_GE(taken.size(), around.taken.size() + 12); // most find a place
}

TEST(LabLabels, leave_lines_and_edges_free_where_they_can) {
    const std::vector<Label> alone{{{100, 100}, "2×1"}};
    const auto right = lab::place_labels(alone, {area, {}, {}});
    ASSERT_TRUE(right[0]);
    EXPECT_GT(right[0]->x, 100); // where it reads best
    std::vector<Spot> line;
    for (double x = 100; x < 200; x += 4)
        line.push_back({x, 100 + 0.3 * (x - 100)}); // rising to the right
    const auto clear = lab::place_labels(alone, {area, {}, line});
    ASSERT_TRUE(clear[0]);
    for (const Spot spot : line)
        EXPECT_FALSE(lab::box_of("2×1", *clear[0]).holds(spot));
    const auto edge = lab::place_labels({{{695, 100}, "2×1"}}, {area, {}, {}});
    ASSERT_TRUE(edge[0]);
    EXPECT_LT(edge[0]->x, 695);
}

TEST(LabLabels, are_left_out_where_there_is_no_room) {
    const auto places = lab::place_labels({{{100, 100}, "2×1"}}, {area, {{0, 0, 700, 500}}, {}});
    EXPECT_FALSE(places[0]);
}

} // namespace
