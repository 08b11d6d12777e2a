#include "core/strands/lane_part.hpp"

#include "core/groom/groom.hpp"

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

// Pins. Under 10 g of the whole strand a held vertex is off by a hundredth of a segment, and by
// less in short substeps, where that is a soft spring, and the rest of what bounces is gone in a
// few.
constexpr float pin_hold = 1e4f;       // m/s^2
constexpr float steps_of_pin = 100.0f; // least rate, 1/h^2
constexpr float pin_pull = 300.0f;     // m/s^2: with 30 times its strand's weight at most

// The slider `groom` in times of the spring that leaves half of a droop. Two springs side by side would
// ask for g/(1 - g); of limp hair, which swings out of the way, the power of .6 of it: between them. At
// 1 a ten-thousandth is left.
float groom_slider(float groom) {
    constexpr float power = 0.8f, least = 1e-5f;
    return std::pow(groom / std::max(1 - groom, least), power);
}

Ramp ramp_of(const float (&knots)[4]) {
    return {{double(knots[0]), double(knots[1]), double(knots[2]), double(knots[3])}};
}

// Held hair creeps by so much in a substep, m; below a millionth of its length is rounding.
float contact_slip(float h, float length) {
    return length * std::max(contact_creep * h, rounding);
}

} // namespace

LaneSource::LaneSource(const ModelInput& input)
    : layout(input.layout), tile(input.tile), step(input.step), sag_free(input.sag_free),
      gravity(input.gravity), accelerates(input.accelerates), pins(input.pins),
      memory(input.memory), strands{{input.groom.strands.positions, input.memory},
                                    {input.groom.strands.vertex_counts, input.memory},
                                    {input.stiffness.begin(), input.stiffness.end(), input.memory}},
      materials(input.materials), cube(cube_around(input.groom)), rest(input.memory) {}

RestGrid LaneSource::rest_grid_of(const plait_sim_params& params) const {
    if (params.volume == PLAIT_VOLUME_OFF)
        return {};
    const bool own = params.grid_edge > 0;
    RestGrid grid{params.grid_edge_count, own ? params.grid_edge : cube.edge, {}};
    std::copy_n(own ? params.grid_origin : cube.origin, 3, grid.origin.begin());
    return grid;
}

void LaneSource::measure_rest(const RestGrid& grid) {
    if (grid == rest_grid)
        return;
    rest = grid.edge_count == 0
               ? RestDensity(memory)
               : measure_rest_density(strands.positions, strands.counts, grid, memory);
    rest_grid = grid;
}

LanePart::LanePart(const LaneSource& source, const Settings& settings, uint32_t row,
                   Members members)
    : source_(source), settings_(settings), traits_(traits_of(settings.model)),
      members_(std::move(members)), lanes_{static_cast<uint32_t>(members_.size()), row,
                                           source.tile},
      fill_(source.memory), next_fill_(source.memory) {}

Status LanePart::make(Device& device, Buffer& to, size_t components, const char* name) const {
    return device.create(to, PLAIT_ELEMENT_FLOAT, lanes_.rows() * components, name);
}

Status LanePart::open(Device& device) {
    PLAIT_TRY(make(device, v_, 3, "lane_v"));
    PLAIT_TRY(make(device, q_, 4, "lane_q"));
    PLAIT_TRY(make(device, q_before_, 4, "lane_q_before"));
    PLAIT_TRY(make(device, x_, 3, "lane_x"));
    PLAIT_TRY(open_forces(device));
    PLAIT_TRY(keep_planes(device, source_.planes));
    std::pmr::vector<uint32_t> strands(source_.memory);
    for (size_t lane = 0; lane < lanes_.padded_strands(); ++lane)
        strands.push_back(member(lane));
    PLAIT_TRY(device.create(lane_strand_, PLAIT_ELEMENT_UINT, strands.size(), "lane_strand"));
    return device.write(lane_strand_, strands.data());
}

Status LanePart::open_forces(Device& device) {
    if (!acceleration_ && (source_.accelerates || source_.wind))
        PLAIT_TRY(make(device, acceleration_, 3, "lane_acceleration"));
    if (!spring_ && (source_.pins || source_.wind || fill_.groom || next_fill_.groom))
        PLAIT_TRY(make(device, spring_, 4, "lane_spring"));
    return {};
}

