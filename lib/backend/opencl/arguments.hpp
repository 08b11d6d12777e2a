// Does a kernel have the arguments its stage declares?
#pragma once

#include "backend/opencl/handles.hpp"
#include "base/result.hpp"

#include <plait/plait_backend.h>

#include <string>
#include <vector>

namespace plait::opencl {

struct Argument {
    std::string address; // "__global const " with the qualifiers of what it points to, or ""
    std::string type;    // "float4*"
    std::string name;

    std::string text() const { return address + type + " " + name; }
};

std::vector<Argument> expected_arguments(const plait_stage_info& stage);

enum class Match {
    same,
    spelled, // alike but for a type's name that no stage uses: an alias that the driver looked
             // through
    other
};

// A driver may tell the type that an alias stands for (`float16*` for `real*`). A name that another
// argument of the table could have is another type.
Match match(const Argument& expected, const Argument& found);

// What could not be checked, a sentence each: types that a driver spells in its own way, or
// everything but the number of arguments where it keeps no argument information.
// @errors COMPILE: the first argument that differs, what was expected and what was found
Result<std::vector<std::string>> check_arguments(cl_kernel kernel, const plait_stage_info& stage,
                                                 const std::string& file);

} // namespace plait::opencl
