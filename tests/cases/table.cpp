#include "case.hpp"

namespace plait::cases {

#define PLAIT_STAGE(name, space, params, summary) Case name##_case();
#include <plait/stages.def>

const std::vector<Case>& all_cases() {
    static const std::vector<Case> cases = {
#define PLAIT_STAGE(name, space, params, summary) name##_case(),
#include <plait/stages.def>
    };
    return cases;
}

} // namespace plait::cases
