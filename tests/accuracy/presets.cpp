// Each kind of hair does in motion what makes it that kind.
#include "generator/generator.hpp"

#include <plait/plait.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace {

using plait_generator::Hairstyle;
using Point = std::array<double, 3>;

double distance(const Point& a, const Point& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

// A character with hair of a kind, on the mannequin or the ball, whose head turns.
class Wearer {
  public:
    Wearer(const char* preset, Hairstyle hairstyle, uint32_t strands, uint32_t follows = 0)
        : style_(with(hairstyle, strands)), groom_(make_groom(style_)),
          sim_(context_, given(), desc_of(hairstyle, follows)) {
        sim_.set_preset(preset);
        const bool ball = is_on_ball(hairstyle);
        for (const plait_generator::Capsule& capsule :
             ball ? plait_generator::ball_colliders() : plait_generator::head_colliders())
            add(capsule);
        for (const plait_generator::Tie& tie : make_ties(style_))
            hold(tie);
    }

    // To an angle about the vertical axis, within one frame.
    void turn_to(double angle) {
        angle_ = angle;
        plait_pose pose{};
        pose.q[1] = static_cast<float>(std::sin(angle / 2));
        pose.q[3] = static_cast<float>(std::cos(angle / 2));
        auto roots = plait_roots_defaults();
        roots.head = pose;
        plait::check(plait_sim_set_roots(sim_.get(), &roots));
        for (const plait_collider_id id : on_head_)
            plait::check(plait_collider_set_pose(sim_.get(), id, &pose));
        sim_.step(1.0 / 60);
    }
    void rest(double seconds) {
        for (int frame = 0; frame < std::lround(60 * seconds); ++frame)
            turn_to(angle_);
    }
    // `turns` times to both sides and back to the middle, by `most` rad.
    void shake(double most, double hertz, double turns, const auto& each_frame) {
        for (int frame = 1; frame <= std::lround(60 * turns / hertz); ++frame) {
            turn_to(most * std::sin(2 * std::numbers::pi * hertz * frame / 60));
            each_frame();
        }
        turn_to(0);
    }
    void shake(double most, double hertz, double turns) {
        shake(most, hertz, turns, [] {});
    }

    // Of all strands, those that follow among them, in the frame of the head.
    std::vector<Point> vertices() const {
        const auto x = sim_.read(PLAIT_FIELD_POSITION);
        std::vector<Point> points;
        const double c = std::cos(angle_), s = std::sin(angle_);
        for (size_t i = 0; i < x.size(); i += 4) {
            const auto px = double(x[i]), py = double(x[i + 1]), pz = double(x[i + 2]);
            points.push_back({c * px - s * pz, py, s * px + c * pz});
        }
        return points;
    }
    std::vector<Point> at(double share) const { // of the length
        const auto all = vertices();
        std::vector<Point> points;
        const auto row = static_cast<size_t>(std::lround(share * (style_.vertices - 1)));
        for (size_t i = row; i < all.size(); i += style_.vertices)
            points.push_back(all[i]);
        return points;
    }
    std::vector<Point> tips() const { return at(1); }

  private:
    static plait_generator::Style with(Hairstyle hairstyle, uint32_t strands) {
        plait_generator::Style style = make_style(hairstyle);
        style.strands = strands;
        return style;
    }
    plait::Groom given() const {
        auto desc = plait_groom_desc_defaults();
        desc.positions = plait::view(groom_.positions, 3);
        desc.vertices_per_strand = style_.vertices;
        return plait::Groom(desc);
    }
    static plait::SimDesc desc_of(Hairstyle hairstyle, uint32_t follows) {
        plait::SimDesc desc;
        desc.sag_free =
            hairstyle == Hairstyle::Dreadlocks ? PLAIT_SAG_FREE_OFF : PLAIT_SAG_FREE_STIFFEN;
        desc.substeps = 2;
        desc.follows_per_guide = follows;
        return desc;
    }
    void add(const plait_generator::Capsule& capsule) {
        auto desc = plait_collider_desc_defaults();
        std::ranges::copy(capsule.a, desc.capsule.a);
        std::ranges::copy(capsule.b, desc.capsule.b);
        desc.capsule.radius_a = capsule.radius_a;
        desc.capsule.radius_b = capsule.radius_b;
        const plait_collider_id id = sim_.create_collider(desc);
        if (capsule.moves_with_head)
            on_head_.push_back(id);
    }
    void hold(const plait_generator::Tie& tie) {
        std::vector<plait_pin> pins;
        for (uint32_t i = 0; i < groom_.positions.size() / 3; ++i) {
            const float* const p = &groom_.positions[3 * size_t{i}];
            if (i % style_.vertices == 0 ||
                std::hypot(p[0] - tie.at[0], p[1] - tie.at[1], p[2] - tie.at[2]) > tie.radius)
                continue;
            plait_pin pin{};
            pin.stiffness = PLAIT_PIN_HELD;
            pin.strand = i / style_.vertices;
            pin.vertex = i % style_.vertices;
            pins.push_back(pin);
        }
        sim_.set_pins(pins);
    }

    plait::Context context_;
    plait_generator::Style style_;
    plait_generator::Strands groom_;
    plait::Sim sim_;
    std::vector<plait_collider_id> on_head_;
    double angle_ = 0;
};

Point mean_of(const std::vector<Point>& points) {
    Point mean{};
    for (const Point& p : points)
        for (size_t k = 0; k < 3; ++k)
            mean[k] += p[k] / double(points.size());
    return mean;
}

// rms distance from their mean.
double spread(const std::vector<Point>& points) {
    const Point mean = mean_of(points);
    double sum = 0;
    for (const Point& p : points)
        sum += distance(p, mean) * distance(p, mean);
    return std::sqrt(sum / double(points.size()));
}

double rms_apart(const std::vector<Point>& a, const std::vector<Point>& b) {
    double sum = 0;
    for (size_t i = 0; i < a.size(); ++i)
        sum += distance(a[i], b[i]) * distance(a[i], b[i]);
    return std::sqrt(sum / double(a.size()));
}

// Median of the distances to the nearest other point.
double nearest(const std::vector<Point>& points) {
    std::vector<double> gaps;
    for (size_t i = 0; i < points.size(); ++i) {
        double least = 1;
        for (size_t j = 0; j < points.size(); ++j)
            if (j != i)
                least = std::min(least, distance(points[i], points[j]));
        gaps.push_back(least);
    }
    std::ranges::nth_element(gaps, gaps.begin() + std::ptrdiff_t(gaps.size() / 2));
    return gaps[gaps.size() / 2];
}

TEST(Afro, keeps_its_volume_when_the_head_turns) {
    Wearer wearer("afro", Hairstyle::Afro, 400);
    const double at_rest = spread(wearer.tips());
    double least = 1, most = 0;
    wearer.shake(0.7, 1.5, 3, [&] {
        const double now = spread(wearer.tips()) / at_rest;
        least = std::min(least, now);
        most = std::max(most, now);
    });
    EXPECT_GT(least, 0.95);
    EXPECT_LT(most, 1.05);
}

TEST(Bob, flies_up_and_is_back_within_half_a_second) {
    Wearer wearer("bob", Hairstyle::Bob, 400);
    wearer.rest(1);
    const auto before = wearer.tips();
    double most = 0;
    wearer.shake(0.8, 1.5, 2, [&] { most = std::max(most, rms_apart(wearer.tips(), before)); });
    EXPECT_GT(most, 0.02) << "m: it must swing at all";
    wearer.rest(0.5);
    EXPECT_LT(rms_apart(wearer.tips(), before), 0.2 * most);
}

// What of a ponytail or a braid is near its end. A ponytail of limp hair fans out to 1.8 times its width, and a
// braid that is too stiff to 1.7.
void expect_holds_together(const char* preset, Hairstyle hairstyle) {
    Wearer wearer(preset, hairstyle, 300);
    wearer.rest(1);
    const double before = spread(wearer.at(0.75));
    double most = 0;
    wearer.shake(0.6, 1.2, 3, [&] { most = std::max(most, spread(wearer.at(0.75))); });
    EXPECT_LT(most, 1.25 * before) << "in motion";
    wearer.rest(1);
    EXPECT_LT(spread(wearer.at(0.75)), 1.05 * before) << "at rest again";
}

TEST(Ponytail, stays_a_tail) {
    expect_holds_together("ponytail", Hairstyle::Ponytail);
}
TEST(Braid, stays_a_braid) {
    expect_holds_together("braid", Hairstyle::Braid);
}

TEST(Dreadlocks, do_not_fan) {
    constexpr uint32_t follows = 16;
    Wearer wearer("dreadlocks", Hairstyle::Dreadlocks, 60, follows);
    wearer.rest(1);
    const auto widest = [&] {
        const auto tips = wearer.tips(); // guides first, then follows guide by guide
        double most = 0;
        for (size_t guide = 0; guide < 60; ++guide) {
            const auto first = tips.begin() + std::ptrdiff_t(60 + follows * guide);
            most = std::max(most, spread({first, first + follows}));
        }
        return most;
    };
    const double before = widest();
    wearer.shake(0.6, 1.2, 2, [&] { EXPECT_LT(widest(), 1.1 * before); });
}

TEST(ShortFur, does_not_clump_on_a_turning_body) {
    Wearer wearer("short_fur", Hairstyle::Fur, 800);
    const double before = nearest(wearer.tips());
    wearer.shake(1, 1.5, 2, [&] { ASSERT_GT(nearest(wearer.tips()), 0.8 * before); });
}

// A tip in the frame of the head: how far it goes, and how soon it is at rest again.
double swing_of(const char* preset) {
    Wearer wearer(preset, Hairstyle::Long, 200);
    wearer.rest(1);
    const auto before = wearer.tips();
    wearer.shake(0.6, 1, 1);
    wearer.rest(0.7);
    return rms_apart(wearer.tips(), before);
}

TEST(Straight, coarse_hair_is_at_rest_later_than_fine) {
    const double fine = swing_of("straight_fine"), coarse = swing_of("straight_coarse");
    EXPECT_GT(coarse, 1.2 * fine);
}

} // namespace
