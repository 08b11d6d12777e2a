#include "ceiling.hpp"

#include "common.hpp"

#include <plait/plait_backend.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <vector>

namespace simulate {

namespace {

const plait_backend_api& backend_of(const plait_device_info& device) {
    for (size_t i = 0; i < plait_backend_count(); ++i)
        if (std::strcmp(plait_backend_get(i)->name, device.backend) == 0)
            return *plait_backend_get(i);
    throw Failure(std::string("no backend is called ") + device.backend);
}

uint32_t index_of(const plait_backend_api& backend, const plait_device_info& device) {
    size_t count = 0;
    if (backend.enumerate(nullptr, &count) != PLAIT_OK)
        count = 0;
    std::vector<plait_device_info> list(count, plait_device_info_defaults());
    if (count > 0 && backend.enumerate(list.data(), &count) != PLAIT_OK)
        count = 0;
    for (size_t i = 0; i < count; ++i)
        if (std::strcmp(list[i].name, device.name) == 0 &&
            std::strcmp(list[i].platform, device.platform) == 0)
            return static_cast<uint32_t>(i);
    throw Failure(std::string("the device ") + device.name + " is not there a second time",
                  Exit::device_failure);
}

struct Release {
    const plait_device_api* api = nullptr;
    plait_device* device = nullptr;
    void operator()(plait_buffer* buffer) const { api->buffer_destroy(device, buffer); }
};

// A backend's device on its own, which runs `last_frame` over vertices.
class Copier {
  public:
    Copier(const plait_backend_api& backend, uint32_t index, size_t vertices)
        : api_(*backend.device), vertices_(vertices) {
        plait_open_info info{};
        info.struct_size = sizeof info;
        info.device_index = index;
        info.profile = 1;
        char error[4096] = "";
        plait_device* device = nullptr;
        if (backend.open(&info, &device, error, sizeof error) != PLAIT_OK)
            throw Failure(error, Exit::device_failure);
        device_ = {device, api_.destroy};
        for (auto& buffer : buffers_) {
            const plait_buffer_desc desc{PLAIT_ELEMENT_FLOAT4, vertices, "copied"};
            plait_buffer* made = nullptr;
            check(api_.buffer_create(device, &desc, &made));
            buffer = {made, Release{&api_, device}};
        }
    }

    // Seconds; 0 where they are not known.
    double copy(size_t from) {
        const plait_last_frame_params params{2, 1}; // the stage does not look at rows
        plait_buffer* const pair[] = {buffers_[from].get(), buffers_[1 - from].get()};
        const plait_dispatch copy{PLAIT_STAGE_last_frame,
                                  static_cast<uint32_t>(vertices_),
                                  1,
                                  &params,
                                  sizeof params,
                                  2,
                                  pair,
                                  0};
        plait_stage_launch launch{};
        size_t count = 0;
        check(api_.submit(device_.get(), &copy, 1));
        check(api_.take_launches(device_.get(), nullptr, &count));
        count = 1;
        check(api_.take_launches(device_.get(), &launch, &count));
        return 1e-9 * static_cast<double>(launch.end_ns - launch.begin_ns);
    }

  private:
    void check(plait_result result) const {
        if (result != PLAIT_OK)
            throw Failure(api_.last_error(device_.get()), exit_of(result));
    }

    const plait_device_api& api_;
    size_t vertices_;
    std::unique_ptr<plait_device, void (*)(plait_device*)> device_{nullptr, nullptr};
    std::array<std::unique_ptr<plait_buffer, Release>, 2> buffers_;
};

// 256 MiB each on a GPU, whose caches hold 50 and more; 64 on a CPU.
size_t bytes_to_copy(const plait_device_info& device) {
    const uint64_t wanted = (device.type == PLAIT_DEVICE_TYPE_GPU ? 256ull : 64ull) << 20;
    return device.memory_bytes > 0 ? std::min(wanted, device.memory_bytes / 16) : wanted;
}

} // namespace

double copy_rate(const plait_device_info& device) {
    const plait_backend_api& backend = backend_of(device);
    const size_t vertices = bytes_to_copy(device) / (4 * sizeof(float));
    Copier copier(backend, index_of(backend, device), vertices);
    // Both ways once, so that both arrays have memory of their own: what was never written may be
    // one page of zeros.
    copier.copy(0);
    copier.copy(1);
    double best = 0;
    for (size_t i = 0; i < 8; ++i) {
        const double seconds = copier.copy(i % 2);
        if (seconds > 0 && (best == 0 || seconds < best))
            best = seconds;
    }
    return best > 0 ? 2.0 * 4 * sizeof(float) * static_cast<double>(vertices) / best : 0.0;
}

} // namespace simulate
