// What nobody means to give a simulation. No crash or hang; every other strand bitwise as without
// the offender; the offender finite, culled or reported.
#pragma once

#include "sweep.hpp"

#include <plait/plait.hpp>

namespace lab::stability {

struct Verdict {
    std::string input;
    bool passed;
    std::string what; // "culled: strand 2: ...", or what went wrong
};

std::vector<std::string> bad_inputs();
Verdict try_bad_input(const Subject& subject, const std::string& input);

} // namespace lab::stability
