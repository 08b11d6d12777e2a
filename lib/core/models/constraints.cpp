#include "core/models/constraints.hpp"

namespace plait {

bool has_global_shape(const plait_sim_params& p) {
    return p.global_stiffness > 0 && p.global_range > 0;
}

bool has_local_shape(const plait_sim_params& p) {
    return p.local_iterations > 0 && p.local_stiffness > 0;
}

bool has_attachment(const plait_sim_params& p) {
    return p.attachment > 0;
}

void add_global_shape(Schedule& schedule, const Substep& at) {
    const plait_sim_params& p = at.params;
    const State& s = at.state;
    if (has_global_shape(p))
        schedule.add(PLAIT_STAGE_global_shape, at.layout.guide_vertices(),
                     plait_global_shape_params{at.layout.row, p.global_stiffness, p.global_range},
                     {&s.rest, &s.vertex_count, &s.pose, &s.position});
}

void add_local_shape(Schedule& schedule, const Substep& at) {
    const plait_sim_params& p = at.params;
    const State& s = at.state;
    if (has_local_shape(p))
        schedule.add(PLAIT_STAGE_local_shape, at.layout.guides,
                     plait_local_shape_params{at.layout.row, p.local_stiffness, p.local_iterations},
                     {&s.rest, &s.vertex_count, &s.pose, &s.position});
}

void add_attachment(Schedule& schedule, const Substep& at) {
    const State& s = at.state;
    if (has_attachment(at.params))
        schedule.add(PLAIT_STAGE_attach, at.layout.guides,
                     plait_attach_params{at.layout.row, at.params.attachment},
                     {&s.rest_length, &s.vertex_count, &s.position});
}

} // namespace plait
