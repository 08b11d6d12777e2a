// Weights that make follows move as they do where all strands are simulated.
//
// Source  Chai, Zheng & Zhou 2014: weights of guides, not negative and of sum 1, by least squares over
//         the frames of a full simulation.
// Changed Strands follow by turns here, not by moved positions. A turn is linear in the weights before
//         it is normalised: q = sum_g w_g s_g Q_g, as follow_turns has it. It takes the segment r to
//         e where e q - q r = 0, as a product of quaternions; and e q - q r = (e - R(q) r) q. So the
//         distance of vertex i from where weights w place it is
//
//             d_i = x_0 - sum_g w_g P_g p_0 + sum_(j <= i) (e_j q_j - q_j r_j) / q0_j,
//
//         q0 the q of the map's own weights: right at these, 0 where w moves the follow as it moves,
//         whatever the map's weights, and else off by a share |q / q0 - 1|. It is linear in w, since
//         these sum to 1, and sum_i |d_i|^2 = w' G w, G a 4 x 4 sum over frames. No frame is kept.
#include "core/follows/follow_learner.hpp"

#include "base/format.hpp"
#include "core/base/turn.hpp"
#include "core/follows/bind.hpp"
#include "core/follows/follow_places.hpp"
#include "core/follows/root_pose.hpp"
#include "core/follows/simplex_fit.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace plait {
namespace {

using Eigen::Matrix4d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::Vector4d;

constexpr size_t per_follow = FollowMap::per_strand;
// m, rms: what guides differ by less decides nothing, and the map's own weights stay.
constexpr double unseen = 1e-6;
// Of what the least squares leave: what weights cannot explain in one motion, others will not explain
// by them. Of 0, 0.3 and 1, 1 had the least errors in motion other than that of 1 or 2 s learnt from.
constexpr double doubt = 1;
// Of q0, squared: guides that are more than 150 degrees apart count less.
constexpr double least_turn = 0.0625;

Vector3d point(const float* p) {
    return {double(p[0]), double(p[1]), double(p[2])};
}

Vector3d read(const HairFrame& frame, size_t strand, size_t vertex) {
    return Vector3d(frame.at(strand, vertex).data());
}

Quaterniond pure(const Vector3d& v) {
    return {0, v[0], v[1], v[2]};
}

using Turns = std::span<const std::array<double, 4>>;

// As the stage does between two of a guide's segments.
Vector4d turn_at(Turns turns, float place) {
    const auto a = static_cast<size_t>(place);
    const double t = double(place) - static_cast<double>(a);
    const Vector4d from(turns[a].data());
    if (t == 0)
        return from;
    const Vector4d to(turns[a + 1].data());
    return ((1 - t) * from + (from.dot(to) < 0 ? -t : t) * to).normalized();
}

// What would be 0 if the follow moved as a guide alone does, for each guide.
using Columns = Eigen::Matrix<double, 4, per_follow>;

// (e q - q r) / q0, the columns of `turns` being q; a vector and a scalar part.
Columns misses(const Vector3d& e, const Vector3d& r, const Columns& turns, const Vector4d& q0) {
    const Quaterniond back(
        Vector4d(Quaterniond(q0).conjugate().coeffs() / std::max(q0.squaredNorm(), least_turn)));
    Columns columns;
    for (Eigen::Index k = 0; k < columns.cols(); ++k) {
        const Quaterniond q(Vector4d(turns.col(k)));
        const Vector4d miss = (pure(e) * q).coeffs() - (q * pure(r)).coeffs();
        columns.col(k) = (Quaterniond(miss) * back).coeffs();
    }
    return columns;
}

Vector4d weights_of(const FollowMap& map, size_t follow) {
    return Eigen::Map<const Eigen::Vector4f>(&map.weights[per_follow * follow]).cast<double>();
}

// Weights that are 0 come last.
int guides_of(const Vector4d& weights) {
    return static_cast<int>((weights.array() > 0).count());
}

// The least squares, once to see what they leave, and again with a pull to the map's own weights by a
// share of that (ridge regression, Hoerl & Kennard 1970).
Vector4d learnt(const Matrix4d& gram, const Vector4d& had, double vertices) {
    const auto fit = [&](double pull) -> Vector4d {
        return fit_on_simplex(gram + pull * Matrix4d::Identity(), pull * had, guides_of(had));
    };
    const double least_pull = unseen * unseen * vertices;
    const Vector4d first = fit(least_pull);
    return fit(least_pull + doubt * first.dot(gram * first));
}

} // namespace

FollowLearner::FollowLearner(std::pmr::memory_resource* memory)
    : map_(memory), rest_(memory), origin_(memory), first_(memory), place_(memory), turns_(memory),
      grams_(memory) {}

// Where strands are that have not turned.
void FollowLearner::bind() {
    const float *guide = map_.bound.data(), *follow = map_.strands.positions.data();
    for (size_t i = 0; i < origin_.size(); ++i) {
        const size_t strand = origin_[i], floats = size_t{3} * rest_.vertex_counts[strand];
        const float*& from = i < map_.guide_count ? guide : follow;
        std::copy_n(from, floats, &rest_.positions[3 * first_[strand]]);
        from += floats;
    }
}

