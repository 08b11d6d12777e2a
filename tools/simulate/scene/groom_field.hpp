// What a groom has, as a vector.
#pragma once

#include "common.hpp"

#include <plait/plait.h>

#include <vector>

namespace simulate {

template <typename T> std::vector<T> read_field(const plait_groom* groom, plait_groom_field field) {
    size_t size = 0;
    check(plait_groom_read(groom, field, nullptr, &size));
    std::vector<T> data(size / sizeof(T));
    check(plait_groom_read(groom, field, data.data(), &size));
    return data;
}

} // namespace simulate
