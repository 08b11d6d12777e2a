// Hair that follows guides, against all of it simulated in small steps: bound where it hangs it is nearer by a
// factor of two and more. Errors are over how far the hair itself swings.
#include "api/support.hpp"
#include "generator/generator.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>
#include <ostream>

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double slightly_more = frame + 1e-9; // so that every call makes one step
constexpr int settling = 60, frames = 200, every = 3;
constexpr double pi = 3.14159265358979323846;

double wave(double hertz, double time) {
    return std::sin(2 * pi * hertz * time);
}

double eased(double time, double begin, double end) {
    const double s = std::clamp((time - begin) / (end - begin), 0.0, 1.0);
    return s * s * (3 - 2 * s);
}

// Of a head that turns by these angles, degrees, about y and x.
plait_roots head(double yaw, double pitch = 0, Vector3d to = Vector3d::Zero()) {
    const Quaterniond q = Quaterniond(Eigen::AngleAxisd(yaw * pi / 180, Vector3d::UnitY())) *
                          Quaterniond(Eigen::AngleAxisd(pitch * pi / 180, Vector3d::UnitX()));
    auto roots = plait_roots_defaults();
    for (Eigen::Index i = 0; i < 4; ++i)
        roots.head.q[i] = static_cast<float>(q.coeffs()[i]);
    for (Eigen::Index i = 0; i < 3; ++i)
        roots.head.t[i] = static_cast<float>(to[i]);
    return roots;
}

struct Motion {
    std::function<plait_roots(double)> head;
    bool gust = false; // of 4 m/s, from 0.3 to 1.5 s
};

std::vector<Motion> motions() {
    return {{[](double t) {
                return head(55 * (eased(t, 0.3, 0.8) - 2 * eased(t, 1.5, 2.2) + eased(t, 3, 3.5)));
            }},
            {[](double t) { return head(32 * eased(t, 0, 0.4) * wave(1.3, t)); }},
            {[](double t) {
                const double begun = eased(t, 0, 0.5);
                return head(
                    4 * begun * wave(1, t), 2 * begun * wave(2, t),
                    begun * Vector3d(0.02 * wave(1, t), 0.0125 * (1 - std::cos(4 * pi * t)), 0));
            }},
            {[](double) { return head(0); }, true}};
}

struct Hair {
    plait_generator::Hairstyle style;
    uint32_t strands, guides;
    float stiffness; // N m^2
    bool bodies;
    double most_groomed, most_bound; // of the swing; what it is at least as groomed, at most bound
};

void PrintTo(const Hair& hair, std::ostream* out) {
    *out << hair.guides << " guides of " << hair.strands << " strands of "
         << plait_generator::hairstyle_name(hair.style);
}

// Strands that hang from a head, and what is in their way.
class Hanging {
  public:
    Hanging(const plait::Context& context, const Hair& hair, const plait::Groom& groom,
            uint32_t substeps, const plait_follow_map* map = nullptr)
        : sim_(context, groom, desc_of(hair, substeps, map)) {
        for (const auto& capsule : plait_generator::head_colliders()) {
            auto desc = plait_collider_desc_defaults();
            std::copy_n(capsule.a, 3, desc.capsule.a);
            std::copy_n(capsule.b, 3, desc.capsule.b);
            desc.capsule.radius_a = capsule.radius_a;
            desc.capsule.radius_b = capsule.radius_b;
            if (!hair.bodies)
                break;
            const auto id = sim_.create_collider(desc);
            if (capsule.moves_with_head)
                on_head_.push_back(id);
        }
        for (int i = 0; i < settling; ++i)
            step(head(0));
        settled_ = sim_.save();
    }

    void begin() {
        sim_.stop_wind();
        pose(head(0));
        sim_.restore(settled_);
    }
    void step(const Motion& motion, int number) {
        const double time = number * frame;
        const bool blows = motion.gust && time >= 0.3 && time < 1.5;
        if (blows != blows_) {
            auto wind = plait_wind_desc_defaults();
            wind.velocity[0] = -3.2f;
            wind.velocity[2] = -2.4f;
            wind.turbulence = 1;
            wind.shelter = 0;
            blows ? sim_.set_wind(wind) : sim_.stop_wind();
            blows_ = blows;
        }
        step(motion.head(time));
    }
    std::vector<float> positions() { return sim_.read(PLAIT_FIELD_POSITION); }

  private:
    static plait::SimDesc desc_of(const Hair& hair, uint32_t substeps,
                                  const plait_follow_map* map) {
        plait::SimDesc desc;
        desc.substeps = substeps;
        desc.follow_map = map;
        desc.material.bend_stiffness = hair.stiffness;
        desc.params.drag = 4;
        return desc;
    }
    void pose(const plait_roots& roots) {
        sim_.set_roots(roots);
        for (const auto id : on_head_)
            sim_.set_collider_pose(id, roots.head);
    }
    void step(const plait_roots& roots) {
        pose(roots);
        sim_.step(slightly_more);
    }