void LanePart::close_forces() {
    if (!source_.accelerates && !source_.wind)
        acceleration_ = {};
    if (!source_.pins && !source_.wind && !fill_.groom)
        spring_ = {};
}

Status LanePart::keep_planes(Device& device, bool keep) {
    if (!keep)
        plane_ = {};
    else if (!plane_)
        PLAIT_TRY(make(device, plane_, PLAIT_LANE_PLANE_COMPONENTS, "lane_plane"));
    return {};
}

Materials LanePart::materials_of(const plait_sim_params& params) const {
    Materials all{std::pmr::vector<Material>(source_.memory), source_.materials};
    const auto add = [&](const auto& of, float curl, float clamp, float drag, float friction,
                         const Ramp& stiffness, const Ramp& density, float groom,
                         const Ramp& groom_ramp) {
        all.list.push_back({of.line_density, of.bend_stiffness, of.stretch_stiffness,
                            traits_.bends ? of.twist_stiffness : 0.0f,
                            traits_.flat ? of.section_ratio : 1.0f, curl, clamp, drag, friction,
                            stiffness, density, groom, groom_ramp, !traits_.halves_tip,
                            !traits_.stretches});
    };
    add(params, 1, 1, 1, 1, Ramp::to_tip(double(params.tip_stiffness)),
        Ramp::to_tip(double(params.tip_density)), 0, {});
    if (source_.materials)
        for (const plait_material& m : source_.materials->table)
            add(m, m.curl, m.clamp_stiffness, m.drag_scale, m.friction_scale,
                ramp_of(m.stiffness_ramp), ramp_of(m.density_ramp), m.groom_stiffness,
                ramp_of(m.groom_ramp));
    return all;
}

// Gravity that changes is felt: the load stays that of the balance until that is sought anew.
RestLoad LanePart::load() const {
    if (source_.sag_free == PLAIT_SAG_FREE_OFF || !traits_.bends)
        return {};
    return {source_.sag_free, source_.gravity};
}

// Buffers for `members`, strands of this model.
Status LanePart::make_fill(Device& device, Fill& fill, const Members& members,
                           const Materials& materials, const RestLoad& load, bool grooms) const {
    const LaneLayout lanes{static_cast<uint32_t>(members.size()), lanes_.row, lanes_.tile};
    const LaneRows rows =
        lane_rows(source_.strands, members, lanes, materials, load, grooms, source_.memory);
    const auto put = [&](Buffer& to, const std::pmr::vector<float>& values,
                         const char* name) -> Status {
        PLAIT_TRY(device.create(to, PLAIT_ELEMENT_FLOAT, values.size(), name));
        return device.write(to, values.data());
    };
    PLAIT_TRY(put(fill.material, rows.material, "lane_material"));
    PLAIT_TRY(put(fill.rest, rows.rest, "lane_rest"));
    if (!rows.start.empty())
        PLAIT_TRY(put(fill.start, rows.start, "lane_start"));
    if (grooms)
        PLAIT_TRY(put(fill.groom, rows.groom, "lane_groom"));
    if (source_.wet)
        PLAIT_TRY(make_wet(device, fill));
    fill.of = materials;
    fill.load = load;
    fill.sag = rows.sag;
    return {};
}

// Rows that no strand's wetness agrees with, so that the next soak() writes all of them.
Status LanePart::make_wet(Device& device, Fill& fill) const {
    const std::pmr::vector<float> unknown(fill.material.count(), -1.0f, source_.memory);
    PLAIT_TRY(device.create(fill.wet, PLAIT_ELEMENT_FLOAT, unknown.size(), "lane_material"));
    return device.write(fill.wet, unknown.data());
}

void LanePart::soak(Schedule& schedule, const Substep& at) const {
    schedule.add(PLAIT_STAGE_lane_wetness, lanes_.strands,
                 plait_lane_wetness_params{lanes_.row, lanes_.tile},
                 {&lane_strand_, &at.state.wetness_held, &fill_.material, &fill_.wet}, lanes_.row);
}

