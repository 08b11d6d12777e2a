// Parameters that were set and do nothing: what the log says of them.
#pragma once

#include "core/params/param_table.hpp"

#include <string>

namespace plait {

// Who reads a sim's parameters.
struct Readers {
    plait_model model;
    bool follow_copies;        // it has follows_per_guide
    const char* no_accelerate; // why no kernel of the caller's for the stage accelerate is run; "":
                               // one is, and reads the acceleration's values
};

// What is wrong with a parameter that has left its default since `before` while nothing reads it;
// "" if nothing is.
std::string ignored_warning(const plait_param_info& param, const NamedParams& before,
                            const NamedParams& now, const Readers& readers);

} // namespace plait
