#include "backend/registry.hpp"

#include "backend/builtin.hpp"
#include "backend/module.hpp"
#include "base/format.hpp"

#include <cstddef>
#include <cstring>
#include <initializer_list>
#include <mutex>
#include <vector>

namespace plait {
namespace {

using Provider = const plait_backend_api* (*)();

constexpr std::initializer_list<Provider> built_in = {
#if defined(PLAIT_WITH_OPENCL)
    opencl_backend,
#endif
#if defined(PLAIT_WITH_REFERENCE)
    reference_backend,
#endif
};

// Backends are per process by contract: a registered one serves every context made later.
struct Registered {
    std::mutex mutex;
    std::vector<const plait_backend_api*> list;
};

Registered& registered() {
    static Registered instance;
    return instance;
}

Error refused(const char* name, const std::string& why) {
    return {PLAIT_INVALID_ARGUMENT, format("backend \"%s\": %s", name, why.c_str())};
}

const char* missing_function(const plait_device_api& device) {
#define PLAIT_NEED(member)                                                                         \
    if (!device.member)                                                                            \
        return "device->" #member;
    PLAIT_NEED(destroy)
    PLAIT_NEED(describe)
    PLAIT_NEED(supports)
    PLAIT_NEED(buffer_create)
    PLAIT_NEED(buffer_destroy)
    PLAIT_NEED(buffer_write)
    PLAIT_NEED(buffer_upload)
    PLAIT_NEED(buffer_read)
    PLAIT_NEED(submit)
    PLAIT_NEED(prepare)
    PLAIT_NEED(wait)
    PLAIT_NEED(stage_costs)
    PLAIT_NEED(take_launches)
    PLAIT_NEED(last_error)
    PLAIT_NEED(native_buffer)
    PLAIT_NEED(native_queue)
#undef PLAIT_NEED
    return nullptr;
}

const char* missing_function(const plait_backend_api& api) {
    if (!api.score)
        return "score";
    if (!api.enumerate)
        return "enumerate";
    if (!api.open)
        return "open";
    return api.device ? nullptr : "device";
}

Status check(const plait_backend_api* api) {
    if (!api)
        return Error{PLAIT_INVALID_ARGUMENT, "backend: api is NULL"};
    if (api->abi != PLAIT_BACKEND_ABI)
        return refused("?", format("abi is %u, this library has %d", api->abi, PLAIT_BACKEND_ABI));
    if (api->struct_size != sizeof(plait_backend_api))
        return refused("?", format("struct_size is %u, this library has %zu", api->struct_size,
                                   sizeof(plait_backend_api)));
    if (!api->name || !*api->name)
        return refused("?", "name is empty");
    if (std::strlen(api->name) >= sizeof(plait_device_info::backend))
        return refused(api->name,
                       format("name is %zu characters long, range is [1, %zu]",
                              std::strlen(api->name), sizeof(plait_device_info::backend) - 1));
    if (const char* missing = missing_function(*api))
        return refused(api->name, format("%s is NULL", missing));
    constexpr size_t least = offsetof(plait_device_api, overlap); // the first optional one
    if (api->device->struct_size < least || api->device->struct_size > sizeof(plait_device_api))
        return refused(api->name,
                       format("device->struct_size is %u, this library has %zu to %zu",
                              api->device->struct_size, least, sizeof(plait_device_api)));
    if (const char* missing = missing_function(*api->device))
        return refused(api->name, format("%s is NULL", missing));
    return {};
}

bool same_name(const plait_backend_api* a, const plait_backend_api* b) {
    return std::strcmp(a->name, b->name) == 0;
}

} // namespace

size_t backend_count() {
    const std::scoped_lock lock(registered().mutex);
    return built_in.size() + registered().list.size();
}

const plait_backend_api* backend_at(size_t index) {
    if (index < built_in.size())
        return built_in.begin()[index]();
    index -= built_in.size();
    const std::scoped_lock lock(registered().mutex);
    return index < registered().list.size() ? registered().list[index] : nullptr;
}

Status register_backend(const plait_backend_api* api) {
    PLAIT_TRY(check(api));
    const std::scoped_lock lock(registered().mutex);
    for (const Provider provider : built_in)
        if (same_name(provider(), api))
            return refused(api->name, "the name is taken by a built-in backend");
    for (const plait_backend_api* other : registered().list)
        if (same_name(other, api))
            return refused(api->name, "the name is taken by a registered backend");
    registered().list.push_back(api);
    return {};
}

// The module stays mapped even when it is refused: a driver it has loaded may have left threads.
Status load_backend(const char* path) {
    const auto module = open_module(path);
    PLAIT_TRY(module);
    constexpr const char* symbol = "plait_backend_entry_v1";
    const auto entry = reinterpret_cast<Provider>(find_symbol(*module, symbol));
    if (!entry)
        return Error{PLAIT_UNSUPPORTED, format("backend module %s has no %s", path, symbol)};
    if (auto status = register_backend(entry()); !status)
        return Error{status.error().code, format("%s: %s", path, status.error().message.c_str())};
    return {};
}

} // namespace plait
