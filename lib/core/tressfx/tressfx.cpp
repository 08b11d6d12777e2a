// The parity model: TressFX 4.1's stages in published order, or with velocity shock propagation
// before the global shape constraint. A stage that would change nothing is left out.
#include "core/base/choices.hpp"
#include "core/strands/model.hpp"
#include "core/tressfx/wind_cone.hpp"

namespace plait {
namespace {

constexpr uint32_t pinned = 2; // the root segment: its direction is the hair's growth direction
constexpr float off = 1e6f;    // max_displacement and vsp_accel_threshold that are never reached

bool has_shock(const Params& p) {
    return p.tressfx.vsp_coeff > 0 || p.tressfx.vsp_accel_threshold < off;
}

bool has_wind(const Params& p) {
    if (p.tressfx.wind_form == PLAIT_WIND_FORM_DRAG)
        return p.tressfx.air_drag > 0;
    return p.tressfx.wind[0] != 0 || p.tressfx.wind[1] != 0 || p.tressfx.wind[2] != 0;
}

bool has_global_shape(const Params& p) {
    return p.tressfx.global_stiffness > 0 && p.tressfx.global_range > 0;
}

bool has_local_shape(const Params& p) {
    return p.tressfx.local_iterations > 0 && p.tressfx.local_stiffness > 0;
}

bool has_attachment(const Params& p) {
    return p.tressfx.attachment > 0;
}

void global_shape(Schedule& schedule, const StepInput& at) {
    const Params& p = at.params;
    const State& s = at.state;
    if (has_global_shape(p))
        schedule.add(PLAIT_STAGE_global_shape, at.layout.guide_vertices(),
                     plait_global_shape_params{at.layout.row, p.tressfx.global_stiffness,
                                               p.tressfx.global_range},
                     {&s.rest, &s.vertex_count, &s.pose, &s.position});
}

void local_shape(Schedule& schedule, const StepInput& at) {
    const Params& p = at.params;
    const State& s = at.state;
    if (has_local_shape(p))
        schedule.add(PLAIT_STAGE_local_shape, at.layout.guides,
                     plait_local_shape_params{at.layout.row, p.tressfx.local_stiffness,
                                              p.tressfx.local_iterations},
                     {&s.rest, &s.vertex_count, &s.pose, &s.position});
}

void attach(Schedule& schedule, const StepInput& at) {
    const State& s = at.state;
    if (has_attachment(at.params))
        schedule.add(PLAIT_STAGE_attach, at.layout.guides,
                     plait_attach_params{at.layout.row, at.params.tressfx.attachment},
                     {&s.rest_length, &s.vertex_count, &s.position});
}

class TressFx final : public Model {
  public:
    uint32_t pinned_vertices() const override { return pinned; }
    bool keeps_two_steps() const override { return true; }
    explicit TressFx(const Layout& layout) : layout_(layout) {}
    Status prepare(Device& device, const Params& params) override;
    void swap() noexcept override {
        if (changes_)
            strand_motion_.swap(next_strand_motion_);
    }
    void discard() override;
    void substep(Schedule& schedule, const StepInput& at, const FillDoors&) override;
    void reset(Schedule& schedule, const StepInput& at) override;
    void teleport(Schedule& schedule, const StepInput& at, const Buffer& pose) override;
    void set_off(Schedule& schedule, const StepInput& at, const Buffer& before, const Buffer& was,
                 const Buffer& next, float jump) override;
    void carry(Schedule& schedule, const StepInput& at, const plait_pose& motion) override;
    uint64_t device_bytes() const override { return strand_motion_.bytes(); }

  private:
    void shock(Schedule& schedule, const StepInput& at) const;

