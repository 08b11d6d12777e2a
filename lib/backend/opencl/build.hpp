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
};

struct StageKernel {
    Kernel kernel;
    size_t group_limit = 0; // CL_KERNEL_WORK_GROUP_SIZE
};

// Vertices per strand that a kernel over lanes is built for where no strand is at hand.
inline constexpr uint32_t usual_vertices = 16;

// `vertices` per strand matter to the stages over lanes alone, which are built for one number.
// @errors COMPILE with the compiler's whole log, or the argument that differs from stages.def
Result<StageKernel> build_stage(Programs& programs, const Candidate& device,
                                const plait_stage_info& stage, const StageText& text,
                                const Log& log, const ProgramFolder& folder = {},
                                uint32_t vertices = usual_vertices);

// What kernels are built with. Contraction of a*b + c is left to each kernel (FP_CONTRACT); nothing
// that trades accuracy for speed is on, and argument information is kept for the check. Kernels
// over lanes learn the width, the tile and the vertices per strand.
std::string build_options(const Candidate& device, uint32_t vertices = usual_vertices);

} // namespace plait::opencl
