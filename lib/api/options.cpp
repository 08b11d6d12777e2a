// Rules of importing.
#include "api/options.hpp"

#include "api/structs.hpp"

#include <plait/params.h>

namespace plait::api {

plait_import_options default_options() {
    plait_import_options options{};
    options.struct_size = sizeof options;
    options.min_segment = 1e-3f;
    options.scale = 1;
    return options;
}

Status read_options(const plait_import_options* given, plait_import_options& options) {
    options = default_options();
    if (!given)
        return {};
    PLAIT_TRY(read_struct(given, options, "options"));
    uint32_t policy; // any number may come from C
    std::memcpy(&policy, &options.policy, sizeof policy);
    if (policy > PLAIT_REPAIR_POLICY_REFUSE)
        return invalid(format("options->policy is %u, range is [0, 1]", policy));
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
