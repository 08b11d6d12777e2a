// tressfx_follow: x_f = x_g + (tip_separation i / count + 1) offset, beside every vertex of the guide.
// Published, the offset is fixed in rest space, so a follower changes sides when the head turns.
// Ours turns with the guide: by its root's pose, then by the turn of its segment from rest to now.
#include "backend/reference/base/stages.hpp"

#include <algorithm>

namespace plait::reference {
namespace {

struct Guide {
    size_t root; // item of vertex 0
    size_t strand;
    uint32_t count;
};

Vec3 turned_offset(const Vec3& offset, const Guide& guide, uint32_t i,
                   const tressfx_follow_args& args) {
    const size_t from = guide.root + std::min(i, guide.count - 2);
    const Quat pose = pose_of(args.pose, guide.strand).q;
    const Vec3 rest = pose * (xyz(args.rest[from + 1]) - xyz(args.rest[from]));
    const Vec3 now = xyz(args.position[from + 1]) - xyz(args.position[from]);
    return turn(rest, now) * (pose * offset);
}

} // namespace

void tressfx_follow(uint32_t item_count, const plait_tressfx_follow_params& params,
                    const tressfx_follow_args& args) {
    const uint32_t stride = params.vertex_stride;
    for (size_t item = 0; item < item_count; ++item) {
        const StrandVertex at = strand_vertex(item, stride);
        const uint32_t strand = args.follow_guide[at.strand];
        if (strand >= params.guide_count)
            throw BadDispatch(format("follow_guide[%zu] is %u, there are %u guides", at.strand,
                                     strand, params.guide_count));
        const Guide guide{size_t{strand} * stride, strand,
                          vertices_of(args.vertex_count, strand, stride)};
        const uint32_t i = std::min(at.index, guide.count - 1); // padding repeats the tip
        const Vec3 offset = xyz(args.follow_offset[at.strand]);
        const Vec3 aside =
            params.form == PLAIT_FOLLOW_ROTATING ? turned_offset(offset, guide, i, args) : offset;
        const Vec4 x = args.position[guide.root + i];
        const double spread = static_cast<double>(params.tip_separation) * i / guide.count + 1;
        args.position[size_t{params.guide_count} * stride + item] =
            with_w(xyz(x) + spread * aside, x.w());
    }
}

} // namespace plait::reference
