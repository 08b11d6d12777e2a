// contact_pair_find: of a segment those others, the nearest first, whose distance d has
//   d <= f D + min(n |a - b|, R),
// f = PLAIT_PAIR_NEAR, D the diameter, n the substeps until the next search, a and b what the two
// nearest points move by in one, R the room. Segments of one strand with less than PLAIT_PAIR_ARC D
// of it between them are none. They stay apart by min(D, their distance at rest).
#include "backend/reference/strand_contact/pair.hpp"

#include <plait/constants.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

namespace plait::reference {
namespace {

class Search {
  public:
    // For the segment at this place in the cells. `stride`: from one component of cell_line to the next.
    Search(const plait_pair_params& params, const contact_pair_find_args& args, size_t place,
           size_t stride)
        : params_(params), args_(args), stride_(stride), item_(args.cell_segment[place]),
          own_(line_at(place)), moves_(moves_at(place)) {}

    // Distance and number of all that are near.
    std::vector<std::pair<double, uint32_t>> all() const {
        std::vector<std::pair<double, uint32_t>> list;
        for (const size_t cell : cells())
            for (size_t k = cell > 0 ? args_.cell_end[cell - 1] : 0; k < args_.cell_end[cell];
                 ++k) {
                const uint32_t other = args_.cell_segment[k];
                if (other != item_ && !is_beside(other, line_at(k)))
                    if (const auto [distance, most] = distance_to(k); distance <= most)
                        list.emplace_back(distance, other);
            }
        std::ranges::sort(list);
        return list;
    }

  private:
    // In which the middle of a segment may lie that comes near.
    std::set<size_t> cells() const {
        const double reach = PLAIT_PAIR_NEAR * double(params_.diameter) + double(params_.room) +
                             double(params_.longest) / 2;
        const Cell low = cell_of(params_, own_.from.cwiseMin(own_.to) - Vec3::Constant(reach));
        const Cell high = cell_of(params_, own_.from.cwiseMax(own_.to) + Vec3::Constant(reach));
        const auto end = [&](size_t k) {
            return std::min(high[k], low[k] + int64_t{params_.edge_count} - 1);
        };
        std::set<size_t> list;
        for (int64_t z = low[2]; z <= end(2); ++z)
            for (int64_t y = low[1]; y <= end(1); ++y)
                for (int64_t x = low[0]; x <= end(0); ++x)
                    list.insert(number_of({x, y, z}, params_.edge_count));
        return list;
    }

    Vec3 read(size_t component, size_t k) const {
        const size_t i = component * stride_ + k;
        return {args_.cell_line[i], args_.cell_line[i + stride_], args_.cell_line[i + 2 * stride_]};
    }
    // Of the segment at place k in the cells.
    Segment line_at(size_t k) const {
        const Vec3 from = read(PLAIT_PAIR_FROM, k);
        return {from, from + read(PLAIT_PAIR_WAY, k)};
    }
    // What its points move by.
    Segment moves_at(size_t k) const {
        const Vec3 middle = read(PLAIT_PAIR_MOVES, k), change = read(PLAIT_PAIR_CHANGE, k);
        return {middle - change / 2, middle + change / 2};
    }

    bool is_beside(uint32_t other, const Segment& its) const {
        if (item_ / params_.vertex_stride != other / params_.vertex_stride)
            return false;
        const double between = std::abs(double(item_) - double(other)) - 1;
        const double length = (own_.length() + its.length()) / 2;
        return between * length < PLAIT_PAIR_ARC * double(params_.diameter);
    }

    std::pair<double, double> distance_to(size_t k) const {
        const Foot foot = nearest(own_, line_at(k));
        const Vec3 moves = moves_.at(foot.s) - moves_at(k).at(foot.t);
        const double ahead = std::min(double(params_.steps) * moves.norm(), double(params_.room));
        return {foot.apart.norm(), PLAIT_PAIR_NEAR * double(params_.diameter) + ahead};
    }

    const plait_pair_params& params_;
    const contact_pair_find_args& args_;
    size_t stride_;
    uint32_t item_;
    Segment own_, moves_;
};

} // namespace

void contact_pair_find(uint32_t item_count, const plait_pair_params& params,
                       const contact_pair_find_args& args) {
    for (size_t pair = 0; pair < size_t{item_count} * PLAIT_PAIR_COUNT; ++pair) {
        args.pair_segment[pair] = PLAIT_PAIR_NONE;
        args.pair_offset[pair] = 0;
    }
    const size_t cells = size_t{params.edge_count} * params.edge_count * params.edge_count;
    for (uint32_t place = 0; item_count > 0 && place < args.cell_end[cells - 1]; ++place) {
        const auto list = Search(params, args, place, line_stride(item_count)).all();
        const uint32_t item = args.cell_segment[place];
        for (size_t k = 0; k < std::min<size_t>(list.size(), PLAIT_PAIR_COUNT); ++k) {
            const size_t at = size_t{item} * PLAIT_PAIR_COUNT + k;
            const uint32_t other = list[k].second;
            const Foot rest = nearest(segment_at(args.rest, item), segment_at(args.rest, other));
            args.pair_segment[at] = other;
            args.pair_offset[at] = std::min(double(params.diameter), rest.apart.norm());
        }
        if (list.size() > PLAIT_PAIR_COUNT)
            ++args.pair_dropped[0];
    }
}

} // namespace plait::reference