    plait::Sim sim_;
    std::vector<plait_collider_id> on_head_;
    std::vector<unsigned char> settled_;
    bool blows_ = false;
};

// Rows of float4 with strand s where `origin[s]` says.
std::vector<float> in_order(const std::vector<float>& rows, const std::vector<uint32_t>& origin) {
    const size_t row = rows.size() / origin.size();
    std::vector<float> ordered(rows.size());
    for (size_t s = 0; s < origin.size(); ++s)
        std::copy_n(&rows[s * row], row, &ordered[origin[s] * row]);
    return ordered;
}

// Of all vertices, in the head's frame.
std::vector<Vector3d> from_head(const std::vector<float>& rows, const plait_roots& roots) {
    const float *q = roots.head.q, *t = roots.head.t;
    const Quaterniond back =
        Quaterniond(double(q[3]), double(q[0]), double(q[1]), double(q[2])).conjugate();
    std::vector<Vector3d> points;
    points.reserve(rows.size() / 4);
    for (size_t i = 0; i < rows.size(); i += 4)
        points.emplace_back(back * Vector3d(double(rows[i] - t[0]), double(rows[i + 1] - t[1]),
                                            double(rows[i + 2] - t[2])));
    return points;
}

// Sums over frames and vertices, m^2: of distances from the truth, and of its own from its mean.
class Share {
  public:
    void add(const std::vector<Vector3d>& now, const std::vector<Vector3d>& truth) {
        mean_.resize(truth.size(), Vector3d::Zero());
        for (size_t i = 0; i < truth.size(); ++i) {
            away_ += (now[i] - truth[i]).squaredNorm();
            mean_[i] += truth[i];
            squares_ += truth[i].squaredNorm();
        }
        ++count_;
    }
    double squared() const {
        double swing = squares_;
        for (const Vector3d& sum : mean_)
            swing -= sum.squaredNorm() / count_;
        return away_ / swing;
    }

  private:
    std::vector<Vector3d> mean_;
    double away_ = 0, squares_ = 0, count_ = 0;
};

plait::Groom groom_of(const Hair& hair) {
    auto style = plait_generator::make_style(hair.style);
    style.strands = hair.strands;
    const auto strands = plait_generator::make_groom(style);
    auto desc = plait_groom_desc_defaults();
    desc.positions = plait::view(strands.positions, 3);
    desc.vertex_counts = plait::view(strands.vertex_counts);
    return plait::Groom(desc);
}

class Follows : public testing::TestWithParam<Hair> {};

// Weights are those of the nearest roots; rms of the shares of all motions.
TEST_P(Follows, AreNearerBoundWhereHairHangs) {
    const Hair& hair = GetParam();
    const plait::Context context;
    const plait::Groom all = groom_of(hair);
    const auto [guides, map] = all.guides(hair.guides, 1);
    const auto origin = map.read<uint32_t>(PLAIT_FOLLOW_MAP_FIELD_STRANDS);
    Hanging truth(context, hair, all, 4);
    const auto hung = truth.positions();
    const auto bound = map.bind(all, head(0), {hung.data(), hung.size() / 4, 16});
    Hanging groomed(context, hair, guides, 1, map), hanging(context, hair, guides, 1, bound);
    double of_groomed = 0, of_bound = 0;
    for (const Motion& motion : motions()) {
        Share share_groomed, share_bound;
        for (Hanging* each : {&truth, &groomed, &hanging})
            each->begin();
        for (int i = 1; i <= frames; ++i) {
            for (Hanging* each : {&truth, &groomed, &hanging})
                each->step(motion, i);
            if (i % every != 0)
                continue;
            const auto roots = motion.head(i * frame);
            const auto aim = from_head(truth.positions(), roots);
            share_groomed.add(from_head(in_order(groomed.positions(), origin), roots), aim);
            share_bound.add(from_head(in_order(hanging.positions(), origin), roots), aim);
        }
        of_groomed += share_groomed.squared();
        of_bound += share_bound.squared();
    }
    of_groomed = std::sqrt(of_groomed / 4);
    of_bound = std::sqrt(of_bound / 4);
    std::printf("share of the swing: as groomed %.3f, bound %.3f\n", of_groomed, of_bound);
    EXPECT_LT(of_bound, hair.most_bound);
    EXPECT_GT(of_groomed, hair.most_groomed) << "nothing to gain";
}

using plait_generator::Hairstyle;
INSTANTIATE_TEST_SUITE_P(Hair, Follows,
                         testing::Values(Hair{Hairstyle::Long, 1000, 128, 4.7e-8f, false, 0.5,
                                              0.16}));
INSTANTIATE_TEST_SUITE_P(Long, Follows,
                         testing::Values(Hair{Hairstyle::Long, 4000, 128, 4.7e-8f, false, 0.5,
                                              0.16},
                                         Hair{Hairstyle::Curly, 3000, 512, 7e-9f, true, 1, 0.5}));

} // namespace
