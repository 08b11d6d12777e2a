// Reading the fields of a sim.
#include "base/format.hpp"
#include "core/sim/sim.hpp"

#include <algorithm>

namespace plait {
namespace {

using Float4 = std::array<float, 4>;

Error is_off(const char* what) {
    return {PLAIT_INVALID_STATE, format("%s is off", what)};
}

// xyz of each, as the world has it.
void multiply(std::span<float> values, float scale) {
    for (size_t i = 0; i < values.size(); ++i)
        values[i] *= i % 4 == 3 ? 1 : scale;
}

} // namespace

// The buffer a field is read from; velocity is measured from two of them.
Result<const Buffer*> Sim::field_buffer(plait_field field) const {
    switch (field) {
    case PLAIT_FIELD_POSITION:
        return &display_.shown(state_);
    case PLAIT_FIELD_TANGENT:
        return &display_.tangent();
    case PLAIT_FIELD_REST:
        return &state_.rest;
    case PLAIT_FIELD_VERTEX_COUNT:
        return &state_.vertex_count;
    case PLAIT_FIELD_GRID_DENSITY:
    case PLAIT_FIELD_GRID_VELOCITY:
        if (!grid_.density())
            return is_off("the grid (plait_sim_set_grid)");
        return field == PLAIT_FIELD_GRID_DENSITY ? &grid_.density() : &grid_.velocity();
    case PLAIT_FIELD_POSITION_PREV:
    case PLAIT_FIELD_VELOCITY:
        return &state_.position_prev;
    case PLAIT_FIELD_FOLLOW_GUIDE:
        if (layout_.follows == 0)
            return Error{PLAIT_INVALID_STATE,
                         "follows_per_guide is 0, no follow_map has strands: there are no follows"};
        return &display_.follow_guide();
    case PLAIT_FIELD_POSITION_LAST_FRAME:
        if (!display_.last_frame())
            return is_off("keep_last_frame");
        return &display_.last_frame();
    case PLAIT_FIELD_ACCELERATION:
        if (!state_.acceleration)
            return is_off("acceleration (plait_sim_set_acceleration)");
        return &state_.acceleration;
    case PLAIT_FIELD_PIN:
        if (!state_.pin)
            return Error{PLAIT_INVALID_STATE, "no vertex is pinned, and pins have no buffer"};
        return &state_.pin;
    case PLAIT_FIELD_WETNESS:
        if (!state_.wetness)
            return Error{PLAIT_INVALID_STATE, "all hair is dry, and wetness has no buffer"};
        return &state_.wetness;
    default:
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("field is %d, range is [0, %d]", field, PLAIT_FIELD_COUNT - 1)};
    }
}

// A run of vertices to a work-item, and the runs' boxes to one: enough of them to fill a device.
constexpr uint32_t runs = 1024;

Status Sim::make_bounds() {
    if (box_)
        return {};
    PLAIT_TRY(device().create(boxes_, PLAIT_ELEMENT_FLOAT4, size_t{2} * runs, "boxes"));
    return device().create(box_, PLAIT_ELEMENT_FLOAT4, 2, "box");
}

void Sim::add_bounds() {
    const uint32_t shown =
        levels_ ? std::max(levels_->shown(), levels_->stepped()) : layout_.strands();
    const uint32_t count = shown * layout_.row, share = (count - 1) / runs + 1;
    const uint32_t used = (count - 1) / share + 1;
    schedule_.add(PLAIT_STAGE_bounds, used, plait_bounds_params{count, share, 0},
                  {&display_.shown(state_), &boxes_});
    schedule_.add(PLAIT_STAGE_bounds, 1, plait_bounds_params{used, used, 1}, {&boxes_, &box_});
}

Result<const Buffer*> Sim::filled_field(plait_field field) {
    if (field != PLAIT_FIELD_BOUNDS)
        return field_buffer(field);
    PLAIT_TRY(make_bounds());
    schedule_.clear();
    add_bounds();
    PLAIT_TRY(submit());
    return &box_;
}

