#include "backend/module.hpp"

#include "base/format.hpp"
#include "base/path.hpp"

#ifdef _WIN32
#define WIN32_LEAN_AND_MEAN
#ifndef NOMINMAX // which the libstdc++ of MinGW defines
#define NOMINMAX
#endif
#include <windows.h>

#include <system_error>
#else
#include <dlfcn.h>
#endif

namespace plait {

#ifdef _WIN32

Result<void*> open_module(const char* path) {
    if (const HMODULE module = LoadLibraryW(native_path(path).c_str()))
        return reinterpret_cast<void*>(module);
    const std::string why = std::system_category().message(static_cast<int>(GetLastError()));
    return Error{PLAIT_NOT_FOUND, format("backend module %s: %s", path, why.c_str())};
}

void* find_symbol(void* module, const char* name) {
    return reinterpret_cast<void*>(GetProcAddress(reinterpret_cast<HMODULE>(module), name));
}

#else

Result<void*> open_module(const char* path) {
    if (void* const module = dlopen(path, RTLD_NOW | RTLD_LOCAL))
        return module;
    return Error{PLAIT_NOT_FOUND, format("backend module %s: %s", path, dlerror())};
}

void* find_symbol(void* module, const char* name) {
    return dlsym(module, name);
}

#endif

} // namespace plait
