// A backend's device for measuring: opened from the registry, throwing what goes wrong.
#pragma once

#include <plait/plait_backend.h>

#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace bench {

const plait_backend_api& opencl(); // throws where the library was built without it
std::vector<plait_device_info> opencl_devices();

class Device {
  public:
    explicit Device(uint32_t index, std::span<const plait_stage_source> sources = {});

    struct Release {
        plait_device* device;
        void operator()(plait_buffer* buffer) const {
            opencl().device->buffer_destroy(device, buffer);
        }
    };
    using Buffer = std::unique_ptr<plait_buffer, Release>;

    // `words` are the elements' 32-bit components.
    Buffer make(plait_element element, const char* name, std::span<const uint32_t> words);
    void submit(std::span<const plait_dispatch> list);
    void wait();

  private:
    void check(plait_result result) const;

    struct Destroy {
        void operator()(plait_device* device) const { opencl().device->destroy(device); }
    };
    std::unique_ptr<plait_device, Destroy> device_;
};

} // namespace bench