// As if strands had moved as they move now: x - h v, relative to the root, whose own are row 0. At
// creation, where the state is not filled yet, reset fills both.
Status LanePart::prepare_history(Device& device, const plait_sim_params& params) {
    const bool needed = settings_.bdf2_of(params) != 0;
    has_next_history_ = bool(history_.x) != needed;
    if (!has_next_history_ || !needed)
        return {};
    PLAIT_TRY(make(device, next_history_.x, 3, "lane_x_before"));
    PLAIT_TRY(make(device, next_history_.v, 3, "lane_v_before"));
    std::pmr::vector<float> x(x_.count(), source_.memory), v(v_.count(), source_.memory);
    PLAIT_TRY(device.read(x_, x.data()));
    PLAIT_TRY(device.read(v_, v.data()));
    const auto h = static_cast<float>(source_.step / settings_.substeps);
    for (size_t lane = 0; lane < lanes_.padded_strands(); ++lane)
        for (size_t component = 0; component < 3; ++component) {
            const float root = v[lanes_.index(lane, 0, component, 3)];
            for (size_t row = 0; row < lanes_.row; ++row) {
                const size_t i = lanes_.index(lane, row, component, 3);
                x[i] -= h * (row > 0 ? v[i] - root : root);
            }
        }
    PLAIT_TRY(device.write(next_history_.x, x.data()));
    return device.write(next_history_.v, v.data());
}

// Lanes past the last strand repeat it, as lane_strand has them; rows past a tip hold no hair.
Status LanePart::make_pressed(Device& device, Pressed& to, const RestGrid& grid) const {
    to.grid = grid;
    if (grid.edge_count == 0)
        return {};
    std::pmr::vector<size_t> first(source_.memory);
    size_t vertices = 0;
    for (const uint32_t count : source_.strands.counts) {
        first.push_back(vertices);
        vertices += count;
    }
    constexpr size_t components = PLAIT_LANE_SHARE_COMPONENTS;
    std::pmr::vector<float> shares(lanes_.rows() * components, 0.0f, source_.memory);
    for (size_t lane = 0; lane < lanes_.padded_strands(); ++lane) {
        const uint32_t strand = member(lane);
        for (size_t i = 0; i < source_.strands.counts[strand]; ++i) {
            const size_t vertex = first[strand] + i;
            shares[lanes_.index(lane, i, PLAIT_LANE_SHARE_HAIR, components)] =
                source_.rest.hair[vertex];
            shares[lanes_.index(lane, i, PLAIT_LANE_SHARE_REST, components)] =
                source_.rest.density[vertex];
        }
    }
    PLAIT_TRY(make(device, to.share, components, "lane_share"));
    PLAIT_TRY(device.write(to.share, shares.data()));
    PLAIT_TRY(make(device, to.pressure, 3, "lane_pressure"));
    shares.assign(to.pressure.count(), 0.0f);
    return device.write(to.pressure, shares.data());
}

Status LanePart::prepare_volume(Device& device, const plait_sim_params& params) {
    const RestGrid grid = source_.rest_grid_of(params);
    has_next_volume_ = grid != volume_.grid;
    return has_next_volume_ ? make_pressed(device, next_volume_, grid) : Status{};
}

// The groom stays the shape in which strands are; what changes is what holds them in it.
Status LanePart::prepare(Device& device, const plait_sim_params& params) {
    const Materials materials = materials_of(params);
    const RestLoad load = this->load();
    const bool grooms = fill_.groom || params.groom > 0 || materials.holds();
    has_next_fill_ = !(fill_.material && materials == fill_.of && load == fill_.load &&
                       grooms == bool(fill_.groom));
    if (has_next_fill_)
        PLAIT_TRY(make_fill(device, next_fill_, members_, materials, load, grooms));
    PLAIT_TRY(open_forces(device));
    PLAIT_TRY(prepare_volume(device, params));
    return prepare_history(device, params);
}

void LanePart::swap() noexcept {
    if (has_next_fill_)
        std::swap(fill_, next_fill_);
    if (has_next_history_)
        std::swap(history_, next_history_);
    if (has_next_volume_)
        std::swap(volume_, next_volume_);
}

void LanePart::discard() {
    next_fill_ = Fill(source_.memory);
    next_history_ = {};
    next_volume_ = {};
    has_next_fill_ = has_next_history_ = has_next_volume_ = false;
    close_forces(); // what nothing that was taken needs
}

// With wind lane_air does.
void LanePart::accelerate(Schedule& schedule, const Substep& at) const {
    if (source_.accelerates && !at.wind)
        schedule.add(PLAIT_STAGE_lane_accelerate, lanes_.strands,
                     plait_lane_tile_params{lanes_.row, lanes_.tile, source_.layout.row,
                                            volume_.pressure ? 1u : 0u},
                     {&lane_strand_, &at.state.vertex_count, &at.state.acceleration,
                      &volume_.pressure, &acceleration_},
                     lanes_.row);
}

