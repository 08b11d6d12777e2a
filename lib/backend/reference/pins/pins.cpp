// pins: targets on their straight way between two calls.
#include "backend/reference/base/stages.hpp"
#include "backend/reference/pins/pin.hpp"

namespace plait::reference {
namespace {

// A target in the world, in the groom's units.
Vec4 scaled(const Vec4& pin, double scale) {
    return pin.w() > 0 ? with_w(scale * xyz(pin), pin.w()) : pin;
}

} // namespace

void pins(uint32_t item_count, const plait_pins_params& params, const pins_args& args) {
    for (size_t i = 0; i < item_count; ++i)
        args.pin_to[i] = on_its_way(scaled(args.pin_at[i], params.at_scale),
                                    scaled(args.pin[i], params.target_scale), params.alpha);
}

} // namespace plait::reference
