#include "backend/opencl/enumerate.hpp"

#include "backend/opencl/errors.hpp"
#include "base/format.hpp"

#include <algorithm>
#include <cstring>

namespace plait::opencl {

Status set_lanes(plait_device_info& info, uint32_t lanes) {
    if (lanes != 1 && lanes != 4 && lanes != 8 && lanes != 16)
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("lanes is %u; a strand model runs over 1, 4, 8 or 16", lanes)};
    // One strand per work-item reads coalesced when a tile is a warp of strands.
    constexpr uint32_t warp = 32;
    info.lanes = lanes;
    info.tile = lanes == 1 ? warp : lanes;
    return {};
}

// A software rasteriser that poses as an OpenCL CPU device reports no clock and so comes last.
Rank rank_of(const plait_device_info& info, bool unified, uint32_t clock) {
    if (info.type == PLAIT_DEVICE_TYPE_CPU)
        return {0, false, 0, double(clock) * info.compute_units * std::max(1u, info.float_width)};
    return {info.type == PLAIT_DEVICE_TYPE_GPU ? 2 : 1, !unified, info.memory_bytes, 0};
}

namespace {

template <typename T> T query(cl_device_id device, cl_device_info what) {
    T value{};
    clGetDeviceInfo(device, what, sizeof value, &value, nullptr);
    return value;
}

cl_platform_id platform_of(cl_device_id device) {
    cl_platform_id platform = nullptr;
    clGetDeviceInfo(device, CL_DEVICE_PLATFORM, sizeof(cl_platform_id), &platform, nullptr);
    return platform;
}

template <typename Object, typename Get>
std::string query_text(Get get, Object object, cl_uint what) {
    size_t size = 0;
    if (get(object, what, 0, nullptr, &size) != CL_SUCCESS || size == 0)
        return "?";
    std::string text(size, '\0');
    get(object, what, size, text.data(), nullptr);
    text.resize(std::strlen(text.c_str()));
    return text;
}

template <size_t size> void copy_text(char (&to)[size], const std::string& from) {
    std::snprintf(to, size, "%s", from.c_str());
}

plait_device_type device_type(cl_device_type type) {
    if (type & CL_DEVICE_TYPE_GPU)
        return PLAIT_DEVICE_TYPE_GPU;
    return type & CL_DEVICE_TYPE_CPU ? PLAIT_DEVICE_TYPE_CPU : PLAIT_DEVICE_TYPE_OTHER;
}

// A CPU's registers full of strands; on a GPU every work-item has its own.
uint32_t usual_lanes(const plait_device_info& info) {
    if (info.type == PLAIT_DEVICE_TYPE_GPU || info.float_width < 4)
        return 1;
    return info.float_width >= 16 ? 16 : info.float_width >= 8 ? 8 : 4;
}

plait_device_info describe(cl_platform_id platform, cl_device_id device) {
    plait_device_info info{};
    info.struct_size = sizeof info;
    copy_text(info.backend, "opencl");
    copy_text(info.platform, query_text(clGetPlatformInfo, platform, CL_PLATFORM_NAME));
    copy_text(info.name, query_text(clGetDeviceInfo, device, CL_DEVICE_NAME));
    copy_text(info.vendor, query_text(clGetDeviceInfo, device, CL_DEVICE_VENDOR));
    copy_text(info.driver, query_text(clGetDeviceInfo, device, CL_DRIVER_VERSION));
    info.type = device_type(query<cl_device_type>(device, CL_DEVICE_TYPE));
    info.compute_units = query<cl_uint>(device, CL_DEVICE_MAX_COMPUTE_UNITS);
    info.memory_bytes = query<cl_ulong>(device, CL_DEVICE_GLOBAL_MEM_SIZE);
    info.float_width = query<cl_uint>(device, CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT);
    (void)set_lanes(info, usual_lanes(info));
    info.max_group_size =
        static_cast<uint32_t>(query<size_t>(device, CL_DEVICE_MAX_WORK_GROUP_SIZE));
    info.local_memory_bytes = query<cl_ulong>(device, CL_DEVICE_LOCAL_MEM_SIZE);
    return info;
}

// What plait cannot do without; nullptr: nothing is missing.
const char* missing_ability(cl_device_id device) {
    if (!query<cl_bool>(device, CL_DEVICE_AVAILABLE))
        return "the device is not available";
    if (!query<cl_bool>(device, CL_DEVICE_COMPILER_AVAILABLE))
        return "it has no compiler for kernel source";
    if (!query<cl_bool>(device, CL_DEVICE_ENDIAN_LITTLE))
        return "it is big-endian";
    int major = 0, minor = 0;
    const std::string version = query_text(clGetDeviceInfo, device, CL_DEVICE_VERSION);
    if (std::sscanf(version.c_str(), "OpenCL %d.%d", &major, &minor) != 2 ||
        major * 10 + minor < 12)
        return "it is older than OpenCL 1.2";
    return nullptr;
}

void examine_platform(cl_platform_id platform, Candidates& found) {
    const std::string name = query_text(clGetPlatformInfo, platform, CL_PLATFORM_NAME);
    cl_uint count = 0;
    cl_int code = clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 0, nullptr, &count);
    std::vector<cl_device_id> devices(count);
    if (code == CL_SUCCESS)
        code = clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, count, devices.data(), nullptr);
    if (code != CL_SUCCESS) {
        found.rejected.push_back(
            format("platform %s: no devices: %s", name.c_str(), error_name(code).c_str()));
        return;
    }
    for (cl_device_id device : devices) {
        Result<Candidate> candidate = examine_device(device);
        if (candidate.ok())
            found.usable.push_back(*candidate);
        else
            found.rejected.push_back(candidate.error().message);
    }
}

} // namespace

Result<Candidate> examine_device(cl_device_id device) {
    Candidate candidate{platform_of(device), device, {}, {}};
    candidate.info = describe(candidate.platform, device);
    candidate.rank =
        rank_of(candidate.info, query<cl_bool>(device, CL_DEVICE_HOST_UNIFIED_MEMORY) != CL_FALSE,
                query<cl_uint>(device, CL_DEVICE_MAX_CLOCK_FREQUENCY));
    if (const char* missing = missing_ability(device))
        return Error{PLAIT_UNSUPPORTED, format("device %s of platform %s: %s", candidate.info.name,
                                               candidate.info.platform, missing)};
    return candidate;
}

Candidates find_devices() {
    Candidates found;
    cl_uint count = 0;
    cl_int code = clGetPlatformIDs(0, nullptr, &count);
    std::vector<cl_platform_id> platforms(count);
    if (code == CL_SUCCESS)
        code = clGetPlatformIDs(count, platforms.data(), nullptr);
    if (code != CL_SUCCESS)
        found.rejected.push_back(format("no OpenCL platforms: %s", error_name(code).c_str()));
    else
        for (cl_platform_id platform : platforms)
            examine_platform(platform, found);
    std::ranges::stable_sort(found.usable, std::greater(), &Candidate::rank);
    return found;
}

} // namespace plait::opencl