Result<size_t> Sim::field_bytes(plait_field field) const {
    if (field == PLAIT_FIELD_BOUNDS)
        return size_t{2} * sizeof(Float4);
    if (field == PLAIT_FIELD_WETNESS) {
        if (!params_.wetness.on)
            return is_off("wetness (plait_sim_set_wetness)");
        return layout_.guides * sizeof(float);
    }
    if (field == PLAIT_FIELD_PIN) {
        PLAIT_TRY(check_takes_pins());
        return layout_.guide_vertices() * sizeof(Float4);
    }
    const auto buffer = field_buffer(field);
    if (!buffer)
        return buffer.error();
    return (*buffer)->bytes();
}

Status Sim::read(plait_field field, void* dst) {
    if (field == PLAIT_FIELD_VELOCITY)
        return read_velocity({static_cast<float*>(dst), size_t{4} * layout_.guide_vertices()});
    if (field == PLAIT_FIELD_WETNESS && !state_.wetness) {
        std::fill_n(static_cast<float*>(dst), layout_.guides, 0.0f);
        return {};
    }
    if (field == PLAIT_FIELD_PIN && !state_.pin) {
        std::fill_n(static_cast<float*>(dst), size_t{4} * layout_.guide_vertices(), 0.0f);
        return {};
    }
    const auto buffer = filled_field(field);
    if (!buffer)
        return buffer.error();
    PLAIT_TRY(device().read(**buffer, dst));
    if (field == PLAIT_FIELD_POSITION_PREV)
        multiply({static_cast<float*>(dst), size_t{4} * layout_.guide_vertices()}, scale_);
    return {};
}

Result<uint64_t> Sim::read_later(plait_field field, void* dst) {
    if (field == PLAIT_FIELD_VELOCITY || field == PLAIT_FIELD_POSITION_PREV)
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("field is %d (%s), which the host computes: plait_sim_read has it",
                            field, field == PLAIT_FIELD_VELOCITY ? "VELOCITY" : "POSITION_PREV")};
    const bool no_buffer = (field == PLAIT_FIELD_WETNESS && !state_.wetness) ||
                           (field == PLAIT_FIELD_PIN && !state_.pin);
    if (no_buffer) {
        PLAIT_TRY(read(field, dst));
    } else {
        const auto buffer = filled_field(field);
        if (!buffer)
            return buffer.error();
        PLAIT_TRY(device().read_later(**buffer, dst));
    }
    const auto fence = device().fence();
    if (fence)
        read_fence_ = *fence;
    return fence;
}

// Verlet velocity over the last substep; padding has the tip's, as its positions are copies of the tip. Strands
// that are not stepped have none.
Status Sim::read_velocity(std::span<float> dst) {
    std::pmr::vector<float> before(dst.size(), &context_.memory);
    PLAIT_TRY(device().read(state_.position_prev, before.data()));
    PLAIT_TRY(device().read(state_.position, 0, layout_.guide_vertices(), dst.data()));
    const float rate = scale_ / substep_length();
    const size_t stepped = size_t{4} * this->stepped().guide_vertices();
    for (size_t i = 0; i < dst.size(); ++i)
        dst[i] = i % 4 == 3 || i >= stepped ? 0 : (dst[i] - before[i]) * rate;
    std::pmr::vector<uint32_t> counts(layout_.guides, &context_.memory);
    PLAIT_TRY(device().read(state_.vertex_count, 0, counts.size(), counts.data()));
    for (size_t strand = 0; strand < counts.size(); ++strand) {
        const size_t first = strand * layout_.row, tip = first + counts[strand] - 1;
        for (size_t i = tip + 1; i < first + layout_.row; ++i)
            std::copy_n(&dst[4 * tip], 4, &dst[4 * i]);
    }
    return {};
}

} // namespace plait
