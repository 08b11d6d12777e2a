#include "strand_contact/pair_inputs.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace plait::cases {
namespace {

// Strands through a cube of `side` m, whose segments are 2 cm long and bend a little.
void crowd(Hair& hair, Random& random, double side, const Point& at) {
    const uint32_t stride = hair.size.stride;
    for (uint32_t s = 0; s < hair.size.strands; ++s) {
        Point x{}, way = random.direction();
        const double speed = random.uniform(1e-4, 2e-3); // m in a substep
        const Point slow = random.direction(), aside = random.direction();
        for (size_t k = 0; k < 3; ++k)
            x[k] = at[k] + random.uniform(0, side);
        for (uint32_t i = 0; i < stride; ++i) {
            const size_t row = 4 * (size_t{s} * stride + i);
            const Point bend = random.direction(), own = random.direction();
            for (size_t k = 0; k < 3; ++k) {
                hair.position[row + k] = static_cast<float>(x[k]);
                hair.position_prev[row + k] =
                    static_cast<float>(x[k] - speed * slow[k] - 1e-4 * own[k]);
                hair.rest[row + k] = static_cast<float>(x[k] + 2e-3 * aside[k]);
                if (i + 1 < hair.vertex_count[s])
                    way[k] += 0.2 * bend[k];
            }
            const double size = double(segment_length) / std::hypot(way[0], way[1], way[2]);
            for (size_t k = 0; k < 3 && i + 1 < hair.vertex_count[s]; ++k) {
                way[k] *= size;
                x[k] += way[k];
                way[k] /= double(segment_length);
            }
        }
    }
}

} // namespace

double segment_distance(const std::vector<float>& positions, uint32_t one, uint32_t other) {
    const auto at = [&](uint32_t vertex, double share, size_t k) {
        const double from = double(positions[4 * size_t{vertex} + k]);
        return from + share * (double(positions[4 * size_t{vertex} + 4 + k]) - from);
    };
    // to the nearest point of `other`, from a point of `one`: convex, so its least is found by thirds
    const auto from_point = [&](double s) {
        double along = 0, square = 0;
        for (size_t k = 0; k < 3; ++k) {
            const double way = at(other, 1, k) - at(other, 0, k);
            along += way * (at(one, s, k) - at(other, 0, k));
            square += way * way;
        }
        const double t = std::clamp(along / square, 0.0, 1.0);
        return std::hypot(at(one, s, 0) - at(other, t, 0), at(one, s, 1) - at(other, t, 1),
                          at(one, s, 2) - at(other, t, 2));
    };
    double low = 0, high = 1;
    for (int i = 0; i < 80; ++i) {
        const double third = (high - low) / 3;
        (from_point(low + third) > from_point(high - third) ? low : high) +=
            from_point(low + third) > from_point(high - third) ? third : -third;
    }
    return from_point((low + high) / 2);
}

Setup PairHair::setup() const {
    Setup setup;
    setup.name = name_of(hair.size) + ", " + std::to_string(params.edge_count) + " cells";
    setup.items = vertices();
    return setup.with(params);
}

std::vector<PairHair> make_pair_hair() {
    std::vector<PairHair> list;
    // `steps`: of 1 to 2 mm 8 are about the room, and 2 much less than it
    const auto add = [&](const Size& size, uint32_t cells, double side, const Point& at,
                         float steps = 8, float edge = 0.0125f) {
        PairHair one{make_hair(size, 71), {}};
        Random random(72 + cells);
        crowd(one.hair, random, side, at);
        one.params = {size.stride, cells, edge, 0.024f, 0.004f, 0.011f, steps};
        list.push_back(one);
    };
    add({150, 9}, 32, 0.2, {-0.1, -0.1, -0.1});
    add({70, 8}, 32, 0.18, {-0.2, -0.1, 0.05}, 2, 0.006f);
    add({30, 16}, 8, 0.15, {2.9, -2.7, 2.4});
    add({20, 6}, 8, 0.14, {0.3, 0.4, -0.5}, 1);
    add({2, 5}, 4, 0.02, {-0.3, 0.2, 0.1});
    add({1, 2}, 1, 0.02, {0, 0, 0});
    return list;
}

