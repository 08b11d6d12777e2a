// What a part of the strands over lanes appends: of its strands those that are stepped.
#include "core/strands/lane_part.hpp"

#include <algorithm>
#include <cmath>

namespace plait {
namespace {

// Contact, in strand lengths.
constexpr float contact_stiffness = 1e5f;  // a weight sinks 1/so deep
constexpr float least_gravity = 1.0f;      // m/s^2, where there is none
constexpr float steps_of_contact = 100.0f; // least rate, 1/h^2
constexpr float contact_creep = 5e-4f;     // 1/s
constexpr float rounding = 1e-6f;

// The integrator's own step, s.
float step_of(float h, uint32_t bdf2) {
    return bdf2 ? h * 2.0f / 3.0f : h;
}

// A contact under a vertex' own weight is a hundred-thousandth of a strand deep, less than float32
// loses at a metre from the origin; in short substeps stiff enough that nothing bounces. 1/s^2.
float contact_rate(const float (&gravity)[3], float h, uint32_t bdf2, float length) {
    const float g = std::hypot(gravity[0], gravity[1], gravity[2]);
    const float step = step_of(h, bdf2);
    return std::max(contact_stiffness * std::max(g, least_gravity) / length,
                    steps_of_contact / (step * step));
}

// Held hair creeps by so much in a substep, m; below a millionth of its length is rounding.
float contact_slip(float h, float length) {
    return length * std::max(contact_creep * h, rounding);
}

} // namespace

Part LanePart::part(const StepInput& at, float mean_length) const {
    const Params& p = at.params;
    plait_lane_params solve{};
    solve.vertex_stride = lanes_.row;
    solve.tile = lanes_.tile;
    solve.row_stride = source_.layout.row;
    solve.h = at.h;
    solve.iterations = settings_.iterations_of(p);
    solve.bdf2 = settings_.bdf2_of(p);
    solve.drag = at.drag;
    for (size_t i = 0; i < 3; ++i) {
        solve.gravity[i] = p.gravity[i];
        solve.air[i] = at.air[i];
    }
    solve.contact_rate = contact_rate(p.gravity, at.h, solve.bdf2, mean_length);
    solve.contact_slip = contact_slip(at.h, mean_length);
    return {stepped_lanes(),
            source_.layout.row,
            at.h,
            at.share,
            solve.bdf2,
            fill_.of.holds(),
            solve,
            at.state.vertex_count,
            at.state.rest,
            at.state.pose,
            at.state.acceleration,
            lane_strand_,
            fill_.material,
            material(),
            fill_.groom,
            x_,
            v_,
            history_.x,
            history_.v,
            volume_.share,
            volume_.pressure,
            push_,
            spring_,
            plane_,
            hollow_};
}

void LanePart::substep(Schedule& schedule, const StepInput& at, const Part& part,
                       const Doors& doors) {
    const ColliderRows& bodies = at.bodies.solids;
    schedule.add(PLAIT_STAGE_articulated, stepped_, solve_params(part, doors, bodies),
                 {&lane_strand_, &part.rest, &part.pose, &part.material, &fill_.rest,
                  &bodies.buffer, &part.pushed(), &spring_, &plane_, &x_, &v_, &q_, &q_before_,
                  &history_.x, &history_.v, &normal_force_, &hollow_},
                 lanes_.row);
}

void LanePart::publish(Schedule& schedule, const StepInput& at, const Buffer* tangent) const {
    schedule.add(PLAIT_STAGE_lane_unpack, stepped_,
                 plait_lane_unpack_params{lanes_.row, lanes_.tile, source_.layout.row, at.h,
                                          tangent ? 1u : 0u},
                 {&lane_strand_, &at.state.vertex_count, &x_, &v_, &at.state.position,
                  &at.state.position_prev, tangent},
                 lanes_.row);
}

// BDF2 goes on from the step before as well. An impulse, which is what the grid gives, was not there
// then; hair whose velocity a caller gives moved with it.
void LanePart::adopt(Schedule& schedule, const StepInput& at, Changed by) const {
    const uint32_t history = !history_.x ? 0 : by == Changed::velocities ? 2 : 1;
    schedule.add(
        PLAIT_STAGE_lane_pack, stepped_ * lanes_.row,
        plait_lane_history_params{lanes_.row, lanes_.tile, source_.layout.row, at.h, history},
        {&lane_strand_, &at.state.vertex_count, &at.state.position, &at.state.position_prev, &x_,
         &v_, &history_.x, &history_.v, &normal_force_});
    const uint32_t before = by == Changed::velocities ? 1 : 0;
    if (by == Changed::places || (before && history_.x))
        schedule.add(PLAIT_STAGE_lane_orient, stepped_,
                     plait_lane_orient_params{lanes_.row, lanes_.tile, before},
                     {&lane_strand_, &at.state.pose, &material(), &fill_.rest, &x_, &history_.x,
                      &q_, &q_before_},
                     lanes_.row);
}

void LanePart::reset(Schedule& schedule, const StepInput& at) {
    schedule.add(PLAIT_STAGE_lane_reset, stepped_, state_params(),
                 {&lane_strand_, &at.state.rest, &at.state.pose,
                  fill_.start ? &fill_.start : &fill_.rest, &x_, &v_, &q_, &q_before_, &history_.x,
                  &history_.v, &normal_force_},
                 lanes_.row);
}

void LanePart::teleport(Schedule& schedule, const StepInput& at, const Buffer& pose) {
    schedule.add(PLAIT_STAGE_lane_teleport, stepped_, state_params(),
                 {&lane_strand_, &at.state.rest, &at.state.pose, &pose, &x_, &v_, &q_, &q_before_,
                  &history_.x, &history_.v, &normal_force_},
                 lanes_.row);
}

void LanePart::set_off(Schedule& schedule, const StepInput& at, const Buffer& before,
                       const Buffer& was, const Buffer& next, float jump) const {
    schedule.add(PLAIT_STAGE_lane_set_off, stepped_,
                 plait_set_off_params{lanes_.row, lanes_.tile, source_.layout.row,
                                      history_.x ? 1u : 0u, at.h, jump},
                 {&lane_strand_, &at.state.rest, &before, &was, &at.state.pose, &next, &x_, &v_,
                  &q_before_, &history_.x, &history_.v},
                 lanes_.row);
}

void LanePart::carry(Schedule& schedule, const plait_pose& motion) const {
    schedule.add(PLAIT_STAGE_lane_carry, stepped_,
                 carry_params(motion, lanes_.row, lanes_.tile, bool(history_.x)),
                 {&x_, &v_, &q_, &q_before_, &history_.x, &history_.v}, lanes_.row);
}

uint32_t LanePart::members_before(uint32_t strand) const {
    return static_cast<uint32_t>(
        std::ranges::count_if(members_, [&](uint32_t member) { return member < strand; }));
}

void LanePart::wake(Schedule& schedule, const StepInput& at, const Waking& waking) const {
    const uint32_t first = members_before(waking.first);
    schedule.add(PLAIT_STAGE_level_wake, members_before(waking.last) - first,
                 plait_level_wake_params{lanes_.row, lanes_.tile, source_.layout.row, first,
                                         history_.x ? 1u : 0u,
                                         static_cast<float>(source_.step / settings_.substeps),
                                         static_cast<float>(source_.step)},
                 {&lane_strand_, &at.state.rest, &waking.pose_before, &at.state.pose, &waking.from,
                  &waking.to, &waking.position, fill_.start ? &fill_.start : &fill_.rest, &x_, &v_,
                  &q_, &q_before_, &history_.x, &history_.v, &normal_force_});
}

void LanePart::add_dynamic(std::pmr::vector<LaneBuffer>& to) const {
    const LaneBuffer state[] = {
        {&x_, 3, stepped_lanes()},         {&v_, 3, stepped_lanes()},
        {&q_, 4, stepped_lanes()},         {&q_before_, 4, stepped_lanes(), true},
        {&history_.x, 3, stepped_lanes()}, {&history_.v, 3, stepped_lanes()}};
    for (const LaneBuffer& buffer : state)
        if (*buffer.buffer)
            to.push_back(buffer);
}

Status LanePart::clear_normal_force(Device& device) const {
    const std::pmr::vector<float> none(normal_force_.count(), 0.0f, source_.memory);
    return device.write(normal_force_, none.data());
}

uint64_t LanePart::device_bytes() const {
    uint64_t bytes = 0;
    for (const Buffer* buffer :
         {&fill_.material, &fill_.wet, &fill_.groom, &fill_.rest, &fill_.start, &x_, &v_, &q_,
          &q_before_, &normal_force_, &history_.x, &history_.v, &push_, &spring_, &plane_, &hollow_,
          &lane_strand_, &volume_.share, &volume_.pressure})
        bytes += buffer->bytes();
    return bytes;
}

} // namespace plait
