// Hair at rest, checked and mended: every strand has 2..256 vertices and no segment without length.
#pragma once

#include "base/result.hpp"
#include "core/groom/strand_set.hpp"

#include <plait/params.h>
#include <plait/plait.h>

#include <algorithm>
#include <array>
#include <memory_resource>
#include <span>
#include <string>

namespace plait {

struct ImportRules {
    plait_repair_policy policy = PLAIT_REPAIR_POLICY_REPAIR;
    float min_segment = 1e-3f; // share of the strand's mean segment
    uint32_t resample = 0;     // vertices per strand; 0: as they come
    plait_root_end root_end = PLAIT_ROOT_END_FIRST;
};

// Diameters of hair, m: of others nothing is believed.
inline constexpr float thinnest_hair = 10e-6f, thickest_hair = 1e-3f;
inline bool is_hair_diameter(float d) {
    return d >= thinnest_hair && d <= thickest_hair;
}

struct Repairs {
    std::array<uint64_t, PLAIT_REPAIR_COUNT> count{};
    std::string first; // the first offender: strand, vertex, value

    uint64_t total() const;
};

struct GroomShape {
    uint64_t strands = 0;
    uint64_t vertices = 0;
    uint32_t min_vertices = 0;
    uint32_t max_vertices = 0;
    uint32_t bones = 0; // 0: no skin
    std::array<float, 3> bounds_min{};
    std::array<float, 3> bounds_max{};
    double min_length = 0; // m
    double mean_length = 0;
    double max_length = 0;
    double extent() const { // m, along the longest axis
        double most = 0;
        for (size_t i = 0; i < 3; ++i)
            most = std::max(most, double(bounds_max[i]) - double(bounds_min[i]));
        return most;
    }
};

// Immutable once made, so threads and contexts may share it.
struct Groom {
    StrandSet strands;
    GroomShape shape;
    Repairs repairs;
    uint64_t roots_contradicted = 0; // strands (root_ends.hpp), the first of them
    uint32_t first_contradicted = 0;
    uint64_t thickness_unlikely = 0; // strands whose diameter is no hair's
};

// What is likely wrong with it beside its lengths (units.hpp), in sentences; "": nothing.
std::string groom_warning(const Groom& groom);

// The strands of `from` with these numbers, as they are there.
Groom take_strands(const Groom& from, std::span<const uint32_t> which,
                   std::pmr::memory_resource* memory);

// Equal for strands of the same shape in the same order.
uint64_t fingerprint(const Groom& groom);

// Mends `raw` by the rules. BAD_DATA: nothing left, policy REFUSE, or a per-strand value that
// cannot be used. `memory` holds the groom's arrays.
Result<Groom> build_groom(const StrandSet& raw, const ImportRules& rules,
                          std::pmr::memory_resource* memory);

} // namespace plait
