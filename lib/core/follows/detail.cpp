#include "core/follows/detail.hpp"

#include "core/base/ranges.hpp"
#include "core/follows/root_spread.hpp"

#include <algorithm>
#include <cmath>

namespace plait {
namespace {

using Float4 = std::array<float, 4>;

bool any(const float (&ramp)[4]) {
    return std::ranges::any_of(ramp, [](float knot) { return knot != 0; });
}

Status check_ramp(const char* name, const float (&ramp)[4], double most) {
    for (size_t i = 0; i < 4; ++i)
        PLAIT_TRY(check_range(format("%s[%zu]", name, i).c_str(), double(ramp[i]), 0, most));
    return {};
}

Point vertex_of(const StrandsAtRest& strands, size_t vertex) {
    const auto p = strands.rest.subspan(4 * vertex, 3);
    return {p[0], p[1], p[2]};
}

// [strands*V]: from the root, m; past the tip as there.
std::pmr::vector<float> arcs_of(const StrandsAtRest& strands, std::pmr::memory_resource* memory) {
    const uint32_t row = strands.layout.row;
    std::pmr::vector<float> arcs(memory);
    arcs.reserve(strands.layout.vertices());
    for (size_t strand = 0; strand < strands.counts.size(); ++strand) {
        double arc = 0;
        for (size_t i = 0; i < row; ++i) {
            const size_t vertex = strand * row + i;
            if (i > 0 && i < strands.counts[strand])
                arc += distance(vertex_of(strands, vertex - 1), vertex_of(strands, vertex));
            arcs.push_back(static_cast<float>(arc));
        }
    }
    return arcs;
}

// Of the follows; the way of each is that over the first quarter of its vertices.
StrandRoots roots_of(const StrandsAtRest& strands, std::pmr::memory_resource* memory) {
    StrandRoots roots(memory);
    for (size_t strand = strands.layout.guides; strand < strands.counts.size(); ++strand) {
        const size_t root = strand * strands.layout.row;
        const size_t ahead = std::max(strands.counts[strand] / 4, 1u);
        roots.append(vertex_of(strands, root), vertex_of(strands, root + ahead));
    }
    return roots;
}

// `clumps` of the follows, spread evenly, and for each follow the nearest on its side of a parting.
std::pmr::vector<uint32_t> spread_centres(const plait_detail_desc& desc,
                                          const StrandsAtRest& strands,
                                          std::pmr::memory_resource* memory) {
    const StrandRoots roots = roots_of(strands, memory);
    const auto chosen = spread_roots(roots, desc.clumps, desc.seed, memory);
    std::pmr::vector<uint32_t> centres(memory);
    for (uint32_t follow = 0; follow < strands.layout.follows; ++follow) {
        const bool own = std::ranges::binary_search(chosen, follow); // of two at one root, too
        const uint32_t of = own ? follow : chosen[nearest_roots<1>(roots, follow, chosen)[0].index];
        centres.push_back(strands.layout.guides + of);
    }
    return centres;
}

// A centre is a guide, or a follow that is its own.
Status check_centres(std::span<const uint32_t> centres, const Layout& layout) {
    if (centres.size() != layout.follows)
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("clump_centres.count is %zu, the sim has %u follows", centres.size(),
                            layout.follows)};
    for (size_t follow = 0; follow < centres.size(); ++follow) {
        const uint32_t centre = centres[follow];
        if (centre >= layout.strands())
            return Error{PLAIT_INVALID_ARGUMENT,
                         format("clump_centres[%zu] is %u, range is [0, %u], the sim's strands",
                                follow, centre, layout.strands() - 1)};
        if (centre >= layout.guides && centres[centre - layout.guides] != centre)
            return Error{PLAIT_INVALID_ARGUMENT,
                         format("clump_centres[%zu] is %u, a strand whose own is %u: a centre that "
                                "is a follow has to be its own",
                                follow, centre, centres[centre - layout.guides])};
    }
    return {};
}

Result<std::pmr::vector<uint32_t>> centres_of(const plait_detail_desc& desc,
                                              std::span<const uint32_t> given,
                                              const StrandsAtRest& strands,
                                              std::pmr::memory_resource* memory) {
    if (desc.clumps > strands.layout.follows)
        return Error{PLAIT_INVALID_ARGUMENT, format("clumps is %u, range is [0, %u], the sim's "
                                                    "follows",
                                                    desc.clumps, strands.layout.follows)};
    if (desc.clumps > 0 && !given.empty())
        return Error{
            PLAIT_INVALID_ARGUMENT,
            format("clumps is %u, range is [0, 0] where clump_centres are given", desc.clumps)};
    if (desc.clumps > 0)
        return spread_centres(desc, strands, memory);
    if (!given.empty())
        PLAIT_TRY(check_centres(given, strands.layout));
    const auto chosen = given.empty() ? strands.guides : given;
    return std::pmr::vector<uint32_t>(chosen.begin(), chosen.end(), memory);
}

// a + t: `share` of the length is t of the way from vertex a to a + 1.
float place_on(std::span<const float> arc, double share) {
    const auto at = static_cast<float>(share * double(arc.back()));
    const auto after = std::upper_bound(arc.begin() + 1, arc.end() - 1, at);
    const auto a = static_cast<size_t>(after - arc.begin()) - 1;
    const float length = arc[a + 1] - arc[a];
    return static_cast<float>(a) +
           (length > 0 ? std::clamp((at - arc[a]) / length, 0.0f, 1.0f) : 0);
}

// Of every vertex of the follows, on the centre of its clump.
std::pmr::vector<float> places_of(const StrandsAtRest& strands, std::span<const float> arcs,
                                  std::span<const uint32_t> centres,
                                  std::pmr::memory_resource* memory) {
    const size_t row = strands.layout.row;
    std::pmr::vector<float> places(memory);
    places.reserve(centres.size() * row);
    for (size_t follow = 0; follow < centres.size(); ++follow) {
        const auto own = arcs.subspan((strands.layout.guides + follow) * row, row);
        const auto centre = arcs.subspan(centres[follow] * row, strands.counts[centres[follow]]);
        for (const float arc : own)
            places.push_back(place_on(centre, double(arc) / double(own.back())));
    }
    return places;
}

// Of the first segment of every follow.
std::pmr::vector<Float4> ways_of(const StrandsAtRest& strands, std::pmr::memory_resource* memory) {
    std::pmr::vector<Float4> ways(memory);
    for (size_t strand = strands.layout.guides; strand < strands.counts.size(); ++strand) {
        const Point a = vertex_of(strands, strand * strands.layout.row);
        const Point b = vertex_of(strands, strand * strands.layout.row + 1);
        const Eigen::Vector3f way =
            (Eigen::Vector3f(b.data()) - Eigen::Vector3f(a.data())).normalized();
        ways.push_back({way[0], way[1], way[2], 0});
    }
    return ways;
}

} // namespace