void LanePart::pin(Schedule& schedule, const Substep& at) const {
    const float step = step_of(at.h, settings_.bdf2_of(at.params));
    schedule.add(PLAIT_STAGE_lane_pin, lanes_.strands,
                 plait_lane_pin_params{lanes_.row, lanes_.tile, source_.layout.row, at.share,
                                       pin_hold, steps_of_pin / (step * step), at.h, pin_pull},
                 {&lane_strand_, &at.state.vertex_count, &at.state.rest, &at.state.pose,
                  &material(), &at.state.pin_from, &at.state.pin_to, &x_, &v_, &spring_},
                 lanes_.row);
}

bool LanePart::holds(const plait_sim_params& params) const {
    return fill_.groom && (params.groom > 0 || fill_.of.holds());
}

// Beside the pins.
void LanePart::hold(Schedule& schedule, const Substep& at) const {
    const float step = step_of(at.h, settings_.bdf2_of(at.params));
    schedule.add(PLAIT_STAGE_lane_groom, lanes_.strands,
                 plait_lane_groom_params{lanes_.row, lanes_.tile, source_.layout.row,
                                         source_.pins ? 1u : 0u, groom_slider(at.params.groom),
                                         at.h, steps_of_pin / (step * step), pin_pull},
                 {&lane_strand_, &at.state.vertex_count, &at.state.rest, &at.state.pose,
                  &material(), &fill_.groom, &x_, &v_, &spring_},
                 lanes_.row);
}

void LanePart::blow(Schedule& schedule, const Substep& at, const WindStep& wind) const {
    plait_lane_air_params params{};
    params.vertex_stride = lanes_.row;
    params.tile = lanes_.tile;
    params.row_stride = source_.layout.row;
    params.h = at.h;
    params.bdf2 = settings_.bdf2_of(at.params);
    params.pins = source_.pins || holds(at.params) ? 1 : 0;
    params.accelerates = source_.accelerates ? 1 : 0;
    params.pressure = volume_.pressure ? 1 : 0;
    params.equal_masses = traits_.halves_tip ? 0 : 1;
    params.drag = wind.drag;
    params.viscous = wind.viscous;
    params.tangential = wind.tangential;
    std::ranges::copy(wind.air, params.air);
    std::ranges::copy(wind.jump, params.jump);
    params.field = wind.velocity ? 1 : 0;
    params.edge_count = wind.nodes;
    params.voxel_edge = wind.voxel_edge;
    std::ranges::copy(wind.q, params.q);
    std::ranges::copy(wind.t, params.t);
    schedule.add(PLAIT_STAGE_lane_air, lanes_.strands, params,
                 {&lane_strand_, &at.state.vertex_count, &at.state.rest, &at.state.pose,
                  &at.state.acceleration, wind.velocity, &material(), &x_, &v_, &history_.x,
                  &history_.v, &volume_.pressure, &acceleration_, &spring_},
                 lanes_.row);
}

// `solve`: what the solve after it is told.
void LanePart::find_planes(Schedule& schedule, const Substep& at,
                           const plait_lane_params& solve) const {
    plait_lane_params params = solve;
    params.collider_first = at.collider_first + at.collider_count;
    params.collider_count = at.mesh_count;
    schedule.add(PLAIT_STAGE_mesh_contact, lanes_.strands, params,
                 {&lane_strand_, &at.state.rest, &at.state.pose, &material(), &at.colliders,
                  &at.meshes->grid, &at.meshes->nodes, &at.meshes->values, &at.meshes->clearance,
                  &push(), &spring_, &x_, &v_, &history_.x, &history_.v, &plane_},
                 lanes_.row);
}

// After it: what it has found is met, too.
void LanePart::find_nearest(Schedule& schedule, const Substep& at,
                            const plait_lane_params& solve) const {
    plait_lane_params params = solve;
    params.collider_first = at.collider_first + at.collider_count + at.mesh_count;
    params.collider_count = at.bending_count;
    params.planes = at.meshes ? 1 : 0;
    const BendingBuffers& m = *at.bending;
    schedule.add(
        PLAIT_STAGE_mesh_nearest, lanes_.strands, params,
        {&lane_strand_, &at.state.rest, &at.state.pose, &material(), &at.colliders, &m.first,
         &m.box,        &m.tree,        &m.triangle,    &m.ring,     &m.from,       &m.to,
         &m.bends,      &m.clearance,   &push(),        &spring_,    &x_,           &v_,
         &history_.x,   &history_.v,    &plane_,        &m.side},
        lanes_.row);
}

