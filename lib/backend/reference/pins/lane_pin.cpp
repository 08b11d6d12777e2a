// lane_pin: pins of a strand at the end of a substep, relative to its root. Their stiffness is no
// more than max(hold M/l, rate m) and pull M/d: M the strand's mass, l the segment before the
// vertex, m its mass, d how far it is off, where it is beside its root or where it would go,
// whichever is nearer.
#include "backend/reference/base/lanes.hpp"
#include "backend/reference/pins/pin.hpp"

#include <algorithm>
#include <cmath>

namespace plait::reference {

void lane_pin(uint32_t item_count, const plait_lane_pin_params& params, const lane_pin_args& args) {
    for (size_t slot = 0; slot < item_count; ++slot) {
        const size_t strand = strand_of(args.lane_strand, slot);
        const Lane lane(slot, params.vertex_stride, params.tile);
        const uint32_t count = vertices_of(args.vertex_count, strand, params.vertex_stride);
        const Pose pose = pose_of(args.pose, strand);
        const Vec3 root = root_of(args.rest, pose, strand, params.row_stride);
        const auto material = [&](size_t row, size_t component) {
            return args.lane_material[lane.index(row, component, PLAIT_LANE_MATERIAL_COMPONENTS)];
        };
        const Vec3 shift = lane.vector(args.lane_x, 0) - root;
        double mass = 0;
        for (uint32_t i = 1; i < count; ++i)
            mass += material(i, PLAIT_LANE_MASS);
        for (uint32_t i = 0; i < params.vertex_stride; ++i) {
            const size_t vertex = strand * params.row_stride + i;
            Vec4 pin = Vec4::Zero();
            if (i > 0 && i < count)
                pin = on_its_way(args.pin_from[vertex], args.pin_to[vertex], params.share);
            if (pin.w() != 0) {
                const double most =
                    std::max(params.hold * mass / material(i - 1, PLAIT_LANE_LENGTH),
                             params.rate * material(i, PLAIT_LANE_MASS));
                const Vec3 target = pin.w() < 0 ? pose.apply(xyz(pin)) : xyz(pin);
                const Vec3 beside = lane.vector(args.lane_x, i);
                const Vec3 ahead = beside + params.h * lane.vector(args.lane_v, i) + shift;
                const double distance =
                    std::min((target - root - beside).norm(), (target - root - ahead).norm());
                pin.head<3>() = target - root;
                pin.w() = std::min({std::abs(pin.w()), most, params.pull * mass / distance});
            } else {
                pin.setZero();
            }
            for (int c = 0; c < 4; ++c)
                args.lane_pin[lane.index(i, c, 4)] = pin[c];
        }
    }
}

} // namespace plait::reference