plait_detail_desc default_detail_desc() {
    plait_detail_desc desc{};
    desc.struct_size = sizeof desc;
    desc.curl_pitch = 0.02f;
    desc.curl_scatter = 1;
    desc.frizz_length = 0.01f;
    return desc;
}

Status check_detail(const plait_detail_desc& s) {
    PLAIT_TRY(check_ramp("clump", s.clump, 1));
    PLAIT_TRY(check_ramp("curl", s.curl, 1));
    PLAIT_RANGE(curl_pitch, double(1e-4f), 100);
    PLAIT_RANGE(curl_scatter, 0, 1);
    PLAIT_TRY(check_ramp("frizz", s.frizz, 1));
    PLAIT_RANGE(frizz_length, double(1e-4f), 100);
    return {};
}

bool Detail::clumps() const {
    return any(desc_.clump);
}
bool Detail::curls() const {
    return any(desc_.curl) || any(desc_.frizz);
}

Result<Detail> Detail::create(Device& device, const plait_detail_desc& desc,
                              std::span<const uint32_t> centres, const StrandsAtRest& strands,
                              std::pmr::memory_resource* memory) {
    Detail detail;
    detail.desc_ = desc;
    auto of = centres_of(desc, centres, strands, memory);
    if (!of)
        return of.error();
    if (!detail.clumps() && !detail.curls())
        return detail;
    const auto make = [&](Buffer& to, plait_element element, size_t count, const char* name,
                          const void* content) -> Status {
        PLAIT_TRY(device.create(to, element, count, name));
        return device.write(to, content);
    };
    const Layout& layout = strands.layout;
    const size_t follows = layout.follows, vertices = follows * layout.row;
    const auto arcs = arcs_of(strands, memory);
    PLAIT_TRY(make(detail.centre_, PLAIT_ELEMENT_UINT, follows, "clump_centre", of->data()));
    PLAIT_TRY(make(detail.arc_, PLAIT_ELEMENT_FLOAT, vertices, "follow_arc",
                   arcs.data() + layout.guide_vertices()));
    if (detail.clumps())
        PLAIT_TRY(make(detail.place_, PLAIT_ELEMENT_FLOAT, vertices, "clump_place",
                       places_of(strands, arcs, *of, memory).data()));
    if (detail.curls())
        PLAIT_TRY(make(detail.way_, PLAIT_ELEMENT_FLOAT4, follows, "follow_way",
                       ways_of(strands, memory).data()));
    return detail;
}

void Detail::append(Schedule& schedule, const Layout& layout, const Buffer& pose,
                    const Buffer& follow_guide, const Buffer& position,
                    const Buffer* wetness) const {
    if (clumps()) {
        plait_follow_clump_params params{layout.row, layout.guides, {}, wetness ? 1u : 0u};
        std::ranges::copy(desc_.clump, params.clump);
        schedule.add(PLAIT_STAGE_follow_clump, layout.follows, params,
                     {&centre_, &place_, wetness, &arc_, &position});
    }
    if (curls()) {
        plait_follow_curl_params params{};
        params.vertex_stride = layout.row;
        params.guide_count = layout.guides;
        std::ranges::copy(desc_.curl, params.curl);
        std::ranges::copy(desc_.frizz, params.frizz);
        params.pitch = desc_.curl_pitch;
        params.scatter = desc_.curl_scatter;
        params.frizz_length = desc_.frizz_length;
        params.seed = desc_.seed;
        schedule.add(PLAIT_STAGE_follow_curl, layout.follows, params,
                     {&pose, &follow_guide, &centre_, &way_, &arc_, &position});
    }
}

uint64_t Detail::device_bytes() const {
    uint64_t bytes = 0;
    for (const Buffer* buffer : {&centre_, &arc_, &place_, &way_})
        bytes += buffer->bytes();
    return bytes;
}

} // namespace plait
