#include "core/follows/root_spread.hpp"

#include "base/hash.hpp"

#include <algorithm>

namespace plait {

void StrandRoots::append(const Point& root, const Point& ahead) {
    at.emplace_back(root.data());
    way.push_back((Eigen::Vector3f(ahead.data()) - at.back()).normalized());
}

std::pmr::vector<uint32_t> spread_order(const StrandRoots& roots, size_t count, uint64_t seed,
                                        std::pmr::memory_resource* memory) {
    const size_t strands = roots.at.size();
    std::pmr::vector<float> squares(strands, std::numeric_limits<float>::infinity(),
                                    memory); // to the nearest; -1: chosen
    std::pmr::vector<uint32_t> chosen(memory);
    size_t next = mix64(seed) % strands;
    while (chosen.size() < count) {
        chosen.push_back(static_cast<uint32_t>(next));
        squares[next] = -1;
        const Eigen::Vector3f root = roots.at[next];
        for (size_t i = 0; i < strands; ++i) {
            squares[i] = std::min(squares[i], (roots.at[i] - root).squaredNorm());
            if (squares[i] > squares[next])
                next = i;
        }
    }
    return chosen;
}

std::pmr::vector<uint32_t> spread_roots(const StrandRoots& roots, size_t count, uint64_t seed,
                                        std::pmr::memory_resource* memory) {
    auto chosen = spread_order(roots, count, seed, memory);
    std::ranges::sort(chosen);
    return chosen;
}

} // namespace plait