// After both.
void LanePart::find_strands(Schedule& schedule, const Substep& at) const {
    schedule.add(
        PLAIT_STAGE_strand_contact, lanes_.strands,
        plait_strand_contact_params{lanes_.row, lanes_.tile, source_.layout.row,
                                    at.meshes || at.bending ? 1u : 0u, at.params.strand_friction},
        {&lane_strand_, &at.state.vertex_count, &at.state.rest, &at.state.pose, &at.state.position,
         &at.state.position_prev, &at.pairs->segment, &at.pairs->offset, &x_, &plane_},
        lanes_.row);
}

void LanePart::substep(Schedule& schedule, const Substep& at, float mean_length) {
    const plait_sim_params& p = at.params;
    plait_lane_params params{};
    params.vertex_stride = lanes_.row;
    params.tile = lanes_.tile;
    params.row_stride = source_.layout.row;
    params.h = at.h;
    params.iterations = settings_.iterations_of(p);
    params.bdf2 = settings_.bdf2_of(p);
    params.drag = p.drag;
    for (size_t i = 0; i < 3; ++i) {
        params.gravity[i] = p.gravity[i];
        params.air[i] = at.air[i];
    }
    const bool meets = at.pairs && traits_.meets;
    params.collider_count = at.collider_count;
    params.collider_first = at.collider_first;
    params.contact_rate = contact_rate(p.gravity, at.h, params.bdf2, mean_length);
    params.contact_slip = contact_slip(at.h, mean_length);
    params.accelerates = push() ? 1 : 0;
    params.pins = source_.pins || at.wind || holds(p) ? 1 : 0;
    params.planes = (at.meshes || at.bending || meets) && plane_ ? (meets ? 2 : 1) : 0;
    if (source_.pins)
        pin(schedule, at);
    if (holds(p))
        hold(schedule, at);
    if (at.wind)
        blow(schedule, at, *at.wind);
    if (at.meshes && plane_)
        find_planes(schedule, at, params);
    if (at.bending && plane_)
        find_nearest(schedule, at, params);
    if (meets && plane_)
        find_strands(schedule, at);
    if (!traits_.bends)
        schedule.add(traits_.stage, lanes_.strands, params,
                     {&lane_strand_, &at.state.rest, &at.state.pose, &material(), &at.colliders,
                      &push(), &spring_, &plane_, &x_, &v_, &history_.x, &history_.v},
                     lanes_.row);
    else
        schedule.add(traits_.stage, lanes_.strands, params,
                     {&lane_strand_, &at.state.rest, &at.state.pose, &material(), &fill_.rest,
                      &at.colliders, &push(), &spring_, &plane_, &x_, &v_, &q_, &q_before_,
                      &history_.x, &history_.v},
                     lanes_.row);
}

void LanePart::publish(Schedule& schedule, const Substep& at, const Buffer* tangent) const {
    schedule.add(PLAIT_STAGE_lane_unpack, lanes_.strands,
                 plait_lane_unpack_params{lanes_.row, lanes_.tile, source_.layout.row, at.h,
                                          tangent ? 1u : 0u},
                 {&lane_strand_, &at.state.vertex_count, &x_, &v_, &at.state.position,
                  &at.state.position_prev, tangent},
                 lanes_.row);
}

void LanePart::adopt(Schedule& schedule, const Substep& at) const {
    schedule.add(PLAIT_STAGE_lane_pack, lanes_.strands * lanes_.row, history_params(at),
                 {&lane_strand_, &at.state.vertex_count, &at.state.position,
                  &at.state.position_prev, &x_, &v_, &history_.x, &history_.v});
}

plait_lane_grid_params LanePart::grid_params(const plait_grid_params& grid) const {
    plait_lane_grid_params params{};
    params.vertex_stride = lanes_.row;
    params.tile = lanes_.tile;
    params.edge_count = grid.edge_count;
    params.voxel_edge = grid.voxel_edge;
    std::ranges::copy(grid.q, params.q);
    std::ranges::copy(grid.t, params.t);
    params.tent = grid.tent;
    params.diffuse_rule = grid.diffuse_rule;
    params.diffuse_ratio = grid.diffuse_ratio;
    params.diffuse_factor = grid.diffuse_factor;
    params.diffuse_floor = grid.diffuse_floor;
    params.history = history_.v ? 1 : 0;
    return params;
}

