// What a sim is made of.
#pragma once

#include "core/levels/sim_levels.hpp"
#include "core/output/display.hpp"
#include "core/params/params.hpp"
#include "core/roots/skin.hpp"
#include "core/sim/context.hpp"
#include "core/sim/reduce.hpp"
#include "core/strands/model.hpp"
#include "core/wind/wind.hpp"

#include <memory>
#include <span>
#include <string>

namespace plait {

// Everything on the host that a sim is made of; moved into the Sim once all of it is there.
struct SimParts {
    Layout layout;
    plait_sim_desc desc;
    Params params;
    StrandMaterialsPtr materials;
    std::string size_warning;
    HairSizes hair;
    std::string groom_warning;
    uint64_t fingerprint; // of the groom's strands
    GridCube cube;
    float longest_segment; // m
    StrandLengths lengths;
    Skin skin;
    std::unique_ptr<Model> model;
    State state;
    Display display;
    std::unique_ptr<SimLevels> levels; // null: without
};
// What of a descriptor belongs to single guides, checked.
struct StrandInput {
    std::span<const float> stiffness; // what scales each guide's, or empty
    StrandMaterialsPtr materials;
    const FollowMap* follows = nullptr;
    const Levels* levels = nullptr; // with follows: guides and map are those of `level_top`
    uint32_t level_top = 0;
};
Result<SimParts> make_sim_parts(Context& context, const Groom& groom, const plait_sim_desc& desc,
                                const StrandInput& strands);

} // namespace plait
