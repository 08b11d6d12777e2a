#include "core/strands/lane_part.hpp"

#include "core/groom/groom.hpp"

#include <algorithm>
#include <cmath>

namespace plait {
namespace {

Ramp ramp_of(const float (&knots)[4]) {
    return {{double(knots[0]), double(knots[1]), double(knots[2]), double(knots[3])}};
}

} // namespace

LaneSource::LaneSource(const ModelInput& input)
    : layout(input.layout), tile(input.tile), step(input.step), sag_free(input.sag_free),
      gravity(input.gravity),
      memory(input.memory), strands{{input.groom.strands.positions, input.memory},
                                    {input.groom.strands.vertex_counts, input.memory},
                                    {input.stiffness.begin(), input.stiffness.end(), input.memory}},
      materials(input.materials),
      cube(cube_around(input.groom.shape.bounds_min, input.groom.shape.bounds_max)),
      rest(input.memory) {}

RestGrid LaneSource::rest_grid_of(const Params& params) const {
    if (!params.volume.on)
        return {};
    const bool own = params.grid.edge > 0;
    RestGrid grid{params.grid.edge_count, own ? params.grid.edge : cube.edge, {}};
    std::copy_n(own ? params.grid.origin : cube.origin, 3, grid.origin.begin());
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
    : source_(source), settings_(settings),
      members_(std::move(members)), lanes_{static_cast<uint32_t>(members_.size()), row,
                                           source.tile},
      stepped_(lanes_.strands), fill_(source.memory), next_fill_(source.memory) {}

Status LanePart::make(Device& device, Buffer& to, size_t components, const char* name) const {
    return device.create(to, PLAIT_ELEMENT_FLOAT, lanes_.rows() * components, name);
}

Status LanePart::open(Device& device) {
    PLAIT_TRY(make(device, v_, 3, "lane_v"));
    PLAIT_TRY(make(device, q_, 4, "lane_q"));
    PLAIT_TRY(make(device, q_before_, 4, "lane_q_before"));
    PLAIT_TRY(make(device, x_, 3, "lane_x"));
    PLAIT_TRY(make(device, normal_force_, 1, "lane_normal_force"));
    PLAIT_TRY(open_doors(device));
    std::pmr::vector<uint32_t> strands(source_.memory);
    for (size_t lane = 0; lane < lanes_.padded_strands(); ++lane)
        strands.push_back(member(lane));
    PLAIT_TRY(device.create(lane_strand_, PLAIT_ELEMENT_UINT, strands.size(), "lane_strand"));
    return device.write(lane_strand_, strands.data());
}

Status LanePart::open_doors(Device& device) {
    const PartNeeds& needs = source_.needs;
    if (!push_ && needs.push)
        PLAIT_TRY(make(device, push_, 3, "lane_push"));
    if (!spring_ && (needs.spring || fill_.groom || next_fill_.groom))
        PLAIT_TRY(make(device, spring_, 4, "lane_spring"));
    if (!plane_ && needs.plane)
        PLAIT_TRY(make(device, plane_, PLAIT_LANE_PLANE_COMPONENTS, "lane_plane"));
    if (!hollow_ && needs.hollow)
        PLAIT_TRY(make(device, hollow_, PLAIT_LANE_HOLLOW_COMPONENTS, "lane_hollow"));
    if (!fill_.wet && fill_.material && needs.wet)
        PLAIT_TRY(make_wet(device, fill_));
    return {};
}

void LanePart::close_doors() {
    const PartNeeds& needs = source_.needs;
    if (!needs.push)
        push_ = {};
    if (!needs.spring && !fill_.groom && !next_fill_.groom)
        spring_ = {};
    if (!needs.plane)
        plane_ = {};
    if (!needs.hollow)
        hollow_ = {};
    if (!needs.wet)
        fill_.wet = {};
}

Materials LanePart::materials() const {
    Materials all{std::pmr::vector<Material>(source_.memory), source_.materials};
    for (const plait_material& m : source_.materials->table)
        all.list.push_back({m.line_density, m.bend_stiffness, m.stretch_stiffness,
                            m.twist_stiffness, m.section_ratio, m.curl, m.clamp_stiffness,
                            m.drag_scale, m.friction_scale, ramp_of(m.stiffness_ramp),
                            ramp_of(m.density_ramp), m.groom_stiffness, ramp_of(m.groom_ramp)});
    return all;
}

// Gravity that changes is felt: the load stays that of the balance until that is sought anew.
RestLoad LanePart::load() const {
    if (source_.sag_free == PLAIT_SAG_FREE_OFF)
        return {};
    return {source_.sag_free, source_.gravity};
}

// Buffers for `members`.
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
    if (source_.needs.wet)
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

// At creation, where the state is not filled yet, reset fills both.
Status LanePart::prepare_history(Device& device, const Params& params) {
    const bool needed = settings_.bdf2_of(params) != 0;
    has_next_history_ = bool(history_.x) != needed;
    if (!has_next_history_ || !needed)
        return {};
    PLAIT_TRY(make(device, next_history_.x, 3, "lane_x_before"));
    PLAIT_TRY(make(device, next_history_.v, 3, "lane_v_before"));
    return fill_history(device, next_history_);
}

// As if strands had moved as they move now: x - h v, relative to the root, whose own are row 0.
Status LanePart::fill_history(Device& device, const History& history) const {
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
    PLAIT_TRY(device.write(history.x, x.data()));
    return device.write(history.v, v.data());
}

Status LanePart::begin_history(Device& device, const Params& then) const {
    return history_.x && !settings_.bdf2_of(then) ? fill_history(device, history_) : Status{};
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

Status LanePart::prepare_volume(Device& device, const Params& params) {
    const RestGrid grid = source_.rest_grid_of(params);
    has_next_volume_ = grid != volume_.grid;
    return has_next_volume_ ? make_pressed(device, next_volume_, grid) : Status{};
}

// The groom stays the shape in which strands are; what changes is what holds them in it.
Status LanePart::prepare(Device& device, const Params& params) {
    const Materials materials = this->materials();
    const RestLoad load = this->load();
    const bool grooms = fill_.groom || params.groom > 0 || materials.holds();
    has_next_fill_ = !(fill_.material && materials == fill_.of && load == fill_.load &&
                       grooms == bool(fill_.groom));
    if (has_next_fill_)
        PLAIT_TRY(make_fill(device, next_fill_, members_, materials, load, grooms));
    PLAIT_TRY(open_doors(device));
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
    close_doors(); // what nothing that was taken needs
}

} // namespace plait
