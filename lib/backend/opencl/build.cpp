#include "backend/opencl/build.hpp"

#include "backend/opencl/arguments.hpp"
#include "backend/opencl/errors.hpp"
#include "backend/opencl/source.hpp"
#include "base/format.hpp"

#include <cstring>

namespace plait::opencl {
namespace {

std::string build_log(cl_program program, cl_device_id device) {
    size_t size = 0;
    clGetProgramBuildInfo(program, device, CL_PROGRAM_BUILD_LOG, 0, nullptr, &size);
    std::string text(size, '\0');
    clGetProgramBuildInfo(program, device, CL_PROGRAM_BUILD_LOG, size, text.data(), nullptr);
    text.resize(std::strlen(text.c_str()));
    while (!text.empty() && (text.back() == '\n' || text.back() == ' '))
        text.pop_back();
    return text;
}

Result<Program> build_program(cl_context context, const Candidate& device, const Source& source,
                              uint32_t vertices, const Log& log) {
    const char* text = source.text.c_str();
    cl_int code = CL_SUCCESS;
    Program program(clCreateProgramWithSource(context, 1, &text, nullptr, &code));
    if (code != CL_SUCCESS)
        return failure(code, "clCreateProgramWithSource");
    const std::string options = build_options(device, vertices);
    code = clBuildProgram(program.get(), 1, &device.device, options.c_str(), nullptr, nullptr);
    const std::string messages = true_places(source, build_log(program.get(), device.device));
    if (code != CL_SUCCESS)
        return Error{PLAIT_COMPILE,
                     format("%s did not build on %s with %s: %s\n%s", source.files[0].c_str(),
                            device.info.name, options.c_str(), error_name(code).c_str(),
                            messages.c_str())};
    if (!messages.empty())
        log(PLAIT_LOG_LEVEL_DEBUG, format("%s: %s", source.files[0].c_str(), messages.c_str()));
    return program;
}

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

Result<StageKernel> build(cl_context context, const Candidate& device,
                          const plait_stage_info& stage, const StageText& text, uint32_t vertices,
                          const Log& log) {
    auto source = flatten(text.name, text.text);
    PLAIT_TRY(source);
    auto program = build_program(context, device, *source, vertices, log);
    PLAIT_TRY(program);
    auto kernel = find_kernel(program->get(), stage, text.name);
    PLAIT_TRY(kernel);
    const auto unchecked = check_arguments(kernel->get(), stage, text.name);
    PLAIT_TRY(unchecked);
    for (const std::string& sentence : *unchecked)
        log(PLAIT_LOG_LEVEL_WARNING, sentence);
    StageKernel built{std::move(*kernel)};
    const cl_int code =
        clGetKernelWorkGroupInfo(built.kernel.get(), device.device, CL_KERNEL_WORK_GROUP_SIZE,
                                 sizeof built.group_limit, &built.group_limit, nullptr);
    if (code != CL_SUCCESS || built.group_limit == 0)
        return failure(code, format("clGetKernelWorkGroupInfo(%s)", stage.kernel));
    return built;
}

} // namespace

std::string build_options(const Candidate& device, uint32_t vertices) {
    // Velocities of hair that comes to rest die away through the denormal numbers, which CPUs
    // multiply a hundred times as slowly: resting strands cost half as much again.
    std::string options = "-cl-std=CL1.2 -cl-kernel-arg-info -cl-denorms-are-zero";
    options += format(" -DPLAIT_LANES=%u -DPLAIT_TILE=%u -DPLAIT_VERTICES=%u", device.info.lanes,
                      device.info.tile, vertices);
    // Oclgrind 21.10 does not know the intrinsics that LLVM's optimiser leaves in its input
    // (llvm.experimental.noalias.scope.decl).
    if (std::string_view(device.info.platform) == "Oclgrind")
        options += " -cl-opt-disable";
    return options;
}

Result<StageKernel> build_stage(cl_context context, const Candidate& device,
                                const plait_stage_info& stage, const StageText& text,
                                const Log& log, uint32_t vertices) {
    auto built = build(context, device, stage, text, vertices, log);
    if (!built.ok()) {
        Error error = built.error();
        error.message = format("stage %s: %s", stage.name, error.message.c_str());
        log(PLAIT_LOG_LEVEL_ERROR, error.message);
        return error;
    }
    log(PLAIT_LOG_LEVEL_DEBUG, format("stage %s: built from %s", stage.name, text.name.c_str()));
    return built;
}

} // namespace plait::opencl
