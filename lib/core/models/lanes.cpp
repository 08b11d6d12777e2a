// The strand models over lanes: chain, cosserat, rod. They keep their own state in the lane layout
// and publish it to position and its history, which display, the inter-hair step and interop read.
#include "core/groom.hpp"
#include "core/model.hpp"
#include "core/models/constraints.hpp"
#include "core/models/material.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace plait {
namespace {

constexpr uint32_t pinned = 1; // the root; the clamp is a joint

// Contact, in strand lengths.
constexpr float contact_stiffness = 1e5f;  // a weight sinks 1/so deep
constexpr float least_gravity = 1.0f;      // m/s^2, where there is none
constexpr float steps_of_contact = 100.0f; // least rate, 1/h^2
constexpr float contact_creep = 5e-4f;     // 1/s
constexpr float rounding = 1e-6f;

struct Solver {
    plait_stage stage;
    uint32_t iterations; // by default
    bool bends;
};

Solver solver_of(plait_model model) {
    switch (model) {
    case PLAIT_MODEL_CHAIN:
        return {PLAIT_STAGE_chain, 1, false};
    case PLAIT_MODEL_ROD:
        return {PLAIT_STAGE_rod, 1, true};
    default:
        return {PLAIT_STAGE_cosserat, 3, true};
    }
}

bool constrains(const plait_sim_params& p) {
    return has_attachment(p) ||
           (p.shape_constraints && (has_global_shape(p) || has_local_shape(p)));
}

class LaneModel final : public Model {
  public:
    LaneModel(plait_model model, const ModelInput& input)
        : solver_(solver_of(model)),
          layout_(input.layout), lanes_{input.layout.guides, input.layout.row, input.tile},
          strands_{{input.groom.strands.positions, input.memory},
                   {input.groom.strands.vertex_counts, input.memory},
                   {input.stiffness.begin(), input.stiffness.end(), input.memory}},
          sag_free_(input.sag_free), memory_(input.memory),
          length_(std::max(static_cast<float>(input.groom.shape.mean_length), 1e-6f)) {}

    uint32_t pinned_vertices() const override { return pinned; }
    Status prepare(Device& device, const plait_sim_params& params) override;
    void trim(const plait_sim_params& params) override;
    void substep(Schedule& schedule, const Substep& at) override;
    void publish(Schedule& schedule, const Substep& at) const override;
    void adopt(Schedule& schedule, const Substep& at) const override;
    void reset(Schedule& schedule, const Substep& at) override;
    void teleport(Schedule& schedule, const Substep& at, const Buffer& pose) override;
    SagReport sag() const override { return sag_; }
    std::span<const LaneBuffer> dynamic() const override { return {dynamic_.data(), kept()}; }
    uint64_t device_bytes() const override;

  private:
    Status make(Device& device, Buffer& to, size_t components, const char* name) const;
    void constrain(Schedule& schedule, const Substep& at) const;
    Status fill_material(Device& device, const plait_sim_params& params);
    Status make_history(Device& device);
    float contact_rate(const plait_sim_params& params, float h) const;
    float contact_slip(float h) const;
    size_t kept() const { return x_before_ ? dynamic_.size() : dynamic_.size() - 2; }
    plait_lane_state_params state_params() const {
        return {layout_.row, lanes_.tile, x_before_ ? 1u : 0u};
    }

