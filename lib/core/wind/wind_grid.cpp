#include "core/wind/wind_grid.hpp"

#include "core/base/pose.hpp"

#include <algorithm>
#include <cmath>

namespace plait {
namespace {

constexpr size_t count = size_t{WindGrid::nodes} * WindGrid::nodes * WindGrid::nodes;

// Along the grid's axes.
std::array<float, 3> components(const plait_pose& grid, const std::array<float, 3>& v) {
    const plait_pose inverse{{-grid.q[0], -grid.q[1], -grid.q[2], grid.q[3]}, {0, 0, 0}};
    std::array<float, 3> turned{};
    transform(inverse, v.data(), turned.data());
    return turned;
}

} // namespace

uint32_t WindGrid::group_width(const plait_device_info& device) {
    const uint32_t lanes = std::max(device.lanes, 1u);
    return std::min(device.max_group_size, (nodes * nodes + lanes - 1) / lanes);
}

Result<WindGrid> WindGrid::create(Device& device, bool eddies, bool sheltered) {
    WindGrid grid;
    grid.eddies_ = eddies;
    grid.sheltered_ = sheltered;
    if (eddies || sheltered)
        PLAIT_TRY(device.create(grid.velocity_, PLAIT_ELEMENT_FLOAT4, count, "wind_velocity"));
    if (!sheltered)
        return grid;
    const auto info = device.describe();
    if (!info)
        return info.error();
    grid.width_ = group_width(*info);
    PLAIT_TRY(device.create(grid.extinction_, PLAIT_ELEMENT_FLOAT, count, "wind_extinction"));
    PLAIT_TRY(device.create(grid.depth_, PLAIT_ELEMENT_FLOAT, count, "wind_depth"));
    auto hair = StrandGrid::create_density(device, nodes);
    if (!hair)
        return hair.error();
    grid.hair_ = std::move(*hair);
    auto meshes = MeshSolid::create(device, nodes);
    if (!meshes)
        return meshes.error();
    grid.meshes_ = std::move(*meshes);
    return grid;
}

void WindGrid::place(const GridCube& cube, const plait_pose& head) {
    std::copy_n(head.q, 4, corner_.q);
    transform(head, cube.origin, corner_.t);
    voxel_edge_ = cube.edge / float{nodes};
}

plait_grid_params WindGrid::hair_params(const StepInput& at) const {
    plait_grid_params params{};
    params.vertex_stride = at.layout.row;
    params.edge_count = nodes;
    params.capacity = 1; // of slots, of which there are none
    params.voxel_edge = voxel_edge_;
    std::copy_n(corner_.q, 4, params.q);
    std::copy_n(corner_.t, 3, params.t);
    params.h = at.h;
    params.tent = PLAIT_TENT_TRILINEAR;
    return params;
}

void WindGrid::append_obstacle(Schedule& schedule, const StepInput& at, float extinction) const {
    plait_wind_obstacle_params params{};
    params.edge_count = nodes;
    params.voxel_edge = voxel_edge_;
    std::copy_n(corner_.q, 4, params.q);
    std::copy_n(corner_.t, 3, params.t);
    params.extinction = extinction / (voxel_edge_ * voxel_edge_ * voxel_edge_);
    params.collider_count = at.bodies.solids.count;
    params.collider_first = at.bodies.solids.first;
    NodeGridPlace place{nodes, voxel_edge_, {}, {}};
    std::ranges::copy(params.q, place.q);
    std::ranges::copy(params.t, place.t);
    const Buffer* meshes = meshes_.append(schedule, place, at.bodies, at.h);
    params.meshes = meshes ? 1 : 0;
    schedule.add(PLAIT_STAGE_wind_obstacle, count, params,
                 {&hair_.density(), &at.bodies.solids.buffer, meshes, &extinction_});
}

// Plane by plane as the wind goes against the hair, across the axis along which it goes most.
void WindGrid::append_shelter(Schedule& schedule, const HairNow& hair, const Stream& stream) const {
    hair_.append_density(schedule, hair_params(hair.at), hair.lanes, hair.at);
    append_obstacle(schedule, hair.at, stream.extinction);
    std::array<float, 3> against{};
    for (size_t i = 0; i < 3; ++i)
        against[i] = stream.velocity[i] - stream.still[i];
    const auto way = components(corner_, against);
    const auto most = std::ranges::max_element(way, {}, [](float a) { return std::abs(a); });
    const auto axis = static_cast<size_t>(most - way.begin());
    plait_wind_shelter_params params{};
    params.edge_count = nodes;
    params.voxel_edge = voxel_edge_;
    std::copy_n(corner_.q, 4, params.q);
    params.axis = static_cast<plait_u32>(axis);
    params.reversed = *most < 0;
    if (*most != 0) {
        params.foot[0] = way[axis == 0 ? 1 : 0] / std::abs(*most);
        params.foot[1] = way[axis == 2 ? 1 : 2] / std::abs(*most);
    }
    params.way = voxel_edge_ * std::hypot(1.0f, params.foot[0], params.foot[1]);
    params.turbulent = eddies_;
    std::ranges::copy(stream.velocity, params.air);
    std::ranges::copy(stream.still, params.still);
    schedule.add(PLAIT_STAGE_wind_shelter, 1, params,
                 {&extinction_, &hair_.density(), &hair_.velocity(), &depth_, &velocity_}, width_);
}

} // namespace plait
