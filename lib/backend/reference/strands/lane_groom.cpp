// lane_groom: springs to the places of vertices in the groom, carried by the root, beside the pins
// that are there. Stiffness: own + slider droop, no more than m rate and m pull/d, d how far the
// vertex is off, where it is beside its root or where it would go, whichever is nearer.
#include "backend/reference/base/lanes.hpp"

#include <algorithm>

namespace plait::reference {

void lane_groom(uint32_t item_count, const plait_lane_groom_params& params,
                const lane_groom_args& args) {
    for (size_t slot = 0; slot < item_count; ++slot) {
        const size_t strand = strand_of(args.lane_strand, slot);
        const Lane lane(slot, params.vertex_stride, params.tile);
        const uint32_t count = vertices_of(args.vertex_count, strand, params.vertex_stride);
        const Pose pose = pose_of(args.pose, strand);
        const Vec3 root = root_of(args.rest, pose, strand, params.row_stride);
        const Vec3 way_of_root = root - lane.vector(args.lane_x, 0);
        for (uint32_t i = 0; i < params.vertex_stride; ++i) {
            const auto spring = [&](int c) -> double& {
                return args.lane_spring[lane.index(i, size_t(c), 4)];
            };
            Vec3 target = Vec3::Zero();
            double stiffness = 0, own = 0;
            if (params.pins && i > 0 && i < count) {
                target = {spring(0), spring(1), spring(2)};
                stiffness = spring(3);
            }
            if (i > 0 && i < count) {
                const auto groom = [&](size_t component) {
                    return args.lane_groom[lane.index(i, component, PLAIT_LANE_GROOM_COMPONENTS)];
                };
                const double mass = args.lane_material[lane.index(i, PLAIT_LANE_MASS,
                                                                  PLAIT_LANE_MATERIAL_COMPONENTS)];
                const Vec3 place =
                    pose.apply(xyz(args.rest[strand * params.row_stride + i])) - root;
                const Vec3 beside = lane.vector(args.lane_x, i);
                const Vec3 ahead = beside + params.h * lane.vector(args.lane_v, i) - way_of_root;
                const double distance = std::min((place - beside).norm(), (place - ahead).norm());
                own = std::min({groom(PLAIT_LANE_GROOM_OWN) +
                                    double(params.slider) * groom(PLAIT_LANE_GROOM_DROOP),
                                double(params.rate) * mass, params.pull * mass / distance});
                const double both = stiffness + own;
                target = stiffness > 0 ? Vec3((stiffness * target + own * place) / both) : place;
            }
            for (int c = 0; c < 3; ++c)
                spring(c) = target[c];
            spring(3) = stiffness + own;
        }
    }
}

} // namespace plait::reference
