/* pins: where the targets of pins are at the end of a fixed step, on their straight way through the
 * time between two calls.
 *
 * Items   vertices.
 * Reads   pin_at, pin.
 * Writes  pin_to.
 */
#include "common/pin.clh"

__kernel void plait_pins(const uint item_count, const plait_pins_params params,
                         __global const float4* pin_at, __global const float4* pin,
                         __global float4* pin_to) {
    const uint i = get_global_id(0);
    if (i >= item_count)
        return;
    const float4 to = pin[i];
    pin_to[i] = pin_between(pin_at[i], to, params.alpha);
}
