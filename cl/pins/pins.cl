/* pins: where the targets of pins are at the end of a fixed step, on their straight way through the
 * time between two calls.
 *
 * Items   vertices.
 * Reads   pin_at, pin: targets in the world times a scale each, to the groom's units.
 * Writes  pin_to.
 */
#include "pins/pin.clh"

static inline float4 in_units(float4 pin, float scale) {
    return pin.w > 0.0f ? (float4)(scale * pin.xyz, pin.w) : pin;
}

__kernel void plait_pins(const uint item_count, const plait_pins_params params,
                         __global const float4* pin_at, __global const float4* pin,
                         __global float4* pin_to) {
    const uint i = get_global_id(0);
    if (i >= item_count)
        return;
    pin_to[i] = pin_between(in_units(pin_at[i], params.at_scale),
                            in_units(pin[i], params.target_scale), params.alpha);
}
