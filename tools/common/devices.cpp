#include "common/devices.hpp"
#include "common/failure.hpp"

#include <cstdio>
#include <vector>

namespace common {

const char* type_name(plait_device_type type) {
    return type == PLAIT_DEVICE_TYPE_CPU ? "CPU" : type == PLAIT_DEVICE_TYPE_GPU ? "GPU" : "other";
}

void print_devices() {
    size_t count = 0;
    check(plait_devices_list(nullptr, &count));
    std::vector<plait_device_info> devices(count);
    for (plait_device_info& device : devices)
        device.struct_size = sizeof device;
    check(plait_devices_list(devices.data(), &count));
    devices.resize(count);
    for (const plait_device_info& device : devices)
        std::printf("%-10s %-5s %-40s %s, %u units\n", device.backend, type_name(device.type),
                    device.name, device.platform, device.compute_units);
}

} // namespace common