    Solver solver_;
    Layout layout_;
    LaneLayout lanes_;
    RestStrands strands_; // for when the material changes
    plait_sag_free sag_free_;
    std::pmr::memory_resource* memory_;
    float length_; // m, of the mean strand
    Material filled_{};
    RestLoad filled_load_;
    SagReport sag_;
    Buffer material_, rest_, start_, x_, v_, q_, q_before_, x_before_, v_before_;
    std::array<LaneBuffer, 6> dynamic_{{{&x_, 3, lanes_},
                                        {&v_, 3, lanes_},
                                        {&q_, 4, lanes_},
                                        {&q_before_, 4, lanes_},
                                        {&x_before_, 3, lanes_},
                                        {&v_before_, 3, lanes_}}};
};

Status LaneModel::make(Device& device, Buffer& to, size_t components, const char* name) const {
    auto buffer = device.create(PLAIT_ELEMENT_FLOAT, lanes_.rows() * components, name);
    if (!buffer)
        return buffer.error();
    to = std::move(*buffer);
    return {};
}

// The groom stays the shape in which strands are; what changes is what holds them in it.
Status LaneModel::fill_material(Device& device, const plait_sim_params& params) {
    Material material{params.line_density,  params.bend_stiffness,  params.stretch_stiffness,
                      params.tip_stiffness, params.twist_stiffness, params.section_ratio,
                      !solver_.bends};
    if (solver_.stage != PLAIT_STAGE_rod)
        material.twist_stiffness = 0, material.section_ratio = 1;
    RestLoad load;
    if (sag_free_ != PLAIT_SAG_FREE_OFF)
        load = {sag_free_, {params.gravity[0], params.gravity[1], params.gravity[2]}};
    if (material == filled_ && load == filled_load_)
        return {};
    const LaneRows rows = lane_rows(strands_, lanes_, material, load, memory_);
    PLAIT_TRY(device.write(material_, rows.material.data()));
    PLAIT_TRY(device.write(rest_, rows.rest.data()));
    if (start_)
        PLAIT_TRY(device.write(start_, rows.start.data()));
    filled_ = material;
    filled_load_ = load;
    sag_ = rows.sag;
    return {};
}

// BDF2's step before, as if the strands had been where they are. At creation, where the state is
// not filled yet, reset fills both.
Status LaneModel::make_history(Device& device) {
    Buffer x, v;
    PLAIT_TRY(make(device, x, 3, "lane_x_before"));
    PLAIT_TRY(make(device, v, 3, "lane_v_before"));
    std::pmr::vector<float> state(x_.count(), memory_);
    PLAIT_TRY(device.read(x_, state.data()));
    PLAIT_TRY(device.write(x, state.data()));
    PLAIT_TRY(device.read(v_, state.data()));
    PLAIT_TRY(device.write(v, state.data()));
    x_before_ = std::move(x);
    v_before_ = std::move(v);
    return {};
}

Status LaneModel::prepare(Device& device, const plait_sim_params& params) {
    if (!x_) {
        PLAIT_TRY(make(device, material_, PLAIT_LANE_MATERIAL_COMPONENTS, "lane_material"));
        PLAIT_TRY(make(device, rest_, 4, "lane_rest"));
        if (sag_free_ != PLAIT_SAG_FREE_OFF)
            PLAIT_TRY(make(device, start_, 4, "lane_start"));
        PLAIT_TRY(make(device, v_, 3, "lane_v"));
        PLAIT_TRY(make(device, q_, 4, "lane_q"));
        PLAIT_TRY(make(device, q_before_, 4, "lane_q_before"));
        PLAIT_TRY(make(device, x_, 3, "lane_x"));
    }
    PLAIT_TRY(fill_material(device, params));
    return params.bdf2 && !x_before_ ? make_history(device) : Status{};
}

void LaneModel::trim(const plait_sim_params& params) {
    if (params.bdf2)
        return;
    x_before_ = {};
    v_before_ = {};
}

// A contact under a vertex' own weight is a hundred-thousandth of a strand deep, less than float32
// loses at a metre from the origin; in short substeps stiff enough that nothing bounces.
float LaneModel::contact_rate(const plait_sim_params& params, float h) const {
    const float g = std::hypot(params.gravity[0], params.gravity[1], params.gravity[2]);
    const float step = params.bdf2 ? h * 2.0f / 3.0f : h;
    return std::max(contact_stiffness * std::max(g, least_gravity) / length_,
                    steps_of_contact / (step * step));
}

// Held hair creeps by so much in a substep; below a millionth of its length is rounding.
float LaneModel::contact_slip(float h) const {
    return length_ * std::max(contact_creep * h, rounding);
}

void LaneModel::substep(Schedule& schedule, const Substep& at) {
    const plait_sim_params& p = at.params;
    const State& s = at.state;
    plait_lane_params params{};
    params.vertex_stride = layout_.row;
    params.tile = lanes_.tile;
    params.h = at.h;
    params.iterations =
        p.iterations == PLAIT_ITERATIONS_OF_MODEL ? solver_.iterations : p.iterations;
    params.bdf2 = p.bdf2;
    params.drag = p.drag;
    for (size_t i = 0; i < 3; ++i) {
        params.gravity[i] = p.gravity[i];
        params.air[i] = p.wind[i];
    }
    params.collider_count = at.collider_count;
    params.alpha_from = at.alpha_from;
    params.alpha_to = at.alpha_to;
    params.contact_rate = contact_rate(p, at.h);
    params.contact_slip = contact_slip(at.h);
    if (solver_.bends)
        schedule.add(solver_.stage, layout_.guides, params,
                     {&s.rest, &s.pose, &material_, &rest_, &at.capsules, &x_, &v_, &q_, &q_before_,
                      &x_before_, &v_before_},
                     layout_.row);
    else
        schedule.add(solver_.stage, layout_.guides, params,
                     {&s.rest, &s.pose, &material_, &at.capsules, &x_, &v_, &x_before_, &v_before_},
                     layout_.row);
    if (constrains(p))
        constrain(schedule, at);
}

// What artists add to the physics, on positions; velocities follow them.
void LaneModel::constrain(Schedule& schedule, const Substep& at) const {
    publish(schedule, at);
    if (at.params.shape_constraints) {
        add_global_shape(schedule, at);
        add_local_shape(schedule, at);
    }
    add_attachment(schedule, at);
    adopt(schedule, at);
}

void LaneModel::publish(Schedule& schedule, const Substep& at) const {
    schedule.add(PLAIT_STAGE_lane_unpack, layout_.guide_vertices(),
                 plait_lane_layout_params{layout_.row, lanes_.tile, at.h},
                 {&at.state.vertex_count, &x_, &v_, &at.state.position, &at.state.position_prev});
}

void LaneModel::adopt(Schedule& schedule, const Substep& at) const {
    schedule.add(PLAIT_STAGE_lane_pack, layout_.guide_vertices(),
                 plait_lane_layout_params{layout_.row, lanes_.tile, at.h},
                 {&at.state.vertex_count, &at.state.position, &at.state.position_prev, &x_, &v_});
}

void LaneModel::reset(Schedule& schedule, const Substep& at) {
    schedule.add(PLAIT_STAGE_lane_reset, layout_.guides, state_params(),
                 {&at.state.rest, &at.state.pose, start_ ? &start_ : &rest_, &x_, &v_, &q_,
                  &q_before_, &x_before_, &v_before_},
                 layout_.row);
    publish(schedule, at);
}

void LaneModel::teleport(Schedule& schedule, const Substep& at, const Buffer& pose) {
    schedule.add(
        PLAIT_STAGE_lane_teleport, layout_.guides, state_params(),
        {&at.state.rest, &at.state.pose, &pose, &x_, &v_, &q_, &q_before_, &x_before_, &v_before_},
        layout_.row);
    publish(schedule, at);
}

uint64_t LaneModel::device_bytes() const {
    uint64_t bytes = material_.bytes() + rest_.bytes() + start_.bytes();
    for (const LaneBuffer& state : dynamic_)
        bytes += state.buffer->bytes();
    return bytes;
}

} // namespace

std::unique_ptr<Model> make_lane_model(plait_model model, const ModelInput& input) {
    return std::make_unique<LaneModel>(model, input);
}

} // namespace plait
