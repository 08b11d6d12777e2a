#include "backend/opencl/build.hpp"

#include "backend/opencl/arguments.hpp"
#include "backend/opencl/errors.hpp"
#include "backend/opencl/source.hpp"
#include "base/format.hpp"

namespace plait::opencl {
namespace {

Result<Kernel> find_kernel(cl_program program, const plait_stage_info& stage,
                           const std::string& file) {
    cl_int code = CL_SUCCESS;
    Kernel kernel(clCreateKernel(program, stage.kernel, &code));
    if (code == CL_INVALID_KERNEL_NAME)
        return Error{PLAIT_COMPILE,
                     format("%s defines no kernel named %s", file.c_str(), stage.kernel)};
    if (code != CL_SUCCESS)
        return failure(code, format("clCreateKernel(%s)", stage.kernel));
    return kernel;
}

Result<StageKernel> build(Programs& programs, const Candidate& device,
                          const plait_stage_info& stage, const StageText& text,
                          const ProgramFolder& folder, const Variant& variant, const Log& log) {
    auto source = flatten(text.name, text.text);
    PLAIT_TRY(source);
    // Of warnings in our kernels a game has no use, and PoCL prints how many there were.
    const std::string options =
        build_options(device, stage.space, variant) + (text.own ? "" : " -w");
    const ProgramRequest request{device, *source, options, folder, log};
    const auto program = programs.get(request);
    PLAIT_TRY(program);
    auto kernel = find_kernel(program->program.get(), stage, text.name);
    PLAIT_TRY(kernel);
    const auto unchecked = check_arguments(kernel->get(), stage, text.name);
    PLAIT_TRY(unchecked);
    for (const std::string& sentence : *unchecked)
        if (!program->from_binary) // which has no names of arguments with most drivers
            log(PLAIT_LOG_LEVEL_WARNING, sentence);
    const char* how = !program->is_new ? "shared" : program->from_binary ? "loaded" : "built";
    log(PLAIT_LOG_LEVEL_DEBUG, format("stage %s: %s, %s", stage.name, how, text.name.c_str()));
    StageKernel built{std::move(*kernel), program->program, program->key};
    const cl_int code =
        clGetKernelWorkGroupInfo(built.kernel.get(), device.device, CL_KERNEL_WORK_GROUP_SIZE,
                                 sizeof built.group_limit, &built.group_limit, nullptr);
    if (code != CL_SUCCESS || built.group_limit == 0)
        return failure(code, format("clGetKernelWorkGroupInfo(%s)", stage.kernel));
    return built;
}

} // namespace

std::string build_options(const Candidate& device, plait_space space, const Variant& variant) {
    // Velocities of hair that comes to rest die away through the denormal numbers, which CPUs
    // multiply a hundred times as slowly: resting strands cost half as much again.
    std::string options = "-cl-std=CL1.2 -cl-kernel-arg-info -cl-denorms-are-zero";
    options += format(" -DPLAIT_DEVICE_LANES=%u", device.info.lanes);
    if (space == PLAIT_SPACE_LANES)
        options += format(" -DPLAIT_LANES=%u -DPLAIT_TILE=%u -DPLAIT_VERTICES=%u",
                          device.info.lanes, device.info.tile, variant.vertices);
    if (variant.group_sums > 0)
        options += format(" -DPLAIT_GROUP_SUMS=%u", variant.group_sums);
    // Oclgrind 21.10 does not know the intrinsics that LLVM's optimiser leaves in its input
    // (llvm.experimental.noalias.scope.decl).
    if (std::string_view(device.info.platform) == "Oclgrind")
        options += " -cl-opt-disable";
    return options;
}

Result<StageKernel> build_stage(Programs& programs, const Candidate& device,
                                const plait_stage_info& stage, const StageText& text,
                                const Log& log, const ProgramFolder& folder,
                                const Variant& variant) {
    auto built = build(programs, device, stage, text, folder, variant, log);
    if (!built.ok()) {
        Error error = built.error();
        error.message = format("stage %s: %s", stage.name, error.message.c_str());
        log(PLAIT_LOG_LEVEL_ERROR, error.message);
        return error;
    }
    return built;
}

} // namespace plait::opencl
