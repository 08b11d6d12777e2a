// strand_data: the rigid motion (q, t) that carries the root segment from the previous step to this
// one, and the blend c with which velocity_shock hands it to the rest of the strand.
//   q = turn of the segment,  t = x0 - q prev0,  a = |x1 - 2 prev1 + prev2_1|
// The published c jumps from vsp_coeff to 1 where a passes the threshold; the continuous form rises
// linearly over one more threshold, so that the response has no step in it.
#include "backend/reference/base/stages.hpp"

#include <algorithm>

namespace plait::reference {
namespace {

double shock_blend(double acceleration, const plait_strand_data_params& params) {
    const double coeff = params.vsp_coeff;
    const double threshold = params.vsp_accel_threshold;
    if (acceleration <= threshold)
        return coeff;
    if (params.shock_form == PLAIT_SHOCK_THRESHOLD || threshold <= 0)
        return 1;
    return coeff + (1 - coeff) * std::min(1.0, acceleration / threshold - 1);
}

} // namespace

void strand_data(uint32_t item_count, const plait_strand_data_params& params,
                 const strand_data_args& args) {
    for (size_t strand = 0; strand < item_count; ++strand) {
        const size_t root = strand * params.vertex_stride;
        const Vec3 x0 = xyz(args.position[root]), x1 = xyz(args.position[root + 1]);
        const Vec3 p0 = xyz(args.position_prev[root]), p1 = xyz(args.position_prev[root + 1]);
        const Quat q = turn(p1 - p0, x1 - x0);
        const Vec3 second_difference = x1 - 2 * p1 + xyz(args.position_prev2[root + 1]);
        store_pose(args.strand_motion, strand, {q, x0 - q * p0});
        args.strand_motion[2 * strand + 1].w() = shock_blend(second_difference.norm(), params);
    }
}

} // namespace plait::reference