void FollowLearner::place_follows() {
    const Middles middles =
        middles_of(rest_.positions, rest_.vertex_counts, place_.get_allocator().resource());
    place_.resize(rest_.positions.size() / 3);
    for (size_t follow = 0; follow < map_.count(); ++follow) {
        const size_t strand = origin_[map_.guide_count + follow];
        const auto own = middles.of(strand);
        for (size_t k = 0; k < per_follow; ++k) {
            const auto guide = middles.of(origin_[map_.guides[per_follow * follow + k]]);
            for (size_t i = 0; i < own.size(); ++i)
                place_[first_[strand] + i + 1][k] = place_in(guide, own[i]);
        }
    }
}

Status FollowLearner::create(const Groom& groom, const FollowMap& map) {
    std::pmr::memory_resource* const memory = place_.get_allocator().resource();
    origin_ = origin_of(map, memory);
    PLAIT_TRY(check_strands(groom, map, origin_));
    const Groom guides = take_strands(groom, std::span(origin_).first(map.guide_count), memory);
    PLAIT_TRY(check_bound(map, guides.strands.positions, guides.strands.vertex_counts,
                          "map, guides_bound"));
    map_ = map;
    rest_ = groom.strands;
    longest_ = groom.shape.max_vertices;
    size_t vertices = 0;
    for (const uint32_t count : rest_.vertex_counts) {
        first_.push_back(vertices);
        vertices += count;
    }
    if (!map.bound.empty())
        bind();
    place_follows();
    turns_.resize(size_t{map.guide_count} * longest_);
    grams_.resize(map.count());
    return {};
}

// As the stage guide_turns does.
void FollowLearner::turn_guide(const RootPoses& roots, const HairFrame& frame, size_t guide) {
    const size_t strand = origin_[guide];
    const uint32_t count = rest_.vertex_counts[strand];
    const float* rest = &rest_.positions[3 * first_[strand]];
    Quaterniond q = pose_of(roots, strand).q;
    for (size_t i = 0; i < longest_; ++i) {
        if (i + 1 < count) {
            const Vector3d r = point(rest + 3 * (i + 1)) - point(rest + 3 * i);
            const Vector3d e = read(frame, strand, i + 1) - read(frame, strand, i);
            q = (turn(q * r, e) * q).normalized();
        }
        Eigen::Map<Vector4d>(turns_[guide * longest_ + i].data()) = q.coeffs();
    }
}

void FollowLearner::add_follow(const RootPoses& roots, const HairFrame& frame, size_t follow) {
    const size_t strand = origin_[map_.guide_count + follow];
    const float* const rest = &rest_.positions[3 * first_[strand]];
    const Vector4d weights = weights_of(map_, follow);
    const int guides = guides_of(weights);
    std::array<Turns, per_follow> turns;
    Vector4d signs = Vector4d::Zero(), first = Vector4d::Zero();
    Columns miss = Columns::Zero();
    const Vector3d root = read(frame, strand, 0);
    for (int k = 0; k < guides; ++k) {
        const size_t guide = map_.guides[per_follow * follow + static_cast<size_t>(k)];
        const RootPose pose = pose_of(roots, origin_[guide]);
        if (k == 0)
            first = pose.q.coeffs();
        signs[k] = first.dot(pose.q.coeffs()) < 0 ? -1 : 1;
        turns[static_cast<size_t>(k)] = Turns(turns_).subspan(guide * longest_, longest_);
        miss.col(k).head<3>() = root - pose.apply(point(rest));
    }
    Eigen::Map<Matrix4d> gram(grams_[follow].data());
    gram += miss.transpose() * miss;
    for (size_t i = 1; i < rest_.vertex_counts[strand]; ++i) {
        Columns q = Columns::Zero();
        for (int k = 0; k < guides; ++k) {
            const auto at = static_cast<size_t>(k);
            q.col(k) = signs[k] * turn_at(turns[at], place_[first_[strand] + i][at]);
        }
        miss += misses(read(frame, strand, i) - read(frame, strand, i - 1),
                       point(rest + 3 * i) - point(rest + 3 * (i - 1)), q, q * weights);
        gram += miss.transpose() * miss;
    }
}

Status FollowLearner::add(const RootPoses& roots, const HairFrame& frame) {
    PLAIT_TRY(check_frame(roots, frame, rest_.vertex_counts));
    for (size_t guide = 0; guide < map_.guide_count; ++guide)
        turn_guide(roots, frame, guide);
    for (size_t follow = 0; follow < map_.count(); ++follow)
        add_follow(roots, frame, follow);
    ++frames_;
    return {};
}

Status FollowLearner::learn(FollowMap& out, Fit& fit) const {
    if (frames_ == 0)
        return Error{PLAIT_INVALID_STATE, "no frame was added"};
    std::pmr::vector<float> weights(out.guides.get_allocator());
    double before = 0, after = 0, all = 0;
    for (size_t follow = 0; follow < map_.count(); ++follow) {
        const Vector4d had = weights_of(map_, follow);
        const Matrix4d gram(grams_[follow].data());
        const double vertices = double(frames_) * map_.strands.vertex_counts[follow];
        const Vector4d has = learnt(gram, had, vertices);
        for (const double weight : has)
            weights.push_back(static_cast<float>(weight));
        before += had.dot(gram * had);
        after += has.dot(gram * has);
        all += vertices;
    }
    fit = {all > 0 ? std::sqrt(before / all) : 0, all > 0 ? std::sqrt(after / all) : 0};
    out.strands = map_.strands;
    out.max_vertices = map_.max_vertices;
    out.guide_count = map_.guide_count;
    out.bound = map_.bound;
    out.origin = map_.origin;
    return set_guides(out, map_.guides, weights);
}

} // namespace plait
