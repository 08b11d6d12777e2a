#include "core/grid/strand_grid.hpp"

#include "core/base/choices.hpp"
#include "core/base/pose.hpp"

#include <algorithm>
#include <bit>

namespace plait {
namespace {

uint32_t voxels(uint32_t edge_count) {
    return edge_count * edge_count * edge_count;
}

void clear(Schedule& schedule, const Buffer& buffer, plait_u32 value) {
    schedule.add(PLAIT_STAGE_grid_clear, static_cast<uint32_t>(buffer.count()),
                 plait_grid_clear_params{value}, {&buffer});
}

plait_lane_grid_params lane_params(const Part& part, const plait_grid_params& grid) {
    plait_lane_grid_params params{};
    params.vertex_stride = part.lanes.row;
    params.tile = part.lanes.tile;
    params.edge_count = grid.edge_count;
    params.voxel_edge = grid.voxel_edge;
    std::ranges::copy(grid.q, params.q);
    std::ranges::copy(grid.t, params.t);
    params.tent = grid.tent;
    params.diffuse_rule = grid.diffuse_rule;
    params.diffuse_ratio = grid.diffuse_ratio;
    params.diffuse_factor = grid.diffuse_factor;
    params.diffuse_floor = grid.diffuse_floor;
    params.history = part.v_before ? 1 : 0;
    return params;
}

} // namespace

uint32_t StrandGrid::group_width(const plait_device_info& device, uint32_t capacity) {
    return device.lanes > 1 ? 1 : std::bit_floor(std::min({device.max_group_size, capacity, 64u}));
}

Result<StrandGrid> StrandGrid::make_buffers(Device& device, GridKind mode, uint32_t edge_count,
                                            uint32_t capacity) {
    StrandGrid grid;
    grid.mode_ = mode;
    grid.edge_count_ = edge_count;
    grid.capacity_ = capacity;
    if (mode == GridKind::off)
        return grid;
    const uint32_t n = voxels(edge_count);
    constexpr auto u32 = PLAIT_ELEMENT_UINT;
    if (mode == GridKind::slots)
        PLAIT_TRY(device.create(grid.slots_, u32, size_t{n} * capacity, "grid_slot"));
    else
        PLAIT_TRY(device.create(grid.sums_, u32, size_t{n} * PLAIT_SUM_STRIDE, "grid_sum"));
    PLAIT_TRY(device.create(grid.density_, PLAIT_ELEMENT_FLOAT, n, "grid_density"));
    PLAIT_TRY(device.create(grid.velocity_, PLAIT_ELEMENT_FLOAT4, n, "grid_velocity"));
    PLAIT_TRY(device.create(grid.outside_, u32, 1, "grid_outside"));
    return grid;
}

Result<StrandGrid> StrandGrid::create(Device& device, const Params& params) {
    auto grid =
        make_buffers(device, params.grid_kind(), params.grid.edge_count, params.grid.slot_capacity);
    if (!grid || !grid->is_on())
        return grid;
    Schedule zero;
    clear(zero, grid->outside_, 0); // nothing has been outside before the first step
    PLAIT_TRY(zero.submit(device));
    return grid;
}

Result<StrandGrid> StrandGrid::create_density(Device& device, uint32_t edge_count) {
    return make_buffers(device, GridKind::exact, edge_count, 0);
}

bool StrandGrid::fits(const Params& params) const {
    if (params.grid_kind() != mode_ || mode_ == GridKind::off)
        return params.grid_kind() == mode_;
    return params.grid.edge_count == edge_count_ &&
           (mode_ != GridKind::slots || params.grid.slot_capacity == capacity_);
}

plait_grid_params grid_params(const StrandGrid::Step& step) {
    const Params& p = step.params;
    const bool own = p.grid.edge > 0;
    const float edge = own ? p.grid.edge : step.cube.edge;
    const plait_pose& frame = p.grid.in_world ? identity_pose : step.head;
    plait_grid_params g{};
    g.vertex_stride = step.layout.row;
    g.edge_count = p.grid.edge_count;
    g.capacity = p.grid.slot_capacity;
    g.voxel_edge = edge / static_cast<float>(p.grid.edge_count);
    std::copy_n(frame.q, 4, g.q);
    transform(frame, own ? p.grid.origin : step.cube.origin, g.t);
    g.h = step.h;
    g.slot_hash = of_kernels(p.grid.slot_hash);
    g.frame = static_cast<plait_u32>(step.frame);
    g.seed = static_cast<plait_u32>(step.seed ^ (step.seed >> 32));
    g.tent = p.grid_kind() == GridKind::slots ? PLAIT_TENT_VOXEL : of_kernels(p.grid.tent);
    g.diffuse_rule = of_kernels(p.grid.diffuse_rule);
    g.diffuse_ratio = p.grid.diffuse_ratio;
    g.diffuse_factor = p.grid.diffuse_factor;
    g.diffuse_floor = p.grid.diffuse_floor;
    return g;
}

void StrandGrid::append_slots(Schedule& schedule, const Step& step,
                              const plait_grid_params& params) const {
    const State& s = step.state;
    const uint32_t n = voxels(edge_count_);
    const uint32_t width = group_width(step.device, capacity_);
    clear(schedule, slots_, PLAIT_SLOT_EMPTY);
    schedule.add(PLAIT_STAGE_grid_slots, step.layout.guide_vertices(), params,
                 {&s.vertex_count, &s.position, &slots_, &outside_});
    schedule.add(PLAIT_STAGE_grid_density, n, params, {&slots_, &s.position, &density_}, width);
    schedule.add(PLAIT_STAGE_grid_velocity, n, params,
                 {&slots_, &s.position, &s.position_prev, &density_, &velocity_}, width);
}

void StrandGrid::splat_positions(Schedule& schedule, const Layout& layout, const State& s,
                                 const plait_grid_params& params) const {
    clear(schedule, sums_, 0);
    schedule.add(PLAIT_STAGE_grid_splat, layout.guides, params,
                 {&s.vertex_count, &s.position, &s.position_prev, &sums_, &outside_});
}

void StrandGrid::resolve(Schedule& schedule, const plait_grid_params& params) const {
    schedule.add(PLAIT_STAGE_grid_resolve, voxels(edge_count_), params,
                 {&sums_, &density_, &velocity_});
}

void StrandGrid::brake(Schedule& schedule, const Step& step,
                       const plait_grid_params& params) const {
    const State& s = step.state;
    schedule.add(PLAIT_STAGE_grid_diffuse, step.layout.guide_vertices(), params,
                 {&s.vertex_count, &s.position, &density_, &velocity_, &s.position_prev});
}

void StrandGrid::append(Schedule& schedule, const Step& step) const {
    if (mode_ == GridKind::off)
        return;
    if (mode_ == GridKind::exact) {
        append_sums(schedule, step);
        append_brake(schedule, step);
        return;
    }
    const plait_grid_params params = grid_params(step);
    clear(schedule, outside_, 0);
    append_slots(schedule, step, params);
    brake(schedule, step, params);
}

void StrandGrid::append_sums(Schedule& schedule, const Step& step) const {
    clear(schedule, outside_, 0);
    splat_positions(schedule, step.layout, step.state, grid_params(step));
}

void StrandGrid::append_brake(Schedule& schedule, const Step& step) const {
    const plait_grid_params params = grid_params(step);
    resolve(schedule, params);
    brake(schedule, step, params);
}

void StrandGrid::splat(Schedule& schedule, const Model& lanes, const plait_grid_params& grid,
                       const StepInput& at, bool each) const {
    clear(schedule, sums_, 0);
    for (size_t i = 0; i < lanes.parts(); ++i) {
        const Part part = lanes.part(i, at);
        plait_lane_grid_params params = lane_params(part, grid);
        params.each = each;
        schedule.add(PLAIT_STAGE_lane_splat, part.lanes.strands, params,
                     {&part.strand, &part.vertex_count, &part.x, &part.v, &sums_, &outside_},
                     part.lanes.row);
    }
}

void StrandGrid::diffuse(Schedule& schedule, const Model& lanes, const plait_grid_params& grid,
                         const StepInput& at) const {
    for (size_t i = 0; i < lanes.parts(); ++i) {
        const Part part = lanes.part(i, at);
        schedule.add(PLAIT_STAGE_lane_diffuse, part.lanes.strands, lane_params(part, grid),
                     {&part.strand, &part.vertex_count, &part.x, &density_, &velocity_, &part.v,
                      &part.v_before},
                     part.lanes.row);
    }
}

void StrandGrid::append_over_lanes(Schedule& schedule, const Step& step, const Model& model,
                                   const StepInput& at) const {
    const plait_grid_params params = grid_params(step);
    append_density(schedule, params, &model, at);
    diffuse(schedule, model, params, at);
}

void StrandGrid::append_sums_over_lanes(Schedule& schedule, const Step& step, const Model& model,
                                        const StepInput& at) const {
    clear(schedule, outside_, 0);
    splat(schedule, model, grid_params(step), at, true);
}

void StrandGrid::append_brake_over_lanes(Schedule& schedule, const Step& step, const Model& model,
                                         const StepInput& at) const {
    const plait_grid_params params = grid_params(step);
    resolve(schedule, params);
    diffuse(schedule, model, params, at);
}

void StrandGrid::append_density(Schedule& schedule, const plait_grid_params& params,
                                const Model* lanes, const StepInput& at) const {
    clear(schedule, outside_, 0);
    if (lanes)
        splat(schedule, *lanes, params, at, false);
    else
        splat_positions(schedule, at.stepped, at.state, params);
    resolve(schedule, params);
}

uint64_t StrandGrid::device_bytes() const {
    return slots_.bytes() + sums_.bytes() + density_.bytes() + velocity_.bytes() + outside_.bytes();
}

} // namespace plait
