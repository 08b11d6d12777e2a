#include "core/volume/volume.hpp"

#include "core/base/pose.hpp"

#include <algorithm>
#include <cmath>

namespace plait {
namespace {

constexpr uint32_t first_sweeps = 200; // once, for layers of 16 voxels
// Hair parts by a pressure that is carried on, which adds up where hair cannot part as it is told, and
// swings it. So what is hardly too dense is told little.
constexpr float slack = 0.035f, onset = 0.15f;
constexpr double parting = 13.4; // 1/s, of what is far too dense: a fifth in a sixtieth of a second

uint32_t voxels(const plait_grid_params& grid) {
    return grid.edge_count * grid.edge_count * grid.edge_count;
}

plait_volume_nodes_params nodes_params(const plait_grid_params& grid, const StepInput& at) {
    plait_volume_nodes_params params{};
    params.edge_count = grid.edge_count;
    params.voxel_edge = grid.voxel_edge;
    std::ranges::copy(grid.q, params.q);
    std::ranges::copy(grid.t, params.t);
    params.collider_count = at.bodies.solids.count;
    params.collider_first = at.bodies.solids.first;
    params.h = at.h;
    return params;
}

NodeGridPlace place_of(const plait_grid_params& grid) {
    NodeGridPlace place{grid.edge_count, grid.voxel_edge, {}, {}};
    std::ranges::copy(grid.q, place.q);
    std::ranges::copy(grid.t, place.t);
    return place;
}

// What h of gravity does to a velocity, along the grid's axes.
std::array<float, 3> fall_of(const Params& p, const plait_grid_params& grid, float h) {
    plait_pose back = identity_pose;
    for (size_t i = 0; i < 4; ++i)
        back.q[i] = i < 3 ? -grid.q[i] : grid.q[i];
    std::array<float, 3> fall{};
    const float gained[3] = {h * p.gravity[0], h * p.gravity[1], h * p.gravity[2]};
    float turned[3];
    transform(back, gained, turned);
    std::ranges::copy(turned, fall.begin());
    return fall;
}

plait_volume_params faces_params(const Params& p, const VolumeGrid& grid) {
    plait_volume_params params{};
    params.edge_count = grid.params.edge_count;
    params.voxel_edge = grid.params.voxel_edge;
    params.h = grid.step;
    params.share = p.volume.share;
    params.slack = slack;
    params.onset = onset;
    params.recovery = static_cast<float>(1 - std::exp(-parting * double(grid.step)));
    params.most_recovery = grid.step * p.volume.rate;
    params.cohesion = p.volume.cohesion;
    params.wet_cohesion = p.wetness.cohesion;
    return params;
}

plait_lane_volume_params lane_params(const Part& part, const VolumeGrid& grid) {
    plait_lane_volume_params params{};
    params.vertex_stride = part.lanes.row;
    params.tile = part.lanes.tile;
    params.edge_count = grid.params.edge_count;
    params.voxel_edge = grid.params.voxel_edge;
    std::ranges::copy(grid.params.q, params.q);
    std::ranges::copy(grid.params.t, params.t);
    params.history = part.v_before ? 1 : 0;
    params.wet = grid.wetness ? 1 : 0;
    return params;
}

} // namespace

Result<Volume> Volume::create(Device& device, const Params& params) {
    Volume volume;
    if (!params.volume.on)
        return volume;
    volume.edge_count_ = params.grid.edge_count;
    const size_t n =
        size_t{params.grid.edge_count} * params.grid.edge_count * params.grid.edge_count;
    constexpr auto one = PLAIT_ELEMENT_FLOAT, four = PLAIT_ELEMENT_FLOAT4;
    PLAIT_TRY(device.create(volume.potential_, one, 2 * n, "volume_potential"));
    PLAIT_TRY(device.create(volume.next_, one, 2 * n, "volume_potential"));
    PLAIT_TRY(device.create(volume.pressure_, one, n, "volume_pressure"));
    PLAIT_TRY(device.create(volume.rest_, one, n, "volume_rest"));
    PLAIT_TRY(device.create(volume.solid_, four, n, "volume_solid"));
    PLAIT_TRY(device.create(volume.link_, four, n, "volume_link"));
    PLAIT_TRY(device.create(volume.node_, four, n, "volume_node"));
    PLAIT_TRY(device.create(volume.pull_, four, 2 * n, "volume_pull"));
    auto meshes = MeshSolid::create(device, params.grid.edge_count);
    if (!meshes)
        return meshes.error();
    volume.meshes_ = std::move(*meshes);
    return volume;
}

Status Volume::keep_wetness(Device& device, bool keep) {
    if (!keep)
        wetness_ = {};
    else if (*this && !wetness_)
        PLAIT_TRY(device.create(wetness_, PLAIT_ELEMENT_FLOAT, rest_.count(), "volume_wetness"));
    return {};
}

// Sums hold one number of hair beside its momentum: where hair coheres by its wetness it is summed
// first, and the rest after it, so that what stays is as of dry hair.
void Volume::splat(Schedule& schedule, const VolumeGrid& grid, const Model& model,
                   const StepInput& at) const {
    if (coheres_wet(grid, at))
        splat_into(schedule, grid, model, at, true, wetness_);
    splat_into(schedule, grid, model, at, false, rest_);
}

void Volume::splat_into(Schedule& schedule, const VolumeGrid& grid, const Model& model,
                        const StepInput& at, bool soaked, const Buffer& rest) const {
    for (const Buffer* words : {&grid.outside, &grid.sums})
        schedule.add(PLAIT_STAGE_grid_clear, static_cast<uint32_t>(words->count()),
                     plait_grid_clear_params{0}, {words});
    for (size_t i = 0; i < model.parts(); ++i) {
        const Part part = model.part(i, at);
        plait_lane_volume_params params = lane_params(part, grid);
        params.soaked = soaked ? 1 : 0;
        schedule.add(PLAIT_STAGE_volume_splat, part.lanes.strands, params,
                     {&part.strand, &part.vertex_count, grid.wetness, &part.room, &part.x, &part.v,
                      &grid.sums, &grid.outside},
                     part.lanes.row);
    }
    plait_volume_nodes_params nodes = nodes_params(grid.params, at);
    const Buffer* meshes = nullptr;
    if (soaked)
        nodes.collider_count = 0; // where colliders are is found with the rest
    else
        meshes = meshes_.append(schedule, place_of(grid.params), at.bodies, at.h);
    nodes.meshes = meshes ? 1 : 0;
    schedule.add(PLAIT_STAGE_volume_nodes, voxels(grid.params), nodes,
                 {&grid.sums, &at.bodies.solids.buffer, meshes, &grid.density, &grid.velocity,
                  &rest, &solid_});
}

void Volume::solve(Schedule& schedule, const VolumeGrid& grid, const StepInput& at,
                   const Buffer* before, const Buffer& potential, uint32_t sweeps) const {
    const uint32_t n = grid.params.edge_count, colour_nodes = n * n * ((n + 1) / 2);
    plait_volume_params params = faces_params(at.params, grid);
    params.carried = before ? 1 : 0;
    params.wet = coheres_wet(grid, at) ? 1 : 0;
    if (!before)
        std::ranges::copy(fall_of(at.params, grid.params, grid.step), params.fall);
    schedule.add(PLAIT_STAGE_volume_faces, voxels(grid.params), params,
                 {&grid.density, &grid.velocity, &rest_, params.wet ? &wetness_ : nullptr, &solid_,
                  before, &link_, &node_, &pressure_});
    for (uint32_t sweep = 0; sweep < sweeps; ++sweep)
        for (const uint32_t colour : {0u, 1u})
            schedule.add(PLAIT_STAGE_volume_pressure, colour_nodes,
                         plait_volume_sweep_params{n, colour}, {&link_, &node_, &pressure_});
    schedule.add(PLAIT_STAGE_volume_impulse, voxels(grid.params),
                 plait_volume_impulse_params{n, grid.params.voxel_edge, grid.step,
                                             at.params.volume.viscosity},
                 {&grid.density, &grid.velocity, &link_, &pressure_, &potential, &pull_});
}

void Volume::gather(Schedule& schedule, const VolumeGrid& grid, const Model& model,
                    const StepInput& at, bool moves) const {
    for (size_t i = 0; i < model.parts(); ++i) {
        const Part part = model.part(i, at);
        plait_lane_volume_params params = lane_params(part, grid);
        params.moves = moves ? 1 : 0;
        schedule.add(PLAIT_STAGE_volume_gather, part.lanes.strands, params,
                     {&part.strand, &part.vertex_count, &part.x, &pull_, &part.v, &part.v_before,
                      &part.pressure},
                     part.lanes.row);
    }
}

void Volume::append_start(Schedule& schedule, const VolumeGrid& grid, const Model& model,
                          const StepInput& at) const {
    splat(schedule, grid, model, at);
    solve(schedule, grid, at, nullptr, potential_, first_sweeps);
    gather(schedule, grid, model, at, false);
}

void Volume::append_step(Schedule& schedule, const VolumeGrid& grid, const Model& model,
                         const StepInput& at) const {
    splat(schedule, grid, model, at);
    solve(schedule, grid, at, &potential_, next_, at.params.volume.sweeps);
    gather(schedule, grid, model, at, true);
}

void Volume::carry() noexcept {
    potential_.swap(next_);
    carries = true;
}

uint64_t Volume::device_bytes() const {
    uint64_t bytes = meshes_.device_bytes();
    for (const Buffer* buffer :
         {&potential_, &next_, &wetness_, &pressure_, &rest_, &solid_, &link_, &node_, &pull_})
        bytes += buffer->bytes();
    return bytes;
}

} // namespace plait