void LanePart::splat(Schedule& schedule, const Substep& at, const LaneGrid& grid) const {
    schedule.add(PLAIT_STAGE_lane_splat, lanes_.strands, grid_params(grid.params),
                 {&lane_strand_, &at.state.vertex_count, &x_, &v_, &grid.sums, &grid.outside},
                 lanes_.row);
}

void LanePart::diffuse(Schedule& schedule, const Substep& at, const LaneGrid& grid) const {
    schedule.add(PLAIT_STAGE_lane_diffuse, lanes_.strands, grid_params(grid.params),
                 {&lane_strand_, &at.state.vertex_count, &x_, &grid.density, &grid.velocity, &v_,
                  &history_.v},
                 lanes_.row);
}

plait_lane_volume_params LanePart::volume_params(const LaneVolume& volume) const {
    plait_lane_volume_params params{};
    params.vertex_stride = lanes_.row;
    params.tile = lanes_.tile;
    params.edge_count = volume.params.edge_count;
    params.voxel_edge = volume.params.voxel_edge;
    std::ranges::copy(volume.params.q, params.q);
    std::ranges::copy(volume.params.t, params.t);
    params.moves = volume.moves ? 1 : 0;
    params.history = history_.v ? 1 : 0;
    params.wet = volume.wetness ? 1 : 0;
    params.soaked = volume.soaked ? 1 : 0;
    return params;
}

void LanePart::splat_volume(Schedule& schedule, const Substep& at, const LaneVolume& volume) const {
    schedule.add(PLAIT_STAGE_volume_splat, lanes_.strands, volume_params(volume),
                 {&lane_strand_, &at.state.vertex_count, volume.wetness, &volume_.share, &x_, &v_,
                  &volume.sums, &volume.outside},
                 lanes_.row);
}

void LanePart::gather_volume(Schedule& schedule, const Substep& at,
                             const LaneVolume& volume) const {
    schedule.add(PLAIT_STAGE_volume_gather, lanes_.strands, volume_params(volume),
                 {&lane_strand_, &at.state.vertex_count, &x_, &volume.pull, &v_, &history_.v,
                  &volume_.pressure},
                 lanes_.row);
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

void LanePart::set_off(Schedule& schedule, const Substep& at, const Buffer& before,
                       const Buffer& was, const Buffer& next, float jump) const {
    schedule.add(PLAIT_STAGE_lane_set_off, lanes_.strands,
                 plait_set_off_params{lanes_.row, lanes_.tile, source_.layout.row,
                                      history_.x ? 1u : 0u, at.h, jump},
                 {&lane_strand_, &at.state.rest, &before, &was, &at.state.pose, &next, &x_, &v_,
                  &q_before_, &history_.x, &history_.v},
                 lanes_.row);
}

void LanePart::carry(Schedule& schedule, const plait_pose& motion) const {
    schedule.add(PLAIT_STAGE_lane_carry, lanes_.strands,
                 carry_params(motion, lanes_.row, lanes_.tile, bool(history_.x)),
                 {&x_, &v_, &q_, &q_before_, &history_.x, &history_.v}, lanes_.row);
}

void LanePart::add_dynamic(std::pmr::vector<LaneBuffer>& to) const {
    const LaneBuffer state[] = {{&x_, 3, lanes_},         {&v_, 3, lanes_},
                                {&q_, 4, lanes_},         {&q_before_, 4, lanes_, true},
                                {&history_.x, 3, lanes_}, {&history_.v, 3, lanes_}};
    for (const LaneBuffer& buffer : state)
        if (*buffer.buffer)
            to.push_back(buffer);
}

uint64_t LanePart::device_bytes() const {
    uint64_t bytes = 0;
    for (const Buffer* buffer :
         {&fill_.material, &fill_.wet, &fill_.groom, &fill_.rest, &fill_.start, &x_, &v_, &q_,
          &q_before_, &history_.x, &history_.v, &acceleration_, &spring_, &plane_, &lane_strand_,
          &volume_.share, &volume_.pressure})
        bytes += buffer->bytes();
    return bytes;
}

} // namespace plait
