// The stage table of plait_backend.h, generated from stages.def.
#include <plait/plait_backend.h>

#include <algorithm>
#include <iterator>

namespace {

#define PLAIT_STAGE(name, space, params, summary) constexpr plait_stage_arg name##_args[] = {
#define PLAIT_ARG(stage, name, element, access)                                                    \
    {#name, PLAIT_ELEMENT_##element, PLAIT_ACCESS_##access},
#define PLAIT_STAGE_END(stage)                                                                     \
    }                                                                                              \
    ;
#include <plait/stages.def>

template <size_t N> constexpr uint32_t count_buffers(const plait_stage_arg (&args)[N]) {
    return static_cast<uint32_t>(std::count_if(
        args, args + N, [](const plait_stage_arg& a) { return a.access != PLAIT_ACCESS_LOCAL; }));
}

constexpr plait_stage_info stages[] = {
#define PLAIT_STAGE(name, space, params, summary)                                                  \
    {PLAIT_STAGE_##name,                                                                           \
     #name,                                                                                        \
     "plait_" #name,                                                                               \
     #params,                                                                                      \
     summary,                                                                                      \
     PLAIT_SPACE_##space,                                                                          \
     sizeof(params),                                                                               \
     static_cast<uint32_t>(std::size(name##_args)),                                                \
     count_buffers(name##_args),                                                                   \
     name##_args},
#include <plait/stages.def>
};
static_assert(std::size(stages) == PLAIT_STAGE_COUNT);

} // namespace

extern "C" const plait_stage_info* plait_stage_describe(plait_stage stage) {
    const auto index = static_cast<size_t>(stage);
    return index < std::size(stages) ? &stages[index] : nullptr;
}
