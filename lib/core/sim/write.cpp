// Writing the fields of a sim.
#include "base/format.hpp"
#include "core/base/pose.hpp"
#include "core/sim/sim.hpp"

#include <algorithm>
#include <cmath>

namespace plait {
namespace {

using Float4 = std::array<float, 4>;

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

plait_pose pose_at(std::span<const std::array<float, 4>> rows, size_t first) {
    plait_pose pose;
    std::ranges::copy(rows[first], pose.q);
    std::copy_n(rows[first + 1].begin(), 3, pose.t);
    return pose;
}

} // namespace

// Both histories, as if a vertex had been faster by its gain. What is written as it was read keeps their bits.
Status Sim::write_velocity(const float* src) {
    std::pmr::vector<float> gain(size_t{4} * layout_.guide_vertices(), &context_.memory);
    std::pmr::vector<float> history(gain.size(), &context_.memory);
    PLAIT_TRY(read_velocity(gain));
    for (size_t i = 0; i < gain.size(); ++i)
        gain[i] = i % 4 == 3 ? 0 : src[i] - gain[i];
    for (const int steps : {1, 2}) {
        const float h = static_cast<float>(steps) * substep_length() / scale_;
        const Buffer& to = steps == 1 ? state_.position_prev : state_.position_prev2;
        if (!to) // which not every model keeps
            continue;
        PLAIT_TRY(device().read(to, history.data()));
        for (size_t i = 0; i < gain.size(); ++i)
            history[i] -= h * gain[i];
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

// Places of the caller, m, as they are seen, in the groom's units and where the last step left the roots: between two
// steps hair is seen on a head that has moved on.
Status Sim::take_seen(const float* src, std::span<Float4> now, std::span<unsigned char> moved) {
    std::pmr::vector<Float4> seen(now.begin(), now.end(), &context_.memory);
    if (display_.interpolates())
        PLAIT_TRY(device().read(display_.before_scale(state_), 0, now.size(), seen.data()));
    for (size_t i = 0; i < now.size(); ++i)
        moved[i] = !std::equal(src + 4 * i, src + 4 * i + 3, seen[i].begin(),
                               [&](float x, float own) { return was_read(x, own, scale_); });
    if (!display_.interpolates()) {
        for (size_t i = 0; i < now.size(); ++i)
            take_place(src + 4 * i, scale_, now[i]);
        return {};
    }
    std::pmr::vector<Float4> last(state_.pose.count(), &context_.memory);
    std::pmr::vector<Float4> shown(last.size(), &context_.memory);
    std::pmr::vector<Float4> kept(now.size(), &context_.memory);
    PLAIT_TRY(device().read(state_.pose, last.data()));
    PLAIT_TRY(device().read(display_.pose(state_), shown.data()));
    PLAIT_TRY(device().read(display_.kept(), kept.data()));
    for (size_t i = 0; i < now.size(); ++i) {
        if (!moved[i])
            continue;
        const size_t root = PLAIT_POSE_STRIDE * (i / layout_.row);
        take_place(src + 4 * i, scale_, seen[i]);
        plait_pose at = identity_pose;
        std::copy_n(seen[i].begin(), 3, at.t);
        const plait_pose from = pose_at(shown, root);
        std::copy_n(carried(at, from, identity_pose).t, 3, kept[i].data());
        std::copy_n(carried(at, from, pose_at(last, root)).t, 3, now[i].data());
    }
    return device().write(display_.kept(), kept.data());
}

// Hair that is put elsewhere keeps its velocity, and may be on the other side of a sheet.
Status Sim::write_positions(const float* src) {
    const size_t vertices = layout_.guide_vertices();
    std::pmr::vector<Float4> now(vertices, &context_.memory), history(vertices, &context_.memory);
    PLAIT_TRY(device().read(state_.position, 0, vertices, now.data()));
    const std::pmr::vector<Float4> was(now, &context_.memory);
    std::pmr::vector<unsigned char> moved(vertices, &context_.memory);
    PLAIT_TRY(take_seen(src, now, moved));
    for (const Buffer* to : {&state_.position_prev, &state_.position_prev2}) {
        if (!*to)
            continue;
        PLAIT_TRY(device().read(*to, history.data()));
        for (size_t i = 0; i < vertices; ++i)
            for (size_t k = 0; moved[i] && k < 3; ++k)
                history[i][k] += now[i][k] - was[i][k];
        PLAIT_TRY(device().write(*to, history.data()));
    }
    PLAIT_TRY(bending_.forget_sides(device(), moved));
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
    stir();
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
    stir();
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
