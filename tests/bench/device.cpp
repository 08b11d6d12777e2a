#include "device.hpp"

#include <string_view>

namespace bench {

const plait_backend_api& opencl() {
    for (size_t index = 0; index < plait_backend_count(); ++index)
        if (std::string_view(plait_backend_get(index)->name) == "opencl")
            return *plait_backend_get(index);
    throw std::runtime_error("plait was built without the OpenCL backend");
}

std::vector<plait_device_info> opencl_devices() {
    size_t count = 0;
    if (opencl().enumerate(nullptr, &count) != PLAIT_OK || count == 0)
        throw std::runtime_error("there is no OpenCL device");
    std::vector<plait_device_info> devices(count);
    if (opencl().enumerate(devices.data(), &count) != PLAIT_OK)
        throw std::runtime_error("the OpenCL devices cannot be listed");
    return devices;
}

Device::Device(uint32_t index, std::span<const plait_stage_source> sources) {
    plait_open_info info{};
    info.struct_size = sizeof info;
    info.device_index = index;
    info.stage_sources = sources.data();
    info.stage_source_count = sources.size();
    plait_device* device = nullptr;
    char error[4096] = "";
    if (opencl().open(&info, &device, error, sizeof error) != PLAIT_OK)
        throw std::runtime_error(error);
    device_.reset(device);
}

Device::Buffer Device::make(plait_element element, const char* name,
                            std::span<const uint32_t> words) {
    const size_t count = words.size() / (element == PLAIT_ELEMENT_FLOAT4 ? 4 : 1);
    const plait_buffer_desc desc{element, count, name};
    plait_buffer* buffer = nullptr;
    check(opencl().device->buffer_create(device_.get(), &desc, &buffer));
    Buffer owned(buffer, Release{device_.get()});
    check(opencl().device->buffer_write(device_.get(), buffer, 0, count, words.data()));
    return owned;
}

void Device::submit(std::span<const plait_dispatch> list) {
    check(opencl().device->submit(device_.get(), list.data(), list.size()));
}

void Device::wait() {
    check(opencl().device->wait(device_.get()));
}

void Device::check(plait_result result) const {
    if (result != PLAIT_OK)
        throw std::runtime_error(opencl().device->last_error(device_.get()));
}

} // namespace bench
