// What is compiled for a stage: its kernel alone, or with others in one program.
#pragma once

#include "backend/opencl/build.hpp"

namespace plait::opencl {

// Small kernels that are used together are one program: a driver takes a tenth of a second for each
// (PoCL), most of it for the standard library. Kernels that are large, that a step spends its time in, or
// that have variants of their own stay apart. No text: there is no such kernel.
StageText program_text(plait_stage stage);

} // namespace plait::opencl
