#include "stages.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string>

namespace lab::grid {

namespace {

using Float4 = std::array<float, 4>;

Float4 float4(const Vec3& v) {
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()), 1};
}

Vec3 vec3(const Float4& v) {
    return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

// The backend of that name, and the number of the device in its own list.
std::pair<const plait_backend_api*, uint32_t> find(const plait_device_info& which) {
    for (size_t b = 0; b < plait_backend_count(); ++b) {
        const plait_backend_api* backend = plait_backend_get(b);
        if (std::string(backend->name) != which.backend)
            continue;
        size_t count = 0;
        backend->enumerate(nullptr, &count);
        std::vector<plait_device_info> all(count, plait_device_info_defaults());
        if (count > 0)
            backend->enumerate(all.data(), &count);
        for (uint32_t i = 0; i < count; ++i)
            if (std::string(all[i].name) == which.name)
                return {backend, i};
    }
    throw Failure(std::string(which.name) + " is not among the devices of " + which.backend);
}

} // namespace

Device::Device(const plait_device_info& which) {
    const auto [backend, index] = find(which);
    api_ = backend->device;
    plait_open_info info{};
    info.struct_size = sizeof info;
    info.device_index = index;
    char error[4096] = "";
    if (backend->open(&info, &device_, error, sizeof error) != PLAIT_OK)
        throw Failure(error);
}

Device::~Device() {
    api_->destroy(device_);
}

void Device::check(plait_result result) const {
    if (result != PLAIT_OK)
        throw Failure(api_->last_error(device_));
}

plait_buffer* Device::make(plait_element element, size_t count, const char* name) {
    const plait_buffer_desc desc{element, count, name};
    plait_buffer* buffer = nullptr;
    check(api_->buffer_create(device_, &desc, &buffer));
    return buffer;
}

void Device::write(plait_buffer* buffer, size_t count, const void* data) {
    check(api_->buffer_write(device_, buffer, 0, count, data));
}

void Device::read(plait_buffer* buffer, size_t count, void* data) {
    check(api_->buffer_read(device_, buffer, 0, count, data));
}

void Device::submit(const std::vector<plait_dispatch>& list) {
    check(api_->submit(device_, list.data(), list.size()));
}

void Device::wait() {
    check(api_->wait(device_));
}

plait_grid_params params_of(uint32_t edge_count, double edge, uint32_t capacity) {
    const plait_grid_desc sim = plait_grid_desc_defaults();
    plait_grid_params params{};
    params.edge_count = edge_count;
    params.capacity = capacity;
    params.voxel_edge = static_cast<float>(edge);
    params.q[3] = 1;
    params.h = 1;
    params.slot_hash = static_cast<plait_u32>(sim.slot_hash);
    params.seed = 1;
    params.tent = PLAIT_TENT_VOXEL;
    params.diffuse_rule = static_cast<plait_u32>(sim.diffuse_rule);
    params.diffuse_ratio = sim.diffuse_ratio;
    params.diffuse_factor = sim.diffuse_factor;
    params.diffuse_floor = sim.diffuse_floor;
    return params;
}

Stages::Stages(Device& device, const plait_grid_params& grid, size_t vertices, uint32_t per_strand)
    : params(grid), device_(device), vertices_(vertices) {
    params.vertex_stride = per_strand;
    struct Spec {
        plait_element element;
        size_t count;
        const char* name;
    };
    const Spec specs[names] = {
        {PLAIT_ELEMENT_UINT, vertices / per_strand, "vertex_count"},
        {PLAIT_ELEMENT_FLOAT4, vertices, "position"},
        {PLAIT_ELEMENT_FLOAT4, vertices, "position_prev"},
        {PLAIT_ELEMENT_UINT, voxels() * params.capacity, "grid_slot"},
        {PLAIT_ELEMENT_UINT, 1, "grid_outside"},
        {PLAIT_ELEMENT_FLOAT, voxels(), "grid_density"},
        {PLAIT_ELEMENT_FLOAT4, voxels(), "grid_velocity"},
        {PLAIT_ELEMENT_UINT, voxels() * PLAIT_SUM_STRIDE, "grid_sum"},
    };
    for (size_t i = 0; i < names; ++i) {
        sizes_[i] = specs[i].count;
        buffers_[i] = device_.make(specs[i].element, specs[i].count, specs[i].name);
    }
    const std::vector<uint32_t> counts(sizes_[count], per_strand);
    device_.write(buffers_[count], counts.size(), counts.data());
}

Stages::~Stages() {
    for (plait_buffer* buffer : buffers_)
        if (buffer)
            device_.free(buffer);
}

size_t Stages::voxels() const {
    return size_t{params.edge_count} * params.edge_count * params.edge_count;
}

