// follow_clump: p_i = x_i + c(s_i) (X(s_i) - x_i), X the centre of the clump at the same share of
// length, is the path of a strand. Each of its segments, as long as it is, has the direction of the
// path's, leant by at most 45 degrees to where the path is: by the distance across the path over the
// way in which it shall come there.
#include "backend/reference/base/ramp.hpp"
#include "backend/reference/base/stages.hpp"

#include <plait/constants.h>

namespace plait::reference {
namespace {

Vec3 place_on(const View<Vec4>& position, size_t row, uint32_t stride, double place) {
    const double held = std::clamp(place, 0.0, stride - 1.0);
    const size_t a = std::min(static_cast<size_t>(held), size_t{stride} - 2);
    const double t = held - static_cast<double>(a);
    return (1 - t) * xyz(position[row + a]) + t * xyz(position[row + a + 1]);
}

Vec3 direction_along(const Vec3& segment, const Vec3& path, const Vec3& gap, double length) {
    const Vec3 along = direction(path.isZero(0) ? segment : path);
    const Vec3 aside = gap - along * along.dot(gap);
    const double reach = PLAIT_CLUMP_REACH * length + PLAIT_CLUMP_REACH_SEGMENTS * segment.norm();
    const double way = std::max(reach, aside.norm());
    return direction(way > 0 ? Vec3(along + aside / way) : along);
}

} // namespace

void follow_clump(uint32_t item_count, const plait_follow_clump_params& params,
                  const follow_clump_args& args) {
    const uint32_t stride = params.vertex_stride;
    for (size_t item = 0; item < item_count; ++item) {
        const size_t from = item * stride, to = (params.guide_count + item) * stride;
        const size_t centre = size_t{args.clump_centre[item]} * stride;
        if (centre == to)
            continue;
        // of a wet follow the centre is its guide
        const double wet =
            params.wet ? PLAIT_WET_FOLLOW * args.strand_wetness[args.clump_centre[item]] : 1;
        if (wet == 0)
            continue;
        const double length = args.follow_arc[from + stride - 1];
        const auto path_at = [&](const Vec3& x, size_t i) {
            const Vec3 aim = place_on(args.position, centre, stride, args.clump_place[from + i]);
            const double drawn = ramp(params.clump, args.follow_arc[from + i] / length);
            return Vec3(x + wet * drawn * (aim - x));
        };
        Vec3 x = xyz(args.position[to]), path = path_at(x, 0), at = x;
        for (size_t i = 1; i < stride; ++i) {
            Vec4& vertex = args.position[to + i];
            if (args.follow_arc[from + i] > args.follow_arc[from + i - 1]) {
                const Vec3 x_now = xyz(vertex), path_now = path_at(x_now, i);
                at += (x_now - x).norm() *
                      direction_along(x_now - x, path_now - path, path - at, length);
                x = x_now;
                path = path_now;
            }
            set_xyz(vertex, at);
        }
    }
}

} // namespace plait::reference
