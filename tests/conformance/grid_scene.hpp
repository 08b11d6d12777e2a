// Vertices in a grid on one device, and the stages of the inter-hair step over them.
#pragma once

#include "stage_device.hpp"

namespace plait::test {

// nv^3 voxels of edge `edge` from the origin, unturned; everything else at the API's defaults.
inline plait_grid_params grid_params(uint32_t edge_count, uint32_t capacity, float edge) {
    plait_grid_params params{};
    params.vertex_stride = 3;
    params.edge_count = edge_count;
    params.capacity = capacity;
    params.voxel_edge = edge;
    params.q[3] = 1.0f;
    params.h = 1.0f / 64.0f; // a power of two: velocities of test data survive the division
    params.slot_hash = PLAIT_SLOT_HASH_PCG;
    params.seed = 20261121;
    params.tent = PLAIT_TENT_VOXEL;
    params.diffuse_rule = PLAIT_DIFFUSE_FLOORED;
    params.diffuse_ratio = 2.0f;
    params.diffuse_factor = 0.9f;
    params.diffuse_floor = 0.5f;
    return params;
}

struct Particle {
    std::array<float, 3> x, v;
};

// An even number of particles as strands of two vertices and one of padding: no stage may see that.
class GridScene {
  public:
    GridScene(StageDevice& device, const plait_grid_params& grid, size_t vertices)
        : params(grid), vertices_(vertices), elements_(vertices / 2 * 3),
          voxels_(size_t{grid.edge_count} * grid.edge_count * grid.edge_count), device_(device),
          count_(device.uints(vertices / 2)), position_(device.float4s(elements_)),
          prev_(device.float4s(elements_)), slot_(device.uints(voxels_ * grid.capacity)),
          outside_(device.uints(1)), density_(device.floats(voxels_)),
          velocity_(device.float4s(voxels_)), sum_(device.uints(voxels_ * PLAIT_SUM_STRIDE)) {
        EXPECT_EQ(vertices % 2, 0u);
        count_->write(std::vector<uint32_t>(vertices / 2, 2));
    }

    void place(const std::vector<Particle>& particles) {
        const Float4 padding{0.5f * params.voxel_edge, 0.0f, 0.0f, 1.0f};
        std::vector<Float4> x(elements_, padding), prev = x;
        for (size_t i = 0; i < particles.size(); ++i)
            for (size_t c = 0; c < 3; ++c) {
                x[element(i)][c] = particles[i].x[c];
                prev[element(i)][c] = particles[i].x[c] - params.h * particles[i].v[c];
            }
        position_->write(x);
        prev_->write(prev);
    }

    void slots() {
        clear(*slot_, PLAIT_SLOT_EMPTY, voxels_ * params.capacity);
        clear(*outside_, 0, 1);
        device_.run(PLAIT_STAGE_grid_slots, elements_, params,
                    {count_.get(), position_.get(), slot_.get(), outside_.get()});
    }
    // From the slots, by work-groups of `width`.
    void sample(uint32_t width) {
        device_.run(PLAIT_STAGE_grid_density, voxels_, params,
                    {slot_.get(), position_.get(), density_.get()}, width);
        device_.run(PLAIT_STAGE_grid_velocity, voxels_, params,
                    {slot_.get(), position_.get(), prev_.get(), density_.get(), velocity_.get()},
                    width);
    }
    void exact() {
        clear(*sum_, 0, voxels_ * PLAIT_SUM_STRIDE);
        clear(*outside_, 0, 1);
        device_.run(PLAIT_STAGE_grid_splat, elements_ / 3, params,
                    {count_.get(), position_.get(), prev_.get(), sum_.get(), outside_.get()});
        device_.run(PLAIT_STAGE_grid_resolve, voxels_, params,
                    {sum_.get(), density_.get(), velocity_.get()});
    }
    void diffuse() {
        device_.run(PLAIT_STAGE_grid_diffuse, elements_, params,
                    {count_.get(), position_.get(), density_.get(), velocity_.get(), prev_.get()});
    }

    std::vector<uint32_t> slot_values() const { return slot_->read<uint32_t>(); }
    std::vector<uint32_t> sums() const { return sum_->read<uint32_t>(); }
    std::vector<float> density() const { return density_->read<float>(); }
    std::vector<Float4> velocity() const { return velocity_->read<Float4>(); }
    uint32_t outside() const { return outside_->read<uint32_t>()[0]; }

    // Verlet velocities, m/s.
    std::vector<std::array<double, 3>> velocities() const {
        const auto x = position_->read<Float4>(), prev = prev_->read<Float4>();
        std::vector<std::array<double, 3>> v(vertices_);
        for (size_t i = 0; i < vertices_; ++i)
            for (size_t c = 0; c < 3; ++c)
                v[i][c] = (static_cast<double>(x[element(i)][c]) - prev[element(i)][c]) / params.h;
        return v;
    }

    plait_grid_params params;

  private:
    static size_t element(size_t particle) { return particle / 2 * 3 + particle % 2; }
    void clear(const StageBuffer& words, uint32_t value, size_t count) {
        device_.run(PLAIT_STAGE_grid_clear, count, plait_grid_clear_params{value}, {&words});
    }

    size_t vertices_, elements_, voxels_;
    StageDevice& device_;
    std::unique_ptr<StageBuffer> count_, position_, prev_, slot_, outside_, density_, velocity_,
        sum_;
};

} // namespace plait::test
