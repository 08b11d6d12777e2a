// Every OpenCL device there is, opened by the backend's own door.
#pragma once

#include "backend/opencl/device.hpp"
#include "backend/opencl/enumerate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace plait::opencl {

// GoogleTest names may hold letters and digits only.
inline std::string test_name(const ::testing::TestParamInfo<uint32_t>& index) {
    const plait_device_info info = find_devices().usable[index.param].info;
    std::string name = std::string(info.platform) + "_" + info.name;
    std::ranges::replace_if(
        name, [](unsigned char c) { return !std::isalnum(c); }, '_');
    return std::to_string(index.param) + "_" + name;
}

inline std::vector<uint32_t> device_indices() {
    std::vector<uint32_t> list(find_devices().usable.size());
    for (uint32_t index = 0; index < list.size(); ++index)
        list[index] = index;
    return list;
}

inline void collect_log(plait_log_level, const char* text, void* user) {
    static_cast<std::string*>(user)->append(text).append("\n");
}

struct OpenOptions {
    std::vector<plait_stage_source> sources = {};
    const void* native = nullptr;
    bool profile = false;
    Calls calls = {};
    std::string* log = nullptr;
};

inline Result<std::unique_ptr<Device>> open_device(uint32_t index,
                                                   const OpenOptions& options = {}) {
    plait_open_info info{};
    info.struct_size = sizeof info;
    info.device_index = index;
    info.profile = options.profile;
    info.log = options.log ? collect_log : nullptr;
    info.log_user = options.log;
    info.stage_sources = options.sources.data();
    info.stage_source_count = options.sources.size();
    info.native = options.native;
    return Device::open(info, options.calls);
}

// Tests of this class run once on each device; there must be one.
class OnDevice : public ::testing::TestWithParam<uint32_t> {};

} // namespace plait::opencl
