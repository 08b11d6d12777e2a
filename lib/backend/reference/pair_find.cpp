// pair_find: of a segment those others, the nearest first, whose distance d has
//   d <= f D + min(n |a - b|, R),
// f = PLAIT_PAIR_NEAR, D the diameter, n the substeps until the next search, a and b what the two
// nearest points move by in one, R the room. Segments of one strand with less than PLAIT_PAIR_ARC D
// of it between them are none. They stay apart by min(D, their distance at rest).
#include "backend/reference/pair.hpp"

#include <plait/constants.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

namespace plait::reference {
namespace {

class Search {
  public:
    Search(const plait_pair_params& params, const pair_find_args& args, uint32_t item)
        : params_(params), args_(args), item_(item), own_(segment_at(args.position, item)) {}

    // Distance and number of all that are near.
    std::vector<std::pair<double, uint32_t>> all() const {
        std::vector<std::pair<double, uint32_t>> list;
        for (const size_t cell : cells())
            for (size_t k = cell > 0 ? args_.cell_end[cell - 1] : 0; k < args_.cell_end[cell];
                 ++k) {
                const uint32_t other = args_.cell_segment[k];
                if (other != item_ && !is_beside(other))
                    if (const auto [distance, most] = distance_to(other); distance <= most)
                        list.emplace_back(distance, other);
            }
        std::ranges::sort(list);
        return list;
    }

  private:
    // In which the middle of a segment of two cells' length may lie that comes near.
    std::set<size_t> cells() const {
        const double reach = PLAIT_PAIR_NEAR * double(params_.diameter) + double(params_.room) +
                             double(params_.voxel_edge);
        const Cell low = cell_of(params_, own_.from.cwiseMin(own_.to) - Vec3::Constant(reach));
        const Cell high = cell_of(params_, own_.from.cwiseMax(own_.to) + Vec3::Constant(reach));
        const auto end = [&](size_t k) {
            return std::min(high[k], low[k] + int64_t{params_.edge_count} - 1);
        };
        std::set<size_t> list;
        for (int64_t z = low[2]; z <= end(2); ++z)
            for (int64_t y = low[1]; y <= end(1); ++y)
                for (int64_t x = low[0]; x <= end(0); ++x)
                    list.insert(number_of(params_, {x, y, z}));
        return list;
    }

    bool is_beside(uint32_t other) const {
        if (item_ / params_.vertex_stride != other / params_.vertex_stride)
            return false;
        const double between = std::abs(double(item_) - double(other)) - 1;
        const double length = (own_.length() + segment_at(args_.position, other).length()) / 2;
        return between * length < PLAIT_PAIR_ARC * double(params_.diameter);
    }

    std::pair<double, double> distance_to(uint32_t other) const {
        const Foot foot = nearest(own_, segment_at(args_.position, other));
        const Vec3 moves = moves_of(args_.position, args_.position_prev, item_).at(foot.s) -
                           moves_of(args_.position, args_.position_prev, other).at(foot.t);
        const double ahead = std::min(double(params_.steps) * moves.norm(), double(params_.room));
        return {foot.apart.norm(), PLAIT_PAIR_NEAR * double(params_.diameter) + ahead};
    }

    const plait_pair_params& params_;
    const pair_find_args& args_;
    uint32_t item_;
    Segment own_;
};

} // namespace

void pair_find(uint32_t item_count, const plait_pair_params& params, const pair_find_args& args) {
    for (uint32_t item = 0; item < item_count; ++item) {
        std::vector<std::pair<double, uint32_t>> list;
        if (has_segment(args.vertex_count, item, params.vertex_stride))
            list = Search(params, args, item).all();
        for (size_t k = 0; k < PLAIT_PAIR_COUNT; ++k) {
            const size_t at = size_t{item} * PLAIT_PAIR_COUNT + k;
            args.pair_segment[at] = PLAIT_PAIR_NONE;
            args.pair_offset[at] = 0;
            if (k >= list.size())
                continue;
            const uint32_t other = list[k].second;
            const Foot rest = nearest(segment_at(args.rest, item), segment_at(args.rest, other));
            args.pair_segment[at] = other;
            args.pair_offset[at] = std::min(double(params.diameter), rest.apart.norm());
        }
        if (list.size() > PLAIT_PAIR_COUNT)
            args.pair_dropped[0] += static_cast<uint32_t>(list.size() - PLAIT_PAIR_COUNT);
    }
}

} // namespace plait::reference
