// Rules of importing.
#include "api/options.hpp"

#include "api/structs.hpp"
#include "core/base/pose.hpp"

#include <plait/params.h>

namespace plait::api {

plait_import_options default_options() {
    plait_import_options options{};
    options.struct_size = sizeof options;
    options.min_segment = 1e-3f;
    options.scale = 1;
    options.pose = identity_pose;
    return options;
}

namespace {

// Any number may come from C.
template <typename Enum> Status check_choice(const char* field, const Enum& value, uint32_t most) {
    uint32_t number;
    static_assert(sizeof number == sizeof value);
    std::memcpy(&number, &value, sizeof number);
    if (number <= most)
        return {};
    return invalid(format("options->%s is %u, range is [0, %u]", field, number, most));
}

} // namespace

Status read_options(const plait_import_options* given, plait_import_options& options) {
    options = default_options();
    if (!given)
        return {};
    PLAIT_TRY(read_struct(given, options, "options"));
    PLAIT_TRY(check_choice("policy", options.policy, PLAIT_REPAIR_POLICY_REFUSE));
    PLAIT_TRY(check_choice("axes", options.axes, PLAIT_AXES_Z_UP_LEFT_HANDED));
    PLAIT_TRY(check_choice("root_end", options.root_end, PLAIT_ROOT_END_AGREED));
    const auto pose = checked_pose(options.pose, "options->pose");
    if (!pose)
        return pose.error();
    options.pose = *pose;
    if (!(options.min_segment >= 0 && options.min_segment <= 0.5f))
        return invalid(
            format("options->min_segment is %g, range is [0, 0.5]", double(options.min_segment)));
    if (!(options.scale > 0 && options.scale <= 1e6f))
        return invalid(format("options->scale is %g, range is (0, 1e6]", double(options.scale)));
    if (options.resample != 0 &&
        (options.resample < PLAIT_MIN_VERTICES || options.resample > PLAIT_MAX_VERTICES))
        return invalid(format("options->resample is %u, range is 0 or [2, 256]", options.resample));
    return check_allocator(options.allocator, "options->allocator");
}

} // namespace plait::api

extern "C" {

void plait_import_options_init(plait_import_options* options, size_t size) {
    plait::api::init_struct(options, size, plait::api::default_options());
}
}
