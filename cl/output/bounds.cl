/* bounds: the bounding box of a run of points; of all of them in a second pass, over the boxes.
 *
 * Items   runs of params.share elements.
 * Reads   points.
 * Writes  box.
 */
#include "plait/params.h"

__kernel void plait_bounds(const uint item_count, const plait_bounds_params params,
                           __global const float4* points, __global float4* box) {
    const uint item = get_global_id(0);
    if (item >= item_count)
        return;
    float3 least = (float3)(FLT_MAX), greatest = -least;
    const uint begin = item * params.share;
    const uint end = params.count - begin > params.share ? begin + params.share : params.count;
    const uint stride = params.boxes ? 2 : 1;
    for (uint i = begin; i < end; ++i) {
        const float3 low = points[(size_t)stride * i].xyz;
        const float3 high = points[(size_t)stride * i + stride - 1].xyz;
        if (all(isfinite(low)) && all(isfinite(high))) {
            least = fmin(least, low);
            greatest = fmax(greatest, high);
        }
    }
    box[2 * item] = (float4)(least, 0.0f);
    box[2 * item + 1] = (float4)(greatest, 0.0f);
}
