// How a strand is solved: in how many substeps and with how much work in each.
#pragma once

#include "core/base/params.hpp"

#include <memory_resource>
#include <span>
#include <vector>

namespace plait {

// One strand's. `iterations` and `bdf2` may be PLAIT_SETTING_OF_SIM: what the parameters say, which
// may change under it.
struct Settings {
    uint32_t substeps; // of a fixed step
    uint32_t iterations = PLAIT_SETTING_OF_SIM, bdf2 = PLAIT_SETTING_OF_SIM;

    bool operator==(const Settings&) const = default;

    // The numbers that a solve takes.
    uint32_t iterations_of(const Params& params) const {
        return iterations == PLAIT_SETTING_OF_SIM ? params.iterations : iterations;
    }
    uint32_t bdf2_of(const Params& params) const {
        const uint32_t own = bdf2 == PLAIT_SETTING_OF_SIM ? params.bdf2 : bdf2;
        if (own != PLAIT_BDF2_OF_MODEL)
            return own;
        // what it remembers of the step before throws off strands that others have pushed
        return params.strand_contact.on ? 0 : 1;
    }
};
using SettingsList = std::pmr::vector<Settings>; // [guides]

// Of settings that were checked, in a sim of so many substeps.
inline Settings make_settings(const plait_strand_settings& given, uint32_t sim_substeps) {
    const bool own = given.substeps != PLAIT_SETTING_OF_SIM;
    return {own ? given.substeps : sim_substeps, given.iterations, given.bdf2};
}

// The numbers of substeps in a list of settings, each once, in the order of their first strand.
std::pmr::vector<uint32_t> substeps_of(std::span<const Settings> settings,
                                       std::pmr::memory_resource* memory);

} // namespace plait