    Layout layout_;
    // float4 [2*guides], only while velocity shock propagation is on
    Buffer strand_motion_, next_strand_motion_;
    bool changes_ = false;
};

Status TressFx::prepare(Device& device, const Params& params) {
    const bool needed = has_shock(params);
    if (needed && !strand_motion_)
        PLAIT_TRY(device.create(next_strand_motion_, PLAIT_ELEMENT_FLOAT4,
                                size_t{PLAIT_MOTION_STRIDE} * layout_.guides, "strand_motion"));
    changes_ = needed != bool(strand_motion_);
    return {};
}

void TressFx::discard() {
    next_strand_motion_ = {};
    changes_ = false;
}

void integrate(Schedule& schedule, const StepInput& at, float global_stiffness) {
    const Params& p = at.params;
    const State& s = at.state;
    const plait_integrate_params params = {
        at.layout.row,           at.h,
        p.tressfx.damping,       global_stiffness,
        p.tressfx.global_range,  {p.gravity[0], p.gravity[1], p.gravity[2]},
        s.acceleration ? 1u : 0u};
    schedule.add(PLAIT_STAGE_integrate, at.layout.guide_vertices(), params,
                 {&s.rest, &s.vertex_count, &s.pose, &s.acceleration, &s.position, &s.position_prev,
                  &s.position_prev2});
}

void TressFx::shock(Schedule& schedule, const StepInput& at) const {
    const Params& p = at.params;
    const State& s = at.state;
    if (!has_shock(p))
        return;
    schedule.add(PLAIT_STAGE_strand_data, at.layout.guides,
                 plait_strand_data_params{at.layout.row, p.tressfx.vsp_coeff,
                                          p.tressfx.vsp_accel_threshold,
                                          of_kernels(p.tressfx.shock_form)},
                 {&s.position, &s.position_prev, &s.position_prev2, &strand_motion_});
    schedule.add(PLAIT_STAGE_velocity_shock, at.layout.guide_vertices(),
                 plait_layout_params{at.layout.row},
                 {&s.vertex_count, &strand_motion_, &s.position, &s.position_prev});
}

void wind(Schedule& schedule, const StepInput& at) {
    const Params& p = at.params;
    const State& s = at.state;
    if (!has_wind(p))
        return;
    plait_tressfx_wind_params params{};
    params.vertex_stride = at.layout.row;
    params.h = at.h;
    params.form = of_kernels(p.tressfx.wind_form);
    params.drag = p.tressfx.air_drag;
    for (size_t i = 0; i < 3; ++i)
        params.wind[i] = p.tressfx.wind[i];
    if (p.tressfx.wind_form == PLAIT_WIND_FORM_PUBLISHED)
        wind_cone(p.tressfx.wind, p.tressfx.wind_cone, params.corner);
    schedule.add(PLAIT_STAGE_tressfx_wind, at.layout.guides, params,
                 {&s.vertex_count, &s.position_prev, &s.position}, at.layout.row);
}

void length(Schedule& schedule, const StepInput& at) {
    const State& s = at.state;
    if (at.params.tressfx.length_iterations > 0)
        schedule.add(PLAIT_STAGE_length, at.layout.guides,
                     plait_length_params{at.layout.row, at.params.tressfx.length_iterations},
                     {&s.rest_length, &s.vertex_count, &s.position}, at.layout.row);
}

void collide(Schedule& schedule, const StepInput& at) {
    const State& s = at.state;
    if (at.bodies.solids.count > 0)
        schedule.add(PLAIT_STAGE_tressfx_collide, at.layout.guide_vertices(),
                     plait_tressfx_collide_params{at.layout.row, at.bodies.solids.count,
                                                  at.bodies.solids.first},
                     {&s.vertex_count, &at.bodies.solids.buffer, &s.position_prev, &s.position});
}

void clamp(Schedule& schedule, const StepInput& at) {
    const State& s = at.state;
    if (at.params.tressfx.max_displacement < off)
        schedule.add(PLAIT_STAGE_clamp, at.layout.guide_vertices(),
                     plait_clamp_params{at.layout.row, at.params.tressfx.max_displacement},
                     {&s.position_prev, &s.position});
}

void TressFx::reset(Schedule& schedule, const StepInput& at) {
    const State& s = at.state;
    schedule.add(PLAIT_STAGE_tressfx_reset, layout_.guide_vertices(),
                 plait_layout_params{layout_.row},
                 {&s.rest, &s.pose, &s.position, &s.position_prev, &s.position_prev2});
}

void TressFx::teleport(Schedule& schedule, const StepInput& at, const Buffer& pose) {
    const State& s = at.state;
    schedule.add(PLAIT_STAGE_tressfx_teleport, layout_.guide_vertices(),
                 plait_layout_params{layout_.row},
                 {&s.pose, &pose, &s.position, &s.position_prev, &s.position_prev2});
}

void TressFx::set_off(Schedule& schedule, const StepInput& at, const Buffer& before,
                      const Buffer& was, const Buffer& next, float jump) {
    const State& s = at.state;
    schedule.add(PLAIT_STAGE_tressfx_set_off, layout_.guide_vertices(),
                 plait_set_off_params{layout_.row, 1, layout_.row, 1, at.h, jump},
                 {&s.rest, &before, &was, &s.pose, &next, &s.position_prev, &s.position_prev2});
}

void TressFx::carry(Schedule& schedule, const StepInput& at, const plait_pose& motion) {
    const State& s = at.state;
    schedule.add(PLAIT_STAGE_tressfx_carry, layout_.guide_vertices(),
                 carry_params(motion, layout_.row, 1, true),
                 {&s.position, &s.position_prev, &s.position_prev2});
}

void TressFx::substep(Schedule& schedule, const StepInput& at, const FillDoors&) {
    if (at.params.tressfx.order == PLAIT_STAGE_ORDER_SHOCK_BEFORE_GLOBAL) {
        integrate(schedule, at, 0);
        shock(schedule, at);
        global_shape(schedule, at);
    } else {
        integrate(schedule, at,
                  has_global_shape(at.params) ? at.params.tressfx.global_stiffness : 0);
        shock(schedule, at);
    }
    local_shape(schedule, at);
    wind(schedule, at);
    length(schedule, at);
    attach(schedule, at);
    collide(schedule, at);
    clamp(schedule, at);
}

} // namespace

std::unique_ptr<Model> make_tressfx_model(const Layout& layout) {
    return std::make_unique<TressFx>(layout);
}

} // namespace plait
