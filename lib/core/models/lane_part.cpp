#include "core/models/lane_part.hpp"

#include "core/groom.hpp"

namespace plait {
namespace {

struct Solver {
    plait_stage stage;
    uint32_t iterations; // by default
};

Solver solver_of(plait_model model) {
    switch (model) {
    case PLAIT_MODEL_CHAIN:
        return {PLAIT_STAGE_chain, 1};
    case PLAIT_MODEL_ROD:
        return {PLAIT_STAGE_rod, 1};
    default:
        return {PLAIT_STAGE_cosserat, 3};
    }
}

} // namespace

LaneSource::LaneSource(const ModelInput& input)
    : layout(input.layout), tile(input.tile), sag_free(input.sag_free),
      memory(input.memory), strands{
                                {input.groom.strands.positions, input.memory},
                                {input.groom.strands.vertex_counts, input.memory},
                                {input.stiffness.begin(), input.stiffness.end(), input.memory}} {}

LanePart::LanePart(const LaneSource& source, plait_model model, Members members)
    : source_(source), model_(model),
      members_(std::move(members)), lanes_{static_cast<uint32_t>(members_.size()),
                                           source.layout.row, source.tile} {}

Status LanePart::make(Device& device, Buffer& to, size_t components, const char* name) const {
    return device.create(to, PLAIT_ELEMENT_FLOAT, lanes_.rows() * components, name);
}

Status LanePart::open(Device& device) {
    PLAIT_TRY(make(device, v_, 3, "lane_v"));
    PLAIT_TRY(make(device, q_, 4, "lane_q"));
    PLAIT_TRY(make(device, q_before_, 4, "lane_q_before"));
    PLAIT_TRY(make(device, x_, 3, "lane_x"));
    std::pmr::vector<uint32_t> strands(source_.memory);
    for (size_t lane = 0; lane < lanes_.padded_strands(); ++lane)
        strands.push_back(member(lane));
    PLAIT_TRY(device.create(lane_strand_, PLAIT_ELEMENT_UINT, strands.size(), "lane_strand"));
    return device.write(lane_strand_, strands.data());
}

Material LanePart::material_of(const plait_sim_params& params) const {
    Material material{params.line_density,  params.bend_stiffness,      params.stretch_stiffness,
                      params.tip_stiffness, params.tip_density,         params.twist_stiffness,
                      params.section_ratio, model_ == PLAIT_MODEL_CHAIN};
    if (model_ != PLAIT_MODEL_ROD)
        material.twist_stiffness = 0, material.section_ratio = 1;
    return material;
}

RestLoad LanePart::load_of(const plait_sim_params& params) const {
    if (source_.sag_free == PLAIT_SAG_FREE_OFF || model_ == PLAIT_MODEL_CHAIN)
        return {};
    return {source_.sag_free, {params.gravity[0], params.gravity[1], params.gravity[2]}};
}

// Buffers for `members`, strands of this model.
Status LanePart::make_fill(Device& device, Fill& fill, const Members& members,
                           const Material& material, const RestLoad& load) const {
    const LaneLayout lanes{static_cast<uint32_t>(members.size()), lanes_.row, lanes_.tile};
    const LaneRows rows =
        lane_rows(source_.strands, members, lanes, material, load, source_.memory);
    const auto put = [&](Buffer& to, const std::pmr::vector<float>& values,
                         const char* name) -> Status {
        PLAIT_TRY(device.create(to, PLAIT_ELEMENT_FLOAT, values.size(), name));
        return device.write(to, values.data());
    };
    PLAIT_TRY(put(fill.material, rows.material, "lane_material"));
    PLAIT_TRY(put(fill.rest, rows.rest, "lane_rest"));
    if (!rows.start.empty())
        PLAIT_TRY(put(fill.start, rows.start, "lane_start"));
    fill.of = material;
    fill.load = load;
    fill.sag = rows.sag;
    return {};
}

// As if the strands had been where they are. At creation, where the state is not filled yet, reset
// fills both.
Status LanePart::prepare_history(Device& device, const plait_sim_params& params) {
    has_next_history_ = bool(history_.x) != (params.bdf2 != 0);
    if (!has_next_history_ || !params.bdf2)
        return {};
    PLAIT_TRY(make(device, next_history_.x, 3, "lane_x_before"));
    PLAIT_TRY(make(device, next_history_.v, 3, "lane_v_before"));
    std::pmr::vector<float> state(x_.count(), source_.memory);
    PLAIT_TRY(device.read(x_, state.data()));
    PLAIT_TRY(device.write(next_history_.x, state.data()));
    PLAIT_TRY(device.read(v_, state.data()));
    return device.write(next_history_.v, state.data());
}

// The groom stays the shape in which strands are; what changes is what holds them in it.
Status LanePart::prepare(Device& device, const plait_sim_params& params) {
    const Material material = material_of(params);
    const RestLoad load = load_of(params);
    has_next_fill_ = !(fill_.material && material == fill_.of && load == fill_.load);
    if (has_next_fill_)
        PLAIT_TRY(make_fill(device, next_fill_, members_, material, load));
    return prepare_history(device, params);
}

void LanePart::swap() noexcept {
    if (has_next_fill_)
        std::swap(fill_, next_fill_);
    if (has_next_history_)
        std::swap(history_, next_history_);
}

void LanePart::discard() {
    next_fill_ = {};
    next_history_ = {};
    has_next_fill_ = has_next_history_ = false;
}

void LanePart::substep(Schedule& schedule, const Substep& at, const Contact& contact) {
    const plait_sim_params& p = at.params;
    const Solver solver = solver_of(model_);
    plait_lane_params params{};
    params.vertex_stride = lanes_.row;
    params.tile = lanes_.tile;
    params.h = at.h;
    params.iterations =
        p.iterations == PLAIT_ITERATIONS_OF_MODEL ? solver.iterations : p.iterations;
    params.bdf2 = p.bdf2;
    params.drag = p.drag;
    for (size_t i = 0; i < 3; ++i) {
        params.gravity[i] = p.gravity[i];
        params.air[i] = at.air[i];
    }
    params.collider_count = at.collider_count;
    params.collider_first = at.collider_first;
    params.contact_rate = contact.rate;
    params.contact_slip = contact.slip;
    if (model_ == PLAIT_MODEL_CHAIN)
        schedule.add(solver.stage, lanes_.strands, params,
                     {&lane_strand_, &at.state.rest, &at.state.pose, &fill_.material, &at.capsules,
                      &x_, &v_, &history_.x, &history_.v},
                     lanes_.row);
    else
        schedule.add(solver.stage, lanes_.strands, params,
                     {&lane_strand_, &at.state.rest, &at.state.pose, &fill_.material, &fill_.rest,
                      &at.capsules, &x_, &v_, &q_, &q_before_, &history_.x, &history_.v},
                     lanes_.row);
}

void LanePart::publish(Schedule& schedule, const Substep& at) const {
    schedule.add(PLAIT_STAGE_lane_unpack, lanes_.strands * lanes_.row, layout_params(at),
                 {&lane_strand_, &at.state.vertex_count, &x_, &v_, &at.state.position,
                  &at.state.position_prev});
}

void LanePart::adopt(Schedule& schedule, const Substep& at) const {
    schedule.add(PLAIT_STAGE_lane_pack, lanes_.strands * lanes_.row, layout_params(at),
                 {&lane_strand_, &at.state.vertex_count, &at.state.position,
                  &at.state.position_prev, &x_, &v_});
}

void LanePart::reset(Schedule& schedule, const Substep& at) {
    schedule.add(PLAIT_STAGE_lane_reset, lanes_.strands, state_params(),
                 {&lane_strand_, &at.state.rest, &at.state.pose,
                  fill_.start ? &fill_.start : &fill_.rest, &x_, &v_, &q_, &q_before_, &history_.x,
                  &history_.v},
                 lanes_.row);
}

void LanePart::teleport(Schedule& schedule, const Substep& at, const Buffer& pose) {
    schedule.add(PLAIT_STAGE_lane_teleport, lanes_.strands, state_params(),
                 {&lane_strand_, &at.state.rest, &at.state.pose, &pose, &x_, &v_, &q_, &q_before_,
                  &history_.x, &history_.v},
                 lanes_.row);
}

void LanePart::add_dynamic(std::pmr::vector<LaneBuffer>& to) const {
    const LaneBuffer state[] = {{&x_, 3, lanes_},         {&v_, 3, lanes_},
                                {&q_, 4, lanes_},         {&q_before_, 4, lanes_},
                                {&history_.x, 3, lanes_}, {&history_.v, 3, lanes_}};
    for (const LaneBuffer& buffer : state)
        if (*buffer.buffer)
            to.push_back(buffer);
}

uint64_t LanePart::device_bytes() const {
    uint64_t bytes = 0;
    for (const Buffer* buffer : {&fill_.material, &fill_.rest, &fill_.start, &x_, &v_, &q_,
                                 &q_before_, &history_.x, &history_.v, &lane_strand_})
        bytes += buffer->bytes();
    return bytes;
}

} // namespace plait
