// The files of cl/ as they were when the library was built.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace plait::opencl {

struct EmbeddedFile {
    std::string_view name; // "cl/tressfx/tressfx_wind.cl", "cl/shared/plait/params.h"
    const unsigned char* bytes;
    size_t size;

    std::string_view text() const { return {reinterpret_cast<const char*>(bytes), size}; }
};

std::span<const EmbeddedFile> embedded_files();

} // namespace plait::opencl
