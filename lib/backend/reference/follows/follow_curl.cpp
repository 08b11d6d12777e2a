// follow_curl: a helix of radius r(s) about the strand and, beside it, noise of rms f(s) in two
// directions, in a frame that begins at the root as at rest and is carried along the strand by the
// shortest turns. s is the arc length at rest.
#include "backend/reference/base/noise.hpp"
#include "backend/reference/base/ramp.hpp"
#include "backend/reference/base/stages.hpp"

#include <plait/constants.h>

#include <numbers>

namespace plait::reference {
namespace {

double share_of(uint32_t hash) {
    return std::ldexp(double(hash >> 8), -24);
}

double fade(double t) {
    return t * t * t * (t * (6 * t - 15) + 10);
}

// Two components, each of gradients in [-1, 1).
Vec3 noise(double at, uint32_t strand) {
    const double low = std::floor(at), t = at - low;
    const auto gradient = [&](uint32_t cell) {
        const uint32_t hash = hash_of(cell ^ strand);
        return Vec3(2 * share_of(hash) - 1, 2 * share_of(hash_of(hash)) - 1, 0);
    };
    const auto cell = static_cast<uint32_t>(static_cast<int64_t>(low));
    const Vec3 value = (1 - fade(t)) * t * gradient(cell) + fade(t) * (t - 1) * gradient(cell + 1);
    return value / PLAIT_FRIZZ_NOISE_RMS;
}

struct Strand {
    double length, phase;
    uint32_t hash;
};

Strand strand_of(size_t item, double length, const plait_follow_curl_params& params,
                 const follow_curl_args& args) {
    const uint32_t clump = hash_of(args.clump_centre[item] ^ hash_of(params.seed));
    const auto row = static_cast<uint32_t>(params.guide_count + item);
    const uint32_t hash = hash_of(row ^ hash_of(~params.seed));
    return {length, share_of(clump) + params.scatter * share_of(hash), hash};
}

// In the frame of the strand, along u and v.
Vec3 offset(const Strand& strand, double arc, const plait_follow_curl_params& params) {
    const double angle = 2 * std::numbers::pi * (arc / params.pitch + strand.phase);
    const double share = arc / strand.length;
    return ramp(params.curl, share) * Vec3(std::cos(angle), std::sin(angle), 0) +
           ramp(params.frizz, share) *
               noise(arc / params.frizz_length + share_of(hash_of(strand.hash)), strand.hash);
}

} // namespace

void follow_curl(uint32_t item_count, const plait_follow_curl_params& params,
                 const follow_curl_args& args) {
    const uint32_t stride = params.vertex_stride;
    for (size_t item = 0; item < item_count; ++item) {
        const uint32_t guide = args.follow_guide[item];
        if (guide >= params.guide_count)
            throw BadDispatch(format("follow_guide[%zu] is %u, there are %u guides", item, guide,
                                     params.guide_count));
        const size_t from = item * stride, to = (params.guide_count + item) * stride;
        const Strand strand = strand_of(item, args.follow_arc[from + stride - 1], params, args);
        const Quat pose = pose_of(args.pose, guide).q;
        Vec3 along = pose * xyz(args.follow_way[item]);
        Vec3 u = pose * (turn(Vec3::UnitY(), xyz(args.follow_way[item])) * Vec3::UnitX());
        Vec3 x = xyz(args.position[to]), shown = x;
        for (size_t i = 1; i < stride; ++i) {
            Vec4& vertex = args.position[to + i];
            if (args.follow_arc[from + i] > args.follow_arc[from + i - 1]) {
                const Vec3 now = xyz(vertex), segment = now - x;
                u = turn(along, segment) * u;
                along = segment.isZero(0) ? along : direction(segment);
                const Vec3 aside = offset(strand, args.follow_arc[from + i], params);
                shown = now + aside.x() * u + aside.y() * along.cross(u);
                x = now;
            }
            set_xyz(vertex, shown);
        }
    }
}

} // namespace plait::reference
