#include "core/push/lane_push.hpp"

namespace plait {

void append_accelerations(Schedule& schedule, const Part& part) {
    schedule.add(PLAIT_STAGE_lane_accelerate, part.lanes.strands,
                 plait_lane_tile_params{part.lanes.row, part.lanes.tile, part.row_stride,
                                        part.pressure ? 1u : 0u},
                 {&part.strand, &part.vertex_count, &part.acceleration, &part.pressure, &part.push},
                 part.lanes.row);
}

} // namespace plait
