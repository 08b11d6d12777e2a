// How a strand is solved: by which model, in how many substeps and with how much work in each.
#pragma once

#include "core/strands/traits.hpp"

#include <memory_resource>
#include <vector>

namespace plait {

// One strand's. `iterations` and `bdf2` may be PLAIT_SETTING_OF_SIM: what the parameters say, which
// may change under it.
struct Settings {
    plait_model model;
    uint32_t substeps; // of a fixed step
    uint32_t iterations = PLAIT_SETTING_OF_SIM, bdf2 = PLAIT_SETTING_OF_SIM;

    bool operator==(const Settings&) const = default;

    // The numbers that a solve takes.
    uint32_t iterations_of(const plait_sim_params& params) const {
        const uint32_t n = iterations == PLAIT_SETTING_OF_SIM ? params.iterations : iterations;
        return n == PLAIT_ITERATIONS_OF_MODEL ? traits_of(model).iterations : n;
    }
    uint32_t bdf2_of(const plait_sim_params& params) const {
        const uint32_t own = bdf2 == PLAIT_SETTING_OF_SIM ? params.bdf2 : bdf2;
        if (own != PLAIT_BDF2_OF_MODEL)
            return own;
        // what it remembers of the step before throws off strands that others have pushed
        return params.strand_contact == PLAIT_STRAND_CONTACT_OFF ? traits_of(model).bdf2 : 0;
    }
};
using SettingsList = std::pmr::vector<Settings>; // [guides]

// Of settings that were checked, in a sim of so many substeps.
inline Settings make_settings(const plait_strand_settings& given, uint32_t sim_substeps) {
    const bool own = given.substeps != PLAIT_SETTING_OF_SIM;
    return {given.model, own ? given.substeps : sim_substeps, given.iterations, given.bdf2};
}

// The numbers of substeps in a list of settings, each once, in the order of their first strand.
std::pmr::vector<uint32_t> substeps_of(std::span<const Settings> settings,
                                       std::pmr::memory_resource* memory);

} // namespace plait
