// What stages.def asks of this backend: for stage X an argument struct X_args with one checked view
// per buffer, and the function X to be defined in X.cpp. A stage without one does not link.
#pragma once

#include "backend/reference/base/math.hpp"

#include <plait/plait_backend.h>

#include <cstdint>

namespace plait::reference {

#define PLAIT_VIEW_FLOAT double
#define PLAIT_VIEW_FLOAT4 Vec4
#define PLAIT_VIEW_UINT uint32_t
#define PLAIT_VIEW_REAL double
#define PLAIT_MEMBER_READ(name, type) View<const type> name;
#define PLAIT_MEMBER_WRITE(name, type) View<type> name;
#define PLAIT_MEMBER_READWRITE(name, type) View<type> name;
#define PLAIT_MEMBER_LOCAL(name, type)

#define PLAIT_STAGE(name, space, params, summary)                                                  \
    struct name##_args {                                                                           \
        using Params = params;
#define PLAIT_ARG(stage, name, element, access) PLAIT_MEMBER_##access(name, PLAIT_VIEW_##element)
#define PLAIT_STAGE_END(name)                                                                      \
    }                                                                                              \
    ;                                                                                              \
    void name(uint32_t item_count, const name##_args::Params& params, const name##_args& args);
#include <plait/stages.def>

#undef PLAIT_VIEW_FLOAT
#undef PLAIT_VIEW_FLOAT4
#undef PLAIT_VIEW_UINT
#undef PLAIT_VIEW_REAL
#undef PLAIT_MEMBER_READ
#undef PLAIT_MEMBER_WRITE
#undef PLAIT_MEMBER_READWRITE
#undef PLAIT_MEMBER_LOCAL

// A vertex by the number of its item: strand * V + index.
struct StrandVertex {
    size_t strand;
    uint32_t index;
};

inline StrandVertex strand_vertex(size_t item, uint32_t vertex_stride) {
    return {item / vertex_stride, static_cast<uint32_t>(item % vertex_stride)};
}

// Vertices of a strand; refuses a count that does not fit its row.
inline uint32_t vertices_of(const View<const uint32_t>& vertex_count, size_t strand,
                            uint32_t vertex_stride) {
    const uint32_t count = vertex_count[strand];
    if (count < PLAIT_MIN_VERTICES || count > vertex_stride)
        throw BadDispatch(
            format("vertex_count[%zu] is %u, allowed 2..%u", strand, count, vertex_stride));
    return count;
}

} // namespace plait::reference
