#include "faulty.hpp"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <stdexcept>

namespace {

Faults faults;
const char* injected = nullptr; // the sentence of the last injected failure

const plait_backend_api& inner() {
    for (size_t i = 0; i < plait_backend_count(); ++i)
        if (std::strcmp(plait_backend_get(i)->name, "reference") == 0)
            return *plait_backend_get(i);
    throw std::logic_error("no reference backend");
}

plait_result buffer_create(plait_device* device, const plait_buffer_desc* desc,
                           plait_buffer** out) {
    if (faults.fail_create_after == 0) {
        injected = "no room (injected)";
        return PLAIT_OUT_OF_MEMORY;
    }
    if (faults.fail_create_after > 0)
        --faults.fail_create_after;
    injected = nullptr;
    ++faults.live_buffers;
    return inner().device->buffer_create(device, desc, out);
}

void buffer_destroy(plait_device* device, plait_buffer* buffer) {
    --faults.live_buffers;
    inner().device->buffer_destroy(device, buffer);
}

plait_result submit(plait_device* device, const plait_dispatch* list, size_t count) {
    if (faults.lose_after == 0) {
        injected = "unplugged (injected)";
        return PLAIT_DEVICE_LOST;
    }
    if (faults.lose_after > 0)
        --faults.lose_after;
    for (size_t i = 0; i < count; ++i)
        faults.submitted[list[i].stage] |= list[i].item_count > 0;
    injected = nullptr;
    return inner().device->submit(device, list, count);
}

plait_result buffer_upload(plait_device* device, plait_buffer* buffer, size_t first, size_t count,
                           const void* src) {
    if (faults.fail_upload_after == 0) {
        injected = "no way there (injected)";
        return PLAIT_OUT_OF_MEMORY;
    }
    if (faults.fail_upload_after > 0)
        --faults.fail_upload_after;
    injected = nullptr;
    return inner().device->buffer_upload(device, buffer, first, count, src);
}

int supports(plait_device* device, plait_stage stage) {
    return stage != faults.missing && inner().device->supports(device, stage);
}

plait_result prepare(plait_device* device, const plait_dispatch* list, size_t count) {
    for (size_t i = 0; i < count; ++i)
        if (!supports(device, list[i].stage)) {
            injected = "no such stage (injected)";
            return PLAIT_UNSUPPORTED;
        }
    for (size_t i = 0; i < count; ++i)
        faults.prepared[list[i].stage] |= list[i].item_count > 0;
    injected = nullptr;
    return inner().device->prepare(device, list, count);
}

const char* last_error(plait_device* device) {
    return injected ? injected : inner().device->last_error(device);
}

void destroy(plait_device* device) {
    --faults.live_devices;
    inner().device->destroy(device);
}

plait_result open(const plait_open_info* info, plait_device** out, char* error, size_t size) {
    const plait_result result = inner().open(info, out, error, size);
    faults.live_devices += result == PLAIT_OK;
    return result;
}

int score() {
    return -100;
}

void register_faulty() {
    static plait_device_api device = *inner().device;
    device.buffer_create = buffer_create;
    device.buffer_destroy = buffer_destroy;
    device.buffer_upload = buffer_upload;
    device.supports = supports;
    device.submit = submit;
    device.prepare = prepare;
    device.last_error = last_error;
    device.destroy = destroy;
    static plait_backend_api api = inner();
    api.name = "faulty";
    api.score = score;
    api.open = open;
    api.device = &device;
    if (plait_backend_register(&api) != PLAIT_OK)
        throw std::logic_error(plait_last_error());
}

} // namespace

Faults& faulty() {
    static const bool registered = (register_faulty(), true);
    (void)registered;
    faults.fail_create_after = faults.lose_after = faults.fail_upload_after = -1;
    faults.missing = PLAIT_STAGE_COUNT;
    std::fill(std::begin(faults.prepared), std::end(faults.prepared), false);
    std::fill(std::begin(faults.submitted), std::end(faults.submitted), false);
    return faults;
}
