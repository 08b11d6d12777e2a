// pins: targets on their straight way between two calls.
#include "backend/reference/pin.hpp"
#include "backend/reference/stages.hpp"

namespace plait::reference {

void pins(uint32_t item_count, const plait_pins_params& params, const pins_args& args) {
    for (size_t i = 0; i < item_count; ++i)
        args.pin_to[i] = on_its_way(args.pin_at[i], args.pin[i], params.alpha);
}

} // namespace plait::reference
