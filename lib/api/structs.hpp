// Versioned structs: callers built with another version of plait.h pass another struct_size.
#pragma once

#include "api/wall.hpp"

#include <algorithm>
#include <cstring>
#include <memory_resource>
#include <type_traits>
#include <vector>

namespace plait::api {

template <typename T> bool is_struct_size(size_t size) {
    return size >= alignof(T) && size <= PLAIT_STRUCT_SIZE_MAX && size % alignof(T) == 0;
}

// A known prefix is accepted (the rest keeps the defaults already in `out`); a longer struct only
// if what this library does not know is zero.
template <typename T> Status read_struct(const T* in, T& out, const char* name) {
    static_assert(std::is_trivially_copyable_v<T> && sizeof(T) <= PLAIT_STRUCT_SIZE_MAX);
    PLAIT_TRY(need(in, name));
    const size_t size = in->struct_size;
    if (!is_struct_size<T>(size))
        return invalid(format("%s->struct_size is %zu, range is [%zu, %d] in steps of %zu: "
                              "fill the struct with its _init",
                              name, size, alignof(T), PLAIT_STRUCT_SIZE_MAX, alignof(T)));
    const auto* bytes = reinterpret_cast<const unsigned char*>(in);
    for (size_t i = sizeof(T); i < size; ++i)
        if (bytes[i] != 0)
            return invalid(format("%s->struct_size is %zu, this library knows %zu bytes and byte "
                                  "%zu beyond them is not zero",
                                  name, size, sizeof(T), i));
    std::memcpy(&out, in, std::min(size, sizeof(T)));
    out.struct_size = sizeof(T);
    return {};
}

// Writes what the caller's struct has room for; its struct_size stays.
template <typename T> void write_struct(T* out, const T& value) {
    const uint32_t size = out->struct_size;
    std::memcpy(out, &value, std::min<size_t>(size, sizeof(T)));
    out->struct_size = size;
}

template <typename T> Status check_output(const T* out, const char* name) {
    PLAIT_TRY(need(out, name));
    if (is_struct_size<T>(out->struct_size))
        return {};
    return invalid(format("%s->struct_size is %u, range is [%zu, %d] in steps of %zu: set it to "
                          "sizeof *%s",
                          name, out->struct_size, alignof(T), PLAIT_STRUCT_SIZE_MAX, alignof(T),
                          name));
}

// Appends a list of structs, which lie as far apart as the first one's struct_size says; what the
// caller's do not have is as in `defaults`.
template <typename T>
Status read_structs(const T* in, size_t number, const char* name, const T& defaults,
                    std::pmr::vector<T>& out) {
    if (number > 0)
        PLAIT_TRY(need(in, name));
    const auto* const bytes = reinterpret_cast<const unsigned char*>(in);
    for (size_t i = 0; i < number; ++i) {
        const auto* element = reinterpret_cast<const T*>(bytes + i * size_t{in->struct_size});
        out.push_back(defaults);
        PLAIT_TRY(read_struct(element, out.back(), format("%s[%zu]", name, i).c_str()));
        if (element->struct_size != in->struct_size)
            return invalid(format("%s[%zu].struct_size is %u, that of the first is %u", name, i,
                                  element->struct_size, in->struct_size));
    }
    return {};
}

// A list of structs: elements lie as far apart as the first one's struct_size says, and all have
// the same. `at`(i): what element i becomes.
template <typename T, typename At>
Status write_structs(T* dst, size_t number, const char* name, const At& at) {
    auto* const bytes = reinterpret_cast<unsigned char*>(dst);
    const auto element = [&](size_t i) {
        return reinterpret_cast<T*>(bytes + i * size_t{dst->struct_size});
    };
    if (number > 0)
        PLAIT_TRY(check_output(dst, name));
    for (size_t i = 1; i < number; ++i)
        if (element(i)->struct_size != dst->struct_size)
            return invalid(format("%s[%zu].struct_size is %u, that of the first is %u", name, i,
                                  element(i)->struct_size, dst->struct_size));
    for (size_t i = 0; i < number; ++i)
        write_struct(element(i), at(i));
    return {};
}

// plait_x_init: writes the defaults into a struct of `size` bytes, zeroes beyond them.
template <typename T> void init_struct(T* out, size_t size, const T& defaults) {
    if (!out || size < sizeof(uint32_t))
        return;
    std::memset(out, 0, size);
    std::memcpy(out, &defaults, std::min(size, sizeof(T)));
    out->struct_size = static_cast<uint32_t>(size);
}

inline Status check_allocator(const plait_allocator& allocator, const char* name) {
    if (!allocator.allocate == !allocator.release)
        return {};
    return invalid(format("%s: %s is NULL, set both functions or neither", name,
                          allocator.allocate ? "release" : "allocate"));
}

// The size-query idiom over bytes: true if `dst` is to be filled; otherwise *size says how much.
inline Result<bool> wants_bytes(const void* dst, size_t* size, size_t needed) {
    PLAIT_TRY(need(size, "size"));
    if (!dst) {
        *size = needed;
        return false;
    }
    if (*size < needed)
        return invalid(format("*size is %zu bytes, %zu are needed", *size, needed));
    *size = needed;
    return true;
}

// At most *count rows of a list; *count is then how many were written, or, without dst, how many there are.
template <typename T, typename At>
Status write_list(T* dst, size_t* count, size_t number, const At& at) {
    PLAIT_TRY(need(count, "count"));
    if (dst) {
        number = std::min(*count, number);
        PLAIT_TRY(write_structs(dst, number, "dst", at));
    }
    *count = number;
    return {};
}

} // namespace plait::api
