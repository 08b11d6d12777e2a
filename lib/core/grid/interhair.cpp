#include "core/grid/interhair.hpp"

#include "core/base/choices.hpp"
#include "core/base/pose.hpp"
#include "core/groom/groom.hpp"

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

} // namespace

uint32_t InterHair::group_width(const plait_device_info& device, uint32_t capacity) {
    return device.lanes > 1 ? 1 : std::bit_floor(std::min({device.max_group_size, capacity, 64u}));
}

// Half as large again as the hair, so that it can swing.
GridCube cube_around(const Groom& groom) {
    const auto& low = groom.shape.bounds_min;
    const auto& high = groom.shape.bounds_max;
    GridCube cube{};
    for (size_t i = 0; i < 3; ++i)
        cube.edge = std::max(cube.edge, 1.5f * (high[i] - low[i]));
    for (size_t i = 0; i < 3; ++i)
        cube.origin[i] = 0.5f * (low[i] + high[i]) - 0.5f * cube.edge;
    return cube;
}

Result<InterHair> InterHair::make_buffers(Device& device, const plait_sim_params& params) {
    InterHair grid;
    grid.mode_ = params.interhair;
    grid.edge_count_ = params.grid_edge_count;
    grid.capacity_ = params.slot_capacity;
    if (params.interhair == PLAIT_INTERHAIR_OFF)
        return grid;
    const uint32_t n = voxels(params.grid_edge_count);
    constexpr auto u32 = PLAIT_ELEMENT_UINT;
    if (params.interhair == PLAIT_INTERHAIR_SLOTS)
        PLAIT_TRY(device.create(grid.slots_, u32, size_t{n} * params.slot_capacity, "grid_slot"));
    else
        PLAIT_TRY(device.create(grid.sums_, u32, size_t{n} * PLAIT_SUM_STRIDE, "grid_sum"));
    PLAIT_TRY(device.create(grid.density_, PLAIT_ELEMENT_FLOAT, n, "grid_density"));
    PLAIT_TRY(device.create(grid.velocity_, PLAIT_ELEMENT_FLOAT4, n, "grid_velocity"));
    PLAIT_TRY(device.create(grid.outside_, u32, 1, "grid_outside"));
    return grid;
}

Result<InterHair> InterHair::create(Device& device, const plait_sim_params& params) {
    auto grid = make_buffers(device, params);
    if (!grid || !grid->is_on())
        return grid;
    Schedule zero;
    clear(zero, grid->outside_, 0); // nothing has been outside before the first step
    PLAIT_TRY(zero.submit(device));
    auto volume = Volume::create(device, params);
    if (!volume)
        return volume.error();
    grid->volume_ = std::move(*volume);
    return grid;
}

Result<InterHair> InterHair::create_density(Device& device, const plait_sim_params& params) {
    return make_buffers(device, params);
}

bool InterHair::fits(const plait_sim_params& params) const {
    if (params.interhair != mode_ || mode_ == PLAIT_INTERHAIR_OFF)
        return params.interhair == mode_;
    return params.grid_edge_count == edge_count_ &&
           (params.volume != PLAIT_VOLUME_OFF) == bool(volume_) &&
           (mode_ != PLAIT_INTERHAIR_SLOTS || params.slot_capacity == capacity_);
}

plait_grid_params grid_params(const InterHair::Step& step) {
    const plait_sim_params& p = step.params;
    const bool own = p.grid_edge > 0;
    const float edge = own ? p.grid_edge : step.cube.edge;
    const plait_pose& frame = p.grid_in_world ? identity_pose : step.head;
    plait_grid_params g{};
    g.vertex_stride = step.layout.row;
    g.edge_count = p.grid_edge_count;
    g.capacity = p.slot_capacity;
    g.voxel_edge = edge / static_cast<float>(p.grid_edge_count);
    std::copy_n(frame.q, 4, g.q);
    transform(frame, own ? p.grid_origin : step.cube.origin, g.t);
    g.h = step.h;
    g.slot_hash = of_kernels(p.slot_hash);
    g.frame = static_cast<plait_u32>(step.frame);
    g.seed = static_cast<plait_u32>(step.seed ^ (step.seed >> 32));
    g.tent = p.interhair == PLAIT_INTERHAIR_SLOTS ? PLAIT_TENT_VOXEL : of_kernels(p.tent);
    g.diffuse_rule = of_kernels(p.diffuse_rule);
    g.diffuse_ratio = p.diffuse_ratio;
    g.diffuse_factor = p.diffuse_factor;
    g.diffuse_floor = p.diffuse_floor;
    return g;
}

void InterHair::append_slots(Schedule& schedule, const Step& step,
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

void InterHair::append_exact(Schedule& schedule, const Step& step,
                             const plait_grid_params& params) const {
    const State& s = step.state;
    clear(schedule, sums_, 0);
    schedule.add(PLAIT_STAGE_grid_splat, step.layout.guides, params,
                 {&s.vertex_count, &s.position, &s.position_prev, &sums_, &outside_});
    schedule.add(PLAIT_STAGE_grid_resolve, voxels(edge_count_), params,
                 {&sums_, &density_, &velocity_});
}

void InterHair::append(Schedule& schedule, const Step& step) const {
    if (mode_ == PLAIT_INTERHAIR_OFF)
        return;
    const State& s = step.state;
    const plait_grid_params params = grid_params(step);
    clear(schedule, outside_, 0);
    if (mode_ == PLAIT_INTERHAIR_SLOTS)
        append_slots(schedule, step, params);
    else
        append_exact(schedule, step, params);
    schedule.add(PLAIT_STAGE_grid_diffuse, step.layout.guide_vertices(), params,
                 {&s.vertex_count, &s.position, &density_, &velocity_, &s.position_prev});
}

void InterHair::append_over_lanes(Schedule& schedule, const Step& step, const Model& model,
                                  const Substep& at) const {
    append_density(schedule, step, &model, at);
    model.diffuse(schedule, at, {grid_params(step), sums_, outside_, density_, velocity_});
}

void InterHair::append_density(Schedule& schedule, const Step& step, const Model* lanes,
                               const Substep& at) const {
    const plait_grid_params params = grid_params(step);
    clear(schedule, outside_, 0);
    if (!lanes)
        return append_exact(schedule, step, params);
    clear(schedule, sums_, 0);
    lanes->splat(schedule, at, {params, sums_, outside_, density_, velocity_});
    schedule.add(PLAIT_STAGE_grid_resolve, voxels(edge_count_), params,
                 {&sums_, &density_, &velocity_});
}

namespace {
const Buffer* wetness_of(const InterHair::Step& step) {
    return step.state.wetness ? &step.state.wetness : nullptr;
}
} // namespace

void InterHair::append_volume_start(Schedule& schedule, const Step& step, const Model& model,
                                    const Substep& at) const {
    const auto h = static_cast<float>(at.step);
    volume_.append_start(
        schedule, {grid_params(step), h, sums_, outside_, density_, velocity_, wetness_of(step)},
        model, at);
}

void InterHair::append_volume(Schedule& schedule, const Step& step, const Model& model,
                              const Substep& at) const {
    const auto h = static_cast<float>(at.step);
    volume_.append_step(
        schedule, {grid_params(step), h, sums_, outside_, density_, velocity_, wetness_of(step)},
        model, at);
}

uint64_t InterHair::device_bytes() const {
    return slots_.bytes() + sums_.bytes() + density_.bytes() + velocity_.bytes() +
           outside_.bytes() + volume_.device_bytes();
}

} // namespace plait
