#include "core/base/strand_order.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace plait {
namespace {

constexpr uint32_t cells = 1u << 10; // along an edge of the cube around all roots

using Point = std::array<float, 3>;

std::pmr::vector<Point> roots_of(std::span<const float> positions, std::span<const uint32_t> counts,
                                 std::pmr::memory_resource* memory) {
    std::pmr::vector<Point> roots(memory);
    for (const uint32_t count : counts) {
        roots.push_back({positions[0], positions[1], positions[2]});
        positions = positions.subspan(size_t{3} * count);
    }
    return roots;
}

// Two zero bits before each of the lowest ten.
uint32_t spread(uint32_t x) {
    x = (x | x << 16) & 0x030000ffu;
    x = (x | x << 8) & 0x0300f00fu;
    x = (x | x << 4) & 0x030c30c3u;
    return (x | x << 2) & 0x09249249u;
}

std::pmr::vector<uint32_t> morton_codes(const std::pmr::vector<Point>& roots,
                                        std::pmr::memory_resource* memory) {
    if (roots.empty())
        return std::pmr::vector<uint32_t>(memory);
    Point low = roots.front(), high = low;
    for (const Point& root : roots)
        for (size_t c = 0; c < 3; ++c) {
            low[c] = std::min(low[c], root[c]);
            high[c] = std::max(high[c], root[c]);
        }
    const float edge = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2], 1e-30f});
    std::pmr::vector<uint32_t> codes(memory);
    for (const Point& root : roots) {
        uint32_t code = 0;
        for (size_t c = 0; c < 3; ++c)
            code |= spread(static_cast<uint32_t>((root[c] - low[c]) / edge * (cells - 1))) << c;
        codes.push_back(code);
    }
    return codes;
}

} // namespace

std::pmr::vector<uint32_t> order_by_root(std::span<const float> positions,
                                         std::span<const uint32_t> counts,
                                         std::pmr::memory_resource* memory) {
    std::pmr::vector<uint32_t> order(counts.size(), memory);
    std::iota(order.begin(), order.end(), 0u);
    const auto codes = morton_codes(roots_of(positions, counts, memory), memory);
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
        return codes[a] != codes[b] ? codes[a] < codes[b] : a < b;
    });
    return order;
}

std::pmr::vector<uint32_t> order_by_root(std::span<const float> positions,
                                         std::span<const uint32_t> counts,
                                         std::span<const uint32_t> ends,
                                         std::pmr::memory_resource* memory) {
    if (ends.empty())
        return order_by_root(positions, counts, memory);
    std::pmr::vector<uint32_t> order(memory);
    size_t vertex = 0;
    for (const uint32_t end : ends) {
        const auto first = static_cast<uint32_t>(order.size());
        const auto block = counts.subspan(first, end - first);
        for (const uint32_t strand : order_by_root(positions.subspan(3 * vertex), block, memory))
            order.push_back(first + strand);
        vertex = std::accumulate(block.begin(), block.end(), vertex);
    }
    return order;
}

} // namespace plait
