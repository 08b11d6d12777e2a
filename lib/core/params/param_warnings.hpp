// Parameters that were set and do nothing: what the log says of them.
#pragma once

#include <plait/plait_offline.h>

#include <string>

namespace plait {

// Who reads a sim's parameters.
struct Readers {
    uint32_t models;           // bits 1u << plait_model
    const char* no_accelerate; // why no kernel of the caller's for the stage accelerate is run; "":
                               // one is, and reads accelerate_values
};

// What is wrong with a parameter that has left its default since `before` while nothing reads it;
// "" if nothing is.
std::string ignored_warning(const plait_param_info& param, const plait_sim_params& before,
                            const plait_sim_params& now, const Readers& readers);

// Of features that are opened by calls, which of them a sim has.
struct OpenFeatures {
    bool wet, follow_copies;
};

// The same of a parameter of a feature that is off.
std::string off_warning(const plait_param_info& param, const plait_sim_params& before,
                        const plait_sim_params& now, const OpenFeatures& open);

} // namespace plait
