#include "backend/opencl/errors.hpp"

#include "base/format.hpp"

namespace plait::opencl {
namespace {

const char* identifier(cl_int code) {
    switch (code) {
#define PLAIT_NAME(name)                                                                           \
    case name:                                                                                     \
        return #name;
        PLAIT_NAME(CL_SUCCESS)
        PLAIT_NAME(CL_DEVICE_NOT_FOUND)
        PLAIT_NAME(CL_DEVICE_NOT_AVAILABLE)
        PLAIT_NAME(CL_COMPILER_NOT_AVAILABLE)
        PLAIT_NAME(CL_MEM_OBJECT_ALLOCATION_FAILURE)
        PLAIT_NAME(CL_OUT_OF_RESOURCES)
        PLAIT_NAME(CL_OUT_OF_HOST_MEMORY)
        PLAIT_NAME(CL_PROFILING_INFO_NOT_AVAILABLE)
        PLAIT_NAME(CL_BUILD_PROGRAM_FAILURE)
        PLAIT_NAME(CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST)
        PLAIT_NAME(CL_KERNEL_ARG_INFO_NOT_AVAILABLE)
        PLAIT_NAME(CL_INVALID_VALUE)
        PLAIT_NAME(CL_INVALID_PLATFORM)
        PLAIT_NAME(CL_INVALID_DEVICE)
        PLAIT_NAME(CL_INVALID_CONTEXT)
        PLAIT_NAME(CL_INVALID_QUEUE_PROPERTIES)
        PLAIT_NAME(CL_INVALID_COMMAND_QUEUE)
        PLAIT_NAME(CL_INVALID_MEM_OBJECT)
        PLAIT_NAME(CL_INVALID_BUILD_OPTIONS)
        PLAIT_NAME(CL_INVALID_PROGRAM)
        PLAIT_NAME(CL_INVALID_PROGRAM_EXECUTABLE)
        PLAIT_NAME(CL_INVALID_KERNEL_NAME)
        PLAIT_NAME(CL_INVALID_KERNEL_DEFINITION)
        PLAIT_NAME(CL_INVALID_KERNEL)
        PLAIT_NAME(CL_INVALID_ARG_INDEX)
        PLAIT_NAME(CL_INVALID_ARG_VALUE)
        PLAIT_NAME(CL_INVALID_ARG_SIZE)
        PLAIT_NAME(CL_INVALID_KERNEL_ARGS)
        PLAIT_NAME(CL_INVALID_WORK_DIMENSION)
        PLAIT_NAME(CL_INVALID_WORK_GROUP_SIZE)
        PLAIT_NAME(CL_INVALID_WORK_ITEM_SIZE)
        PLAIT_NAME(CL_INVALID_EVENT)
        PLAIT_NAME(CL_INVALID_OPERATION)
        PLAIT_NAME(CL_INVALID_BUFFER_SIZE)
        PLAIT_NAME(CL_INVALID_GLOBAL_WORK_SIZE)
#undef PLAIT_NAME
    case -1001: // of the ICD loader's extension cl_khr_icd
        return "CL_PLATFORM_NOT_FOUND_KHR";
    default:
        return "an error OpenCL 1.2 does not name";
    }
}

plait_result meaning(cl_int code) {
    switch (code) {
    case CL_OUT_OF_HOST_MEMORY:
    case CL_MEM_OBJECT_ALLOCATION_FAILURE:
    case CL_INVALID_BUFFER_SIZE: // larger than the device allows
        return PLAIT_OUT_OF_MEMORY;
    case CL_DEVICE_NOT_AVAILABLE:
    case CL_INVALID_CONTEXT: // handles that were good when the device was opened
    case CL_INVALID_COMMAND_QUEUE:
    case CL_INVALID_DEVICE:
        return PLAIT_DEVICE_LOST;
    case CL_INVALID_WORK_GROUP_SIZE:
    case CL_INVALID_WORK_ITEM_SIZE:
        return PLAIT_UNSUPPORTED;
    default:
        return PLAIT_BACKEND;
    }
}

} // namespace

std::string error_name(cl_int code) {
    return format("%s (%d)", identifier(code), code);
}

Error failure(cl_int code, const std::string& what) {
    return {meaning(code), format("%s: %s", what.c_str(), error_name(code).c_str())};
}

Error late_failure(cl_int code, const std::string& what) {
    Error error = failure(code, what);
    if (code == CL_OUT_OF_RESOURCES)
        error.code = PLAIT_DEVICE_LOST;
    return error;
}

} // namespace plait::opencl
