// Reading and writing the fields of a sim.
#include "base/format.hpp"
#include "core/sim/sim.hpp"

#include <algorithm>
#include <cmath>

namespace plait {
namespace {

using Float4 = std::array<float, 4>;

Error is_off(const char* what) {
    return {PLAIT_INVALID_STATE, format("%s is off", what)};
}

// What the caller may write: as far as grooms and heads may be, and as fast as gravity may get hair
// in a second.
constexpr float farthest = 1e6f;                     // m
constexpr float fastest = 1e4f;                      // m/s
constexpr float strongest = PLAIT_MOST_ACCELERATION; // m/s^2

// Of xyz; w is not read.
Status check_vectors(const float* values, size_t count, const char* field, float most) {
    for (size_t i = 0; i < count; ++i)
        if (i % 4 != 3 && !(std::abs(values[i]) <= most))
            return Error{PLAIT_INVALID_ARGUMENT,
                         format("%s[%zu].%c is %g, range is [%g, %g]", field, i / 4, "xyz"[i % 4],
                                double(values[i]), double(-most), double(most))};
    return {};
}

// xyz of each, as the world has it.
void multiply(std::span<float> values, float scale) {
    for (size_t i = 0; i < values.size(); ++i)
        values[i] *= i % 4 == 3 ? 1 : scale;
}

// Whether `world`, m, was read from `own`, which was multiplied before or after it was rounded.
bool was_read(float world, float own, float scale) {
    constexpr float rounding = 2.5e-7f;
    return scale == 1 ? world == own : std::abs(world - own * scale) <= rounding * std::abs(world);
}

// A place of the world, m, in the groom's units; what was read from there keeps its bits.
void take_place(const float* world, float scale, Float4& own) {
    for (size_t i = 0; i < 3; ++i)
        own[i] = was_read(world[i], own[i], scale) ? own[i] : world[i] / scale;
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

// Verlet velocity over the last substep; padding has that of its strand's history, at rest 0. Strands
// that are not stepped have none.
Status Sim::read_velocity(std::span<float> dst) {
    std::pmr::vector<float> before(dst.size(), &context_.memory);
    PLAIT_TRY(device().read(state_.position_prev, before.data()));
    PLAIT_TRY(device().read(state_.position, 0, layout_.guide_vertices(), dst.data()));
    const float rate = scale_ / substep_length();
    const size_t stepped = size_t{4} * this->stepped().guide_vertices();
    for (size_t i = 0; i < dst.size(); ++i)
        dst[i] = i % 4 == 3 || i >= stepped ? 0 : (dst[i] - before[i]) * rate;
    return {};
}

// Both histories, as if the vertex had moved at this velocity for two substeps.
Status Sim::write_velocity(const float* src) {
    const size_t count = size_t{4} * layout_.guide_vertices();
    std::pmr::vector<float> now(count, &context_.memory);
    std::pmr::vector<float> history(count, &context_.memory);
    PLAIT_TRY(device().read(state_.position, 0, layout_.guide_vertices(), now.data()));
    for (const int steps : {1, 2}) {
        const float h = static_cast<float>(steps) * substep_length() / scale_;
        for (size_t i = 0; i < count; ++i)
            history[i] = i % 4 == 3 ? now[i] : now[i] - h * src[i];
        const Buffer& to = steps == 1 ? state_.position_prev : state_.position_prev2;
        if (to) // the step before the last, where the model keeps it
            PLAIT_TRY(device().write(to, history.data()));
    }
    return {};
}

// w is kept.
Status Sim::write_places(const Buffer& to, const float* src) {
    const size_t vertices = layout_.guide_vertices();
    std::pmr::vector<Float4> merged(vertices, &context_.memory);
    PLAIT_TRY(device().read(to, 0, vertices, merged.data()));
    for (size_t i = 0; i < vertices; ++i)
        take_place(src + 4 * i, scale_, merged[i]);
    return device().write(to, 0, vertices, merged.data());
}

// Hair that is put elsewhere keeps its velocity, and may be on the other side of a sheet.
Status Sim::write_positions(const float* src) {
    const size_t vertices = layout_.guide_vertices();
    std::pmr::vector<Float4> now(vertices, &context_.memory), history(vertices, &context_.memory);
    PLAIT_TRY(device().read(state_.position, 0, vertices, now.data()));
    std::pmr::vector<unsigned char> moved(vertices, &context_.memory);
    for (size_t i = 0; i < vertices; ++i)
        moved[i] = !std::equal(src + 4 * i, src + 4 * i + 3, now[i].begin(),
                               [&](float x, float own) { return was_read(x, own, scale_); });
    for (const Buffer* to : {&state_.position_prev, &state_.position_prev2}) {
        if (!*to)
            continue;
        PLAIT_TRY(device().read(*to, history.data()));
        for (size_t i = 0; i < vertices; ++i)
            for (size_t k = 0; moved[i] && k < 3; ++k)
                history[i][k] += src[4 * i + k] / scale_ - now[i][k];
        PLAIT_TRY(device().write(*to, history.data()));
    }
    PLAIT_TRY(bending_.forget_sides(device(), moved));
    for (size_t i = 0; i < vertices; ++i)
        take_place(src + 4 * i, scale_, now[i]);
    return device().write(state_.position, 0, vertices, now.data());
}

Status Sim::write_acceleration(std::span<const float> src) {
    const auto buffer = field_buffer(PLAIT_FIELD_ACCELERATION);
    if (!buffer)
        return buffer.error();
    PLAIT_TRY(check_vectors(src.data(), src.size(), "acceleration", strongest));
    return device().write(state_.acceleration, src.data());
}

Status Sim::write_pins(std::span<const float> src) {
    PLAIT_TRY(check_takes_pins());
    PLAIT_TRY(check_vectors(src.data(), src.size(), "pin", farthest));
    PLAIT_TRY(check_pin_stiffness(src, layout_.row));
    PLAIT_TRY(open_pins());
    return device().write(state_.pin, src.data());
}

Status Sim::check_takes_pins() const {
    if (desc_.model == PLAIT_MODEL_ARTICULATED)
        return {};
    return Error{PLAIT_INVALID_STATE,
                 "the sim is of model 0 (tressfx), whose strands take no pins; those of "
                 "articulated do"};
}

// Where nothing is pinned yet, and the stages that pins take can be built.
Status Sim::open_pins() {
    if (state_.pin)
        return {};
    PLAIT_TRY(plait::open_pins(device(), layout_, state_, &context_.memory));
    Status status = model_->open(device(), part_needs());
    if (status)
        status = check_stages();
    if (status)
        return status;
    close_pins(state_);
    (void)model_->open(device(), part_needs()); // which makes nothing
    return status;
}

Status Sim::write_wetness(std::span<const float> src) {
    PLAIT_TRY(check_wetness(src));
    if (std::ranges::all_of(src, [](float w) { return w == 0; })) {
        close_wetness();
        return {};
    }
    const bool opens = !state_.wetness;
    if (opens)
        PLAIT_TRY(open_wetness());
    const Status status = wetness_.give(device(), state_, src);
    if (!status && opens)
        close_wetness();
    return status;
}

Status Sim::set_pins(std::span<const plait_pin> pins) {
    PLAIT_TRY(check_takes_pins());
    if (pins.empty()) {
        close_pins(state_);
        return model_->open(device(), part_needs());
    }
    PLAIT_TRY(pin_table_.fill(device(), layout_, state_));
    const auto rows = pin_table_.rows(pins);
    if (!rows)
        return rows.error();
    PLAIT_TRY(open_pins());
    return device().upload(state_.pin, rows->data());
}

Status Sim::write(plait_field field, const void* src) {
    const auto* values = static_cast<const float*>(src);
    const size_t vertices = layout_.guide_vertices();
    if (field == PLAIT_FIELD_ACCELERATION)
        return write_acceleration({values, 4 * vertices});
    if (field == PLAIT_FIELD_PIN)
        return write_pins({values, 4 * vertices});
    if (field == PLAIT_FIELD_WETNESS)
        return write_wetness({values, layout_.guides});
    const bool velocity = field == PLAIT_FIELD_VELOCITY;
    PLAIT_TRY(check_vectors(values, 4 * vertices, velocity ? "velocity" : "position",
                            velocity ? fastest : farthest));
    if (velocity) { // in the world: nothing of the head's motion is to be added
        motion_.give();
        PLAIT_TRY(write_velocity(values));
        schedule_.clear();
        model_->adopt(schedule_, present(), Changed::velocities);
        return submit();
    }
    const bool places = field == PLAIT_FIELD_POSITION;
    PLAIT_TRY(places ? write_positions(values) : write_places(state_.position_prev, values));
    schedule_.clear();
    model_->adopt(schedule_, present(), places ? Changed::places : Changed::velocities);
    append_shown();
    return submit();
}

} // namespace plait
