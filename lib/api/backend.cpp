// plait_backend.h: the registry. The stage table is in lib/backend.
#include "backend/registry.hpp"

#include "api/wall.hpp"

using namespace plait;

extern "C" {

plait_result plait_backend_register(const plait_backend_api* backend) {
    return api::guard(__func__, [&] { return register_backend(backend); });
}

plait_result plait_backend_load(const char* path) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(path, "path"));
        return load_backend(path);
    });
}

size_t plait_backend_count(void) {
    return backend_count();
}

const plait_backend_api* plait_backend_get(size_t index) {
    return backend_at(index);
}
}