std::vector<SegmentCell> segment_cells(const PairHair& one) {
    std::vector<SegmentCell> list;
    const auto n = static_cast<int64_t>(one.params.edge_count);
    for (uint32_t vertex = 0; vertex < one.vertices(); ++vertex) {
        const uint32_t stride = one.params.vertex_stride;
        if (vertex % stride + 1 >= one.hair.vertex_count[vertex / stride])
            continue;
        int64_t cell = 0;
        for (size_t k = 3; k-- > 0;) {
            const double middle = (double(one.hair.position[4 * size_t{vertex} + k]) +
                                   double(one.hair.position[4 * size_t{vertex} + 4 + k])) /
                                  2;
            const auto at =
                static_cast<int64_t>(std::floor(middle / double(one.params.voxel_edge)));
            cell = cell * n + (at % n + n) % n;
        }
        list.push_back({vertex, static_cast<uint32_t>(cell)});
    }
    return list;
}

PairCells make_pair_cells(const PairHair& one) {
    PairCells cells;
    auto list = segment_cells(one);
    std::ranges::stable_sort(list, {}, &SegmentCell::cell);
    cells.count.assign(one.cells(), 0);
    cells.segments.assign(one.vertices(), 0);
    for (size_t i = 0; i < list.size(); ++i) {
        ++cells.count[list[i].cell];
        cells.segments[i] = list[i].segment;
    }
    uint32_t sum = 0;
    for (const uint32_t count : cells.count) {
        cells.begin.push_back(sum);
        sum += count;
        cells.end.push_back(sum);
    }
    return cells;
}

std::vector<float> make_pair_lines(const PairHair& one, const std::vector<uint32_t>& segments) {
    const size_t stride = one.vertices() + PLAIT_PAIR_PADDING;
    std::vector<float> lines(PLAIT_PAIR_COMPONENTS * stride);
    const size_t in_cells = segment_cells(one).size();
    const auto put = [&](size_t component, size_t i, double value) {
        lines[component * stride + i] = static_cast<float>(value);
    };
    for (size_t i = 0; i < in_cells; ++i) {
        double square = 0;
        for (size_t k = 0; k < 3; ++k) {
            const size_t first = 4 * size_t{segments[i]} + k, second = first + 4;
            const auto now = [&](size_t at) { return double(one.hair.position[at]); };
            const auto moves = [&](size_t at) {
                return now(at) - double(one.hair.position_prev[at]);
            };
            const double change = moves(second) - moves(first);
            put(PLAIT_PAIR_MIDDLE + k, i, (now(first) + now(second)) / 2);
            put(PLAIT_PAIR_HALF + k, i, std::abs(now(second) - now(first)) / 2);
            put(PLAIT_PAIR_FROM + k, i, now(first));
            put(PLAIT_PAIR_WAY + k, i, now(second) - now(first));
            put(PLAIT_PAIR_MOVES + k, i, (moves(first) + moves(second)) / 2);
            put(PLAIT_PAIR_CHANGE + k, i, change);
            square += change * change;
        }
        put(PLAIT_PAIR_SPREAD, i, std::sqrt(square) / 2);
    }
    return lines;
}

std::vector<uint32_t> make_pair_moves(const PairHair& one) {
    const uint32_t n = one.params.edge_count, blocks = std::max(n / PLAIT_PAIR_BLOCK, 1u);
    std::vector<uint32_t> moves(size_t{blocks} * blocks * blocks);
    for (const SegmentCell& segment : segment_cells(one)) {
        const auto block = [&](uint32_t cell) { return cell / PLAIT_PAIR_BLOCK % blocks; };
        const uint32_t at =
            (block(segment.cell / n / n) * blocks + block(segment.cell / n % n)) * blocks +
            block(segment.cell % n);
        for (const size_t row : {4 * size_t{segment.segment}, 4 * size_t{segment.segment} + 4}) {
            std::array<double, 3> way{};
            for (size_t k = 0; k < 3; ++k)
                way[k] =
                    double(one.hair.position[row + k]) - double(one.hair.position_prev[row + k]);
            const auto far = static_cast<float>(std::hypot(way[0], way[1], way[2]));
            moves[at] = std::max(moves[at], std::bit_cast<uint32_t>(far));
        }
    }
    return moves;
}

} // namespace plait::cases