void Stages::place(const std::vector<Vertex>& vertices) {
    std::vector<Float4> x, before;
    for (const Vertex& vertex : vertices) {
        x.push_back(float4(vertex.x));
        before.push_back(float4(vec3(x.back()) - static_cast<double>(params.h) * vertex.v));
    }
    device_.write(buffers_[position], x.size(), x.data());
    device_.write(buffers_[prev], before.size(), before.data());
}

plait_dispatch Stages::dispatch(plait_stage stage, size_t items, uint32_t width,
                                const std::vector<Name>& buffers) {
    auto& handles = handles_.emplace_back();
    for (const Name name : buffers)
        handles.push_back(buffers_[name]);
    return {stage,         static_cast<uint32_t>(items),          width,          &params,
            sizeof params, static_cast<uint32_t>(handles.size()), handles.data(), 0};
}

void Stages::clear(Name name, uint32_t value) {
    const plait_grid_clear_params params_of_clear{value};
    plait_dispatch fill = dispatch(PLAIT_STAGE_grid_clear, sizes_[name], 1, {name});
    fill.params = &params_of_clear;
    fill.params_size = sizeof params_of_clear;
    device_.submit({fill});
}

void Stages::slots() {
    handles_.clear();
    const uint32_t width = std::bit_floor(std::min(params.capacity, 64u));
    clear(slot, PLAIT_SLOT_EMPTY);
    clear(outside, 0);
    device_.submit(
        {dispatch(PLAIT_STAGE_grid_slots, vertices_, 1, {count, position, slot, outside}),
         dispatch(PLAIT_STAGE_grid_density, voxels(), width, {slot, position, node_density}),
         dispatch(PLAIT_STAGE_grid_velocity, voxels(), width,
                  {slot, position, prev, node_density, node_velocity})});
}

void Stages::exact() {
    handles_.clear();
    clear(sum, 0);
    clear(outside, 0);
    device_.submit(
        {dispatch(PLAIT_STAGE_grid_splat, sizes_[count], 1, {count, position, prev, sum, outside}),
         dispatch(PLAIT_STAGE_grid_resolve, voxels(), 1, {sum, node_density, node_velocity})});
}

void Stages::diffuse() {
    handles_.clear();
    device_.submit({dispatch(PLAIT_STAGE_grid_diffuse, vertices_, 1,
                             {count, position, node_density, node_velocity, prev})});
}

template <typename T> std::vector<T> Stages::read(Name name) const {
    std::vector<T> values(sizes_[name]);
    device_.read(buffers_[name], values.size(), values.data());
    return values;
}

size_t Stages::occupied() const {
    const auto slots = read<uint32_t>(slot);
    return slots.size() - static_cast<size_t>(std::ranges::count(slots, PLAIT_SLOT_EMPTY));
}

std::vector<uint32_t> Stages::sums() const {
    return read<uint32_t>(sum);
}

std::vector<double> Stages::density() const {
    const auto values = read<float>(node_density);
    return {values.begin(), values.end()};
}

std::vector<Vec3> Stages::velocity() const {
    std::vector<Vec3> all;
    for (const Float4& v : read<Float4>(node_velocity))
        all.push_back(vec3(v));
    return all;
}

std::vector<Vec3> Stages::velocities() const {
    const auto x = read<Float4>(position), before = read<Float4>(prev);
    std::vector<Vec3> all;
    for (size_t i = 0; i < x.size(); ++i)
        all.push_back((vec3(x[i]) - vec3(before[i])) / static_cast<double>(params.h));
    return all;
}

Vec3 Stages::seen(const std::vector<Vec3>& velocity, const Vec3& x) const {
    const auto n = static_cast<int>(params.edge_count);
    const Vec3 at = x / static_cast<double>(params.voxel_edge); // in voxels
    const auto node = [n](std::ptrdiff_t i, std::ptrdiff_t j, std::ptrdiff_t k) {
        return static_cast<size_t>((j * n + k) * n + i);
    };
    if (params.tent == PLAIT_TENT_VOXEL)
        return velocity[node(static_cast<int>(at.x()), static_cast<int>(at.y()),
                             static_cast<int>(at.z()))];
    int low[3];
    double share[3]; // of the upper node
    for (int c = 0; c < 3; ++c) {
        const double between = std::clamp(at[c] - 0.5, 0.0, n - 1.0); // of voxel centres
        low[c] = std::min(static_cast<int>(between), std::max(n - 2, 0));
        share[c] = between - low[c];
    }
    Vec3 mean = Vec3::Zero();
    for (int corner = 0; corner < 8; ++corner) {
        double weight = 1;
        int at_node[3];
        for (int c = 0; c < 3; ++c) {
            const int upper = corner >> c & 1;
            weight *= upper ? share[c] : 1 - share[c];
            at_node[c] = std::min(low[c] + upper, n - 1);
        }
        mean += weight * velocity[node(at_node[0], at_node[1], at_node[2])];
    }
    return mean;
}

} // namespace lab::grid
