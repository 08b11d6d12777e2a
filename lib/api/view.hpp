// Arrays: input is checked, then copied out of whatever stride the caller has; output is bytes.
#pragma once

#include "api/wall.hpp"

#include <cstring>
#include <memory_resource>
#include <span>
#include <vector>

namespace plait::api {

inline Status check_view(const plait_view& view, size_t element_size, const char* name) {
    if (view.count > 0 && !view.data)
        return invalid(format("%s.data is NULL, %s.count is %zu", name, name, view.count));
    if (view.stride != 0 && view.stride < element_size)
        return invalid(format("%s.stride is %zu, range is 0 or at least %zu", name, view.stride,
                              element_size));
    if (view.count > PTRDIFF_MAX / (view.stride ? view.stride : element_size))
        return invalid(format("%s.count is %zu, more than memory can hold", name, view.count));
    return {};
}

// Appends the view's elements, each of `width` values of T.
template <typename T>
Status copy_view(const plait_view& view, size_t width, const char* name, std::pmr::vector<T>& to) {
    const size_t element_size = width * sizeof(T);
    PLAIT_TRY(check_view(view, element_size, name));
    const size_t stride = view.stride ? view.stride : element_size;
    to.resize(view.count * width);
    const auto* from = static_cast<const unsigned char*>(view.data);
    if (view.count > 0 && stride == element_size)
        std::memcpy(to.data(), from, view.count * element_size);
    for (size_t i = 0; stride != element_size && i < view.count; ++i)
        std::memcpy(to.data() + i * width, from + i * stride, element_size);
    return {};
}

template <typename T> std::span<const std::byte> bytes_of(const std::pmr::vector<T>& values) {
    return std::as_bytes(std::span(values.data(), values.size()));
}

} // namespace plait::api
