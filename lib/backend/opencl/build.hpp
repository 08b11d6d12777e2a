// From a stage's source to a kernel that is known to have the stage's arguments.
#pragma once

#include "backend/opencl/programs.hpp"
#include "base/log.hpp"
#include "base/result.hpp"

#include <plait/plait_backend.h>

#include <string>

namespace plait::opencl {

struct StageText {
    std::string name; // of the file, for messages
    std::string text;
    bool own = false; // the user's
};

struct StageKernel {
    Kernel kernel;
    Program program;
    std::string key;        // of the program in a folder
    size_t group_limit = 0; // CL_KERNEL_WORK_GROUP_SIZE
};

// Vertices per strand that a kernel over lanes is built for where no strand is at hand.
inline constexpr uint32_t usual_vertices = 16;

// What a kernel is built for beside the device.
struct Variant {
    uint32_t vertices = usual_vertices; // per strand: of the stages over lanes
    uint32_t group_sums = 0;            // words, as of group_sums()

    auto operator<=>(const Variant&) const = default;
};

// @errors COMPILE with the compiler's whole log, or the argument that differs from stages.def
Result<StageKernel> build_stage(Programs& programs, const Candidate& device,
                                const plait_stage_info& stage, const StageText& text,
                                const Log& log, const ProgramFolder& folder = {},
                                const Variant& variant = {});

// What kernels are built with. Contraction of a*b + c is left to each kernel (FP_CONTRACT); nothing
// that trades accuracy for speed is on, and argument information is kept for the check. Kernels
// over lanes learn the width, the tile and the vertices per strand; the others have one lane, unless
// they choose the device's width themselves.
std::string build_options(const Candidate& device, plait_space space, const Variant& variant = {});

} // namespace plait::opencl
