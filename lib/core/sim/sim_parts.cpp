// How a sim is made: everything that may fail, before there is a Sim.
#include "base/format.hpp"
#include "core/base/clock.hpp"
#include "core/base/polyline.hpp"
#include "core/base/units.hpp"
#include "core/follows/bind.hpp"
#include "core/sim/sim.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace plait {
namespace {

Status check_follows(const Groom& groom, const plait_sim_desc& desc, const FollowMap* follows) {
    if (!follows)
        return {};
    if (desc.follows_per_guide > 0)
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("follows_per_guide is %u and follow_map is given, give one",
                            desc.follows_per_guide)};
    if (follows->guide_count != groom.shape.strands)
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("follow_map is of %u guides, the groom has %llu strands",
                            follows->guide_count,
                            static_cast<unsigned long long>(groom.shape.strands))};
    return check_bound(*follows, groom.strands.positions, groom.strands.vertex_counts,
                       "desc->follow_map, guides_bound");
}

uint32_t row_of(const Groom& groom, const FollowMap* follows) {
    return std::max(groom.shape.max_vertices, follows ? follows->max_vertices : 0);
}

Status check_size(const Context& context, const Groom& groom, const plait_sim_desc& desc,
                  const FollowMap* follows) {
    const double strands = double(groom.shape.strands) * (1 + desc.follows_per_guide) +
                           (follows ? double(follows->count()) : 0);
    const uint32_t row = row_of(groom, follows);
    if (strands * row > std::numeric_limits<uint32_t>::max())
        return Error{
            PLAIT_INVALID_ARGUMENT,
            format("%g strands of %u vertices are more than 2^32 - 1 vertices", strands, row)};
    if (desc.model == PLAIT_MODEL_TRESSFX && row > context.info.max_group_size)
        return Error{PLAIT_UNSUPPORTED,
                     format("strands have up to %u vertices, device %s takes %u work-items in a "
                            "work-group",
                            row, context.info.name, context.info.max_group_size)};
    return {};
}

Layout make_layout(const Groom& groom, const plait_sim_desc& desc, const FollowMap* follows) {
    const auto guides = static_cast<uint32_t>(groom.shape.strands);
    const auto count =
        follows ? static_cast<uint32_t>(follows->count()) : guides * desc.follows_per_guide;
    return {guides, count, row_of(groom, follows)};
}

float longest_segment_of(const Groom& groom) {
    double longest = 0;
    const float* p = groom.strands.positions.data();
    for (const uint32_t count : groom.strands.vertex_counts) {
        for (uint32_t i = 0; i + 1 < count; ++i, p += 3)
            longest = std::max(longest, distance({p[0], p[1], p[2]}, {p[3], p[4], p[5]}));
        p += 3;
    }
    return static_cast<float>(longest);
}

StrandLengths lengths_of(const Groom& groom) {
    constexpr double most = 1e6; // m, beyond which sums of millions would overflow
    StrandLengths lengths{static_cast<float>(groom.shape.mean_length), 0};
    const float* p = groom.strands.positions.data();
    for (const uint32_t count : groom.strands.vertex_counts) {
        double length = 0;
        for (uint32_t i = 0; i + 1 < count; ++i, p += 3)
            length += distance({p[0], p[1], p[2]}, {p[3], p[4], p[5]});
        p += 3;
        lengths.sum += std::llround(std::ldexp(std::min(length, most), 20));
    }
    return lengths;
}

// A hair's diameter where the groom says nothing.
HairSizes hair_sizes(const Groom& groom, const Layout& layout) {
    double sum = 0, count = 0;
    for (const float d : groom.strands.thickness) {
        sum += is_hair_diameter(d) ? double(d) : 0;
        count += is_hair_diameter(d);
    }
    const double vertices = double(groom.shape.vertices) / double(groom.shape.strands);
    return {count > 0 ? static_cast<float>(sum / count) : 70e-6f,
            static_cast<float>(groom.shape.mean_length / vertices),
            static_cast<float>(double(layout.strands()) / double(layout.guides))};
}

// Of all strands, after which those that are stepped or shown may end; empty: all are.
std::pmr::vector<uint32_t> ends_of(const StrandInput& strands, std::pmr::memory_resource* memory) {
    return strands.levels ? strands.levels->ends() : std::pmr::vector<uint32_t>(memory);
}

} // namespace

Result<SimParts> make_sim_parts(Context& context, const Groom& groom, const plait_sim_desc& desc,
                                const StrandInput& strands) {
    PLAIT_TRY(check_follows(groom, desc, strands.follows));
    PLAIT_TRY(check_size(context, groom, desc, strands.follows));
    const Layout layout = make_layout(groom, desc, strands.follows);
    Device& device = context.device;
    const auto ends = ends_of(strands, &context.memory);
    std::span<const uint32_t> guide_ends = ends;
    while (!guide_ends.empty() && guide_ends.back() > layout.guides)
        guide_ends = guide_ends.first(guide_ends.size() - 1);
    auto model = make_model(desc.model, {desc.substeps},
                            {layout, groom, strands.stiffness, strands.materials, context.info.tile,
                             Clock(desc.step, 1).step(), desc.sag_free,
                             std::to_array(desc.params.gravity), &context.memory, guide_ends});
    if (!model)
        return model.error();
    Params params = default_params(); // every feature is off
    static_cast<plait_sim_params&>(params) = desc.params;
    PLAIT_TRY(check_params(params));
    PLAIT_TRY((*model)->prepare(device, params));
    (*model)->swap();
    (*model)->discard();
    const bool interpolate = desc.interpolate_output == 1;
    std::span<const uint32_t> follow_counts;
    if (strands.follows)
        follow_counts = strands.follows->strands.vertex_counts;
    const StateNeeds needs{interpolate || strands.levels ? layout.guides : layout.strands(),
                           (*model)->pinned_vertices(), (*model)->keeps_two_steps(), follow_counts};
    auto state = create_state(device, groom, layout, needs, &context.memory);
    if (!state)
        return state.error();
    auto skin = Skin::create(device, groom);
    if (!skin)
        return skin.error();
    const FollowTurns::Rules turns{(*model)->pinned_vertices(), context.info.tile, ends};
    auto display = Display::create(
        device, groom, layout,
        {desc.follows_per_guide, desc.follow_radius, desc.seed, strands.follows, turns},
        {interpolate, desc.keep_last_frame != 0, strands.levels != nullptr}, &context.memory);
    if (!display)
        return display.error();
    std::unique_ptr<SimLevels> levels;
    if (strands.levels) {
        auto made = SimLevels::create(device, *strands.levels, strands.level_top, *strands.follows,
                                      layout, turns, &context.memory);
        if (!made)
            return made.error();
        levels = std::move(*made);
    }
    return SimParts{layout,
                    desc,
                    params,
                    strands.materials,
                    size_warning(groom.shape.mean_length, groom.shape.extent()),
                    hair_sizes(groom, layout),
                    groom_warning(groom),
                    fingerprint(groom),
                    cube_around(groom.shape.bounds_min, groom.shape.bounds_max),
                    longest_segment_of(groom),
                    lengths_of(groom),
                    std::move(*skin),
                    std::move(*model),
                    std::move(*state),
                    std::move(*display),
                    std::move(levels)};
}

} // namespace plait
