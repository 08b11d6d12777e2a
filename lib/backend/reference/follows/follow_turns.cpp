// follow_turns: a follow is its rest shape, each segment turned by the mean of its guides' turns
// there: a weighted sum of quaternions, normalised. Each guide's is between those of two of its
// segments, along the shorter way; guides count with the sign that brings the poses of their roots
// to the first one's side, for turns are made from these, step by step. The root goes with the poses'
// weighted mean place.
#include "backend/reference/base/lanes.hpp"

#include <algorithm>
#include <array>

namespace plait::reference {
namespace {

struct Guide {
    size_t row; // of its turns
    double weight, sign;
};
using Guides = std::array<Guide, 4>;

// n(x), and the identity for 0.
Quat unit(const Vec4& q) {
    return q.isZero(0) ? Quat::Identity() : quat(Vec4(q.normalized()));
}

Vec4 between(const Vec4& a, const Vec4& b, double t) {
    const Vec4 q = (1 - t) * a + (a.dot(b) < 0 ? -t : t) * b;
    return unit(q).coeffs();
}

Vec4 turn_at(const View<const Vec4>& turns, size_t row, uint32_t stride, double place) {
    const double held = std::clamp(place, 0.0, stride - 1.0);
    const size_t a = std::min(static_cast<size_t>(held), size_t{stride} - 2);
    return between(turns[row + a], turns[row + a + 1], held - static_cast<double>(a));
}

Guides guides_of(size_t lane, const plait_follow_turns_params& params,
                 const follow_turns_args& args) {
    Guides guides;
    const Vec4 weight = args.follow_weight[lane];
    Quat first;
    for (size_t k = 0; k < guides.size(); ++k) {
        const uint32_t guide = args.follow_guides[4 * lane + k];
        if (guide >= params.guide_count)
            throw BadDispatch(format("follow_guides[%zu] is %u, there are %u guides", 4 * lane + k,
                                     guide, params.guide_count));
        const Quat q = pose_of(args.pose, guide).q;
        if (k == 0)
            first = q;
        guides[k] = {size_t{guide} * params.vertex_stride, weight[static_cast<int>(k)],
                     q.coeffs().dot(first.coeffs()) < 0 ? -1.0 : 1.0};
    }
    return guides;
}

Vec3 root_of(const Guides& guides, const Vec3& rest, const follow_turns_args& args,
             uint32_t stride) {
    Vec3 root = Vec3::Zero();
    for (const Guide& guide : guides)
        root += guide.weight * pose_of(args.pose, guide.row / stride).apply(rest);
    return root;
}

Quat mean_turn(const Guides& guides, const Vec4& place, const follow_turns_args& args,
               uint32_t stride) {
    Vec4 sum = Vec4::Zero();
    for (size_t k = 0; k < guides.size(); ++k)
        sum += guides[k].weight * guides[k].sign *
               turn_at(args.guide_turn, guides[k].row, stride, place[static_cast<int>(k)]);
    return unit(sum);
}

Vec4 four_of(const Lane& lane, const View<const double>& data, size_t row) {
    return {data[lane.index(row, 0, 4)], data[lane.index(row, 1, 4)], data[lane.index(row, 2, 4)],
            data[lane.index(row, 3, 4)]};
}

} // namespace

void follow_turns(uint32_t item_count, const plait_follow_turns_params& params,
                  const follow_turns_args& args) {
    const uint32_t stride = params.vertex_stride;
    for (size_t slot = 0; slot < item_count; ++slot) {
        const Lane lane(slot, stride, params.tile);
        const Guides guides = guides_of(slot, params, args);
        const size_t to = (params.guide_count + strand_of(args.lane_strand, slot)) * stride;
        Vec3 x = root_of(guides, xyz(four_of(lane, args.follow_rest, 0)), args, stride);
        args.position[to] = with_w(x, four_of(lane, args.follow_rest, 0).w());
        for (size_t i = 1; i < stride; ++i) {
            const Vec4 segment = four_of(lane, args.follow_rest, i);
            const Vec4 place = four_of(lane, args.follow_place, i);
            x += mean_turn(guides, place, args, stride) * xyz(segment);
            args.position[to + i] = with_w(x, segment.w());
        }
    }
}

} // namespace plait::reference
