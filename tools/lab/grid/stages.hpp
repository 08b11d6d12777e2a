// The inter-hair step by itself: vertices in a grid and its stages over them, through
// plait_backend.h.
#pragma once

#include "common.hpp"

#include <plait/plait_backend.h>

#include <memory>
#include <vector>

namespace lab::grid {

class Device {
  public:
    explicit Device(const plait_device_info& which); // as a context describes it
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    plait_buffer* make(plait_element element, size_t count, const char* name);
    void free(plait_buffer* buffer) { api_->buffer_destroy(device_, buffer); }
    void write(plait_buffer* buffer, size_t count, const void* data);
    void read(plait_buffer* buffer, size_t count, void* data);
    void submit(const std::vector<plait_dispatch>& list);
    void wait();

  private:
    void check(plait_result result) const;

    const plait_device_api* api_ = nullptr;
    plait_device* device_ = nullptr;
};

struct Vertex {
    Vec3 x, v; // m, m/s
};

// nv^3 voxels of edge `edge` m from the origin, unturned; all else as the library has it.
plait_grid_params params_of(uint32_t edge_count, double edge, uint32_t capacity);

// Strands of `per_strand` vertices.
class Stages {
  public:
    Stages(Device& device, const plait_grid_params& grid, size_t vertices, uint32_t per_strand);
    ~Stages();
    Stages(const Stages&) = delete;
    Stages& operator=(const Stages&) = delete;

    void place(const std::vector<Vertex>& vertices);
    void slots(); // density and velocity from random slots
    void exact(); // from sums over all vertices
    void diffuse();
    void wait() { device_.wait(); }

    size_t occupied() const; // slots
    std::vector<uint32_t> sums() const;
    std::vector<double> density() const;
    std::vector<Vec3> velocity() const;   // by voxel: of the nodes
    std::vector<Vec3> velocities() const; // of the vertices
    // What a vertex at x sees, as grid_diffuse reads it.
    Vec3 seen(const std::vector<Vec3>& velocity, const Vec3& x) const;

    plait_grid_params params;

  private:
    enum Name { count, position, prev, slot, outside, node_density, node_velocity, sum, names };
    size_t voxels() const;
    plait_dispatch dispatch(plait_stage stage, size_t items, uint32_t width,
                            const std::vector<Name>& buffers);
    void clear(Name name, uint32_t value);
    template <typename T> std::vector<T> read(Name name) const;

    Device& device_;
    size_t vertices_;
    plait_buffer* buffers_[names] = {};
    size_t sizes_[names] = {};                        // elements
    std::vector<std::vector<plait_buffer*>> handles_; // of the dispatches
};

} // namespace lab::grid
