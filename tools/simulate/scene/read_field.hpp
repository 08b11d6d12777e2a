// What a groom, a mesh or a map of follows has, as a vector.
#pragma once

#include "common.hpp"

#include <plait/plait_offline.h>

#include <vector>

namespace simulate {

inline plait_result read_into(const plait_groom* groom, plait_groom_field field, void* dst,
                              size_t* size) {
    return plait_groom_read(groom, field, dst, size);
}
inline plait_result read_into(const plait_mesh* mesh, plait_mesh_field field, void* dst,
                              size_t* size) {
    return plait_mesh_read(mesh, field, dst, size);
}
inline plait_result read_into(const plait_follow_map* map, plait_follow_map_field field, void* dst,
                              size_t* size) {
    return plait_follow_map_read(map, field, dst, size);
}

template <typename T, typename Object, typename Field>
std::vector<T> read_field(const Object* object, Field field) {
    size_t size = 0;
    check(read_into(object, field, nullptr, &size));
    std::vector<T> data(size / sizeof(T));
    check(read_into(object, field, data.data(), &size));
    return data;
}

} // namespace simulate
