// One strand on the default device, through plait.h: the scene most failures need no more than. And
// several strands of one length, on any context.
#pragma once

#include <plait/plait.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

namespace plait::test {

using Vec3 = std::array<float, 3>;

// A collider without friction.
inline plait_collider_desc smooth_collider() {
    auto desc = plait_collider_desc_defaults();
    desc.friction = 0;
    return desc;
}

struct StrandShape {
    uint32_t vertices = 32;
    float length = 0.3f; // m
    Vec3 direction = {1.0f, 0.0f, 0.0f};
};

// Straight, from the origin.
inline std::vector<Vec3> straight(const StrandShape& shape) {
    std::vector<Vec3> points(shape.vertices);
    for (uint32_t i = 0; i < shape.vertices; ++i)
        for (size_t c = 0; c < 3; ++c)
            points[i][c] = shape.direction[c] * shape.length * static_cast<float>(i) /
                           static_cast<float>(shape.vertices - 1);
    return points;
}

#define PLAIT_EXPECT(call) EXPECT_EQ(call, PLAIT_OK) << plait_last_error()

struct Destroy {
    void operator()(plait_context* context) const { plait_context_destroy(context); }
    void operator()(plait_groom* groom) const { plait_groom_destroy(groom); }
    void operator()(plait_sim* sim) const { plait_sim_destroy(sim); }
};

using Context = std::unique_ptr<plait_context, Destroy>;

inline Context make_context(const plait_context_desc* desc) {
    plait_context* made = nullptr;
    PLAIT_EXPECT(plait_context_create(desc, &made));
    return Context(made);
}

inline plait_context* shared_context() {
    static const Context context = make_context(nullptr);
    return context.get();
}

class OneStrand {
  public:
    OneStrand(const std::vector<Vec3>& points, const plait::SimDesc& desc)
        : OneStrand(points, static_cast<uint32_t>(points.size()), desc, shared_context()) {}
    OneStrand(const std::vector<Vec3>& points, uint32_t vertices_per_strand,
              const plait::SimDesc& desc, plait_context* context) {
        plait_groom_desc groom = plait_groom_desc_defaults();
        groom.positions = {points.data(), points.size(), 0};
        groom.vertices_per_strand = vertices_per_strand;
        plait_groom* made_groom = nullptr;
        PLAIT_EXPECT(plait_groom_create(&groom, nullptr, &made_groom));
        groom_.reset(made_groom);
        plait_sim* made_sim = nullptr;
        PLAIT_EXPECT(plait::create_sim(context, groom_.get(), desc, &made_sim));
        sim_.reset(made_sim);
        step_ = desc.step;
    }
    OneStrand(const StrandShape& shape, const plait::SimDesc& desc)
        : OneStrand(straight(shape), desc) {}

    void step() { step(step_); }
    void step(double dt) { PLAIT_EXPECT(plait_sim_step(sim_.get(), dt)); }
    void run(double seconds) {
        const long steps = std::lround(seconds / step_);
        for (long i = 0; i < steps; ++i)
            step();
    }
    // Head at t, unturned, at the end of the next step.
    void move_head(Vec3 t) {
        const plait_roots roots = head_at(t);
        PLAIT_EXPECT(plait_sim_set_roots(sim_.get(), &roots));
    }
    void teleport(Vec3 t) {
        const plait_roots roots = head_at(t);
        PLAIT_EXPECT(plait_sim_teleport(sim_.get(), &roots));
    }

    std::vector<std::array<float, 4>> read(plait_field field) const {
        size_t size = 0;
        PLAIT_EXPECT(plait_sim_read(sim_.get(), field, nullptr, &size));
        std::vector<std::array<float, 4>> data(size / sizeof(std::array<float, 4>));
        PLAIT_EXPECT(plait_sim_read(sim_.get(), field, data.data(), &size));
        return data;
    }
    std::array<float, 4> tip() const { return read(PLAIT_FIELD_POSITION).back(); }
    plait_sim_measures measure() const {
        plait_sim_measures stats{};
        stats.struct_size = sizeof stats;
        PLAIT_EXPECT(plait_sim_measure(sim_.get(), &stats));
        return stats;
    }
    plait_sim_info describe() const {
        plait_sim_info info = plait_sim_info_defaults();
        PLAIT_EXPECT(plait_sim_describe(sim_.get(), &info));
        return info;
    }
    plait_groom_info groom_info() const {
        plait_groom_info info{};
        info.struct_size = sizeof info;
        PLAIT_EXPECT(plait_groom_describe(groom_.get(), &info));
        return info;
    }
    plait_sim* sim() const { return sim_.get(); }

  private:
    static plait_roots head_at(Vec3 t) {
        plait_roots roots = plait_roots_defaults();
        roots.head = {{0.0f, 0.0f, 0.0f, 1.0f}, {t[0], t[1], t[2]}};
        return roots;
    }

    std::unique_ptr<plait_groom, Destroy> groom_;
    std::unique_ptr<plait_sim, Destroy> sim_;
    double step_ = 0.0;
};

} // namespace plait::test
