// A groom's strands as the model articulated sees them: lengths, masses, stiffnesses and the rest
// rotation of every joint, in the lane layout [tile][V][components][tile strands].
#pragma once

#include "core/base/lane_layout.hpp"
#include "core/groom/materials.hpp"
#include "core/strands/sag.hpp"

#include <array>

namespace plait {

// Strands at rest: xyz of every vertex, vertices per strand.
struct RestStrands {
    std::pmr::vector<float> positions;
    std::pmr::vector<uint32_t> counts;
    std::pmr::vector<float> stiffness; // scale of each strand's, or empty
};

// The material of each strand.
struct Materials {
    std::pmr::vector<Material> list; // those of the table
    StrandMaterialsPtr table;        // which strand is of which

    const Material& of(uint32_t strand) const;
    bool curls() const; // the rest shape is not the groom's
    bool holds() const; // some strands have a spring to the groom of their own
    bool operator==(const Materials&) const = default;
};

// Whether the groom's shape is that without a load, or that under its own weight.
struct RestLoad {
    plait_sag_free mode = PLAIT_SAG_FREE_OFF;
    std::array<float, 3> gravity{}; // m/s^2, in rest space; 0 where the mode is OFF

    bool operator==(const RestLoad&) const = default;
};

struct LaneRows {
    // [rows*6]: PLAIT_LANE_LENGTH, ... Rows past a tip have mass 1 and nothing
    // else, but for what is of the whole strand in the last one.
    std::pmr::vector<float> material;
    // [rows*4]: rotation of the joint before each segment at rest; row 0: that of the first
    // segment, from the rest space's axes.
    std::pmr::vector<float> rest;
    // The same as groomed: where the strand starts. Empty where it is `rest` of every strand.
    std::pmr::vector<float> start;
    // [rows*2]: PLAIT_LANE_GROOM_...; 0 at roots and past tips. Empty where nobody asked for it.
    std::pmr::vector<float> groom;
    SagReport sag;
};

// `members`: the strand of each lane of the layout. `grooms`: with what holds them in the groom.
LaneRows lane_rows(const RestStrands& strands, std::span<const uint32_t> members,
                   const LaneLayout& layout, const Materials& materials, const RestLoad& load,
                   bool grooms, std::pmr::memory_resource* memory);

} // namespace plait
