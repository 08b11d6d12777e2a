// What tells one strand model from another, a row for each.
#pragma once

#include <plait/plait.h>
#include <plait/plait_backend.h>

#include <iterator>
#include <span>
#include <string>

namespace plait {

struct ModelTraits {
    plait_model model;
    const char* name;
    plait_stage stage;   // of a substep; PLAIT_STAGE_COUNT: several (tressfx)
    uint32_t iterations; // by default
    uint32_t bdf2;       // by default
    bool switches;       // strands over lanes, which may change to another such model
    bool bends;          // has joints, orientations and a rest shape that gravity may be in
    bool flat;           // sections may be elliptic
    bool stretches;      // by EA
    bool halves_tip;     // half a mass at the tip; else equal masses, a limp chain's
    bool meets;          // other strands, where strand_contact is on; all are met
};

// In the order of plait_model; fields as above.
inline constexpr ModelTraits model_table[] = {
    {PLAIT_MODEL_TRESSFX, "tressfx", PLAIT_STAGE_COUNT, 0, 0, false, false, false, false, false,
     false},
    {PLAIT_MODEL_CHAIN, "chain", PLAIT_STAGE_chain, 1, 0, true, false, false, false, false, false},
    {PLAIT_MODEL_COSSERAT, "cosserat", PLAIT_STAGE_cosserat, 3, 0, true, true, false, true, true,
     true},
    {PLAIT_MODEL_ROD, "rod", PLAIT_STAGE_rod, 1, 0, true, true, true, true, true, true},
    {PLAIT_MODEL_ARTICULATED, "articulated", PLAIT_STAGE_articulated, 1, 1, true, true, true, false,
     true, true},
};
static_assert([] {
    for (size_t i = 0; i < std::size(model_table); ++i)
        if (static_cast<size_t>(model_table[i].model) != i)
            return false;
    return true;
}());

inline std::span<const ModelTraits> all_models() {
    return model_table;
}
inline const ModelTraits& traits_of(plait_model model) {
    return all_models()[static_cast<size_t>(model)];
}
inline plait_model last_model() {
    return all_models().back().model;
}

// "cosserat (2) and rod (3)": models of which `has` holds, for messages.
std::string list_models(bool ModelTraits::*has);

} // namespace plait
