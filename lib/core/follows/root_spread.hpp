// Strands whose roots are spread evenly over a scalp, and those that are nearest to others.
#pragma once

#include "core/base/polyline.hpp"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <limits>
#include <memory_resource>
#include <span>
#include <utility>
#include <vector>

namespace plait {

struct StrandRoots {
    explicit StrandRoots(std::pmr::memory_resource* memory)
        : at(memory), way(memory), hung(memory) {}
    void append(const Point& root, const Point& ahead);
    // How far strands are from one another, squared: m^2.
    float square(size_t a, size_t b) const {
        const float roots = (at[a] - at[b]).squaredNorm();
        return hung.empty() ? roots : roots + hung_share * (hung[a] - hung[b]).squaredNorm();
    }

    // Weight of the four places along a strand. Two that hang on different sides of a shoulder move apart however
    // near their roots are. Measured from 0 to 1, for three grooms on a head and shoulders: error over
    // swing of long hair with 512 guides is .325 with roots alone, .295 with this, and flat around it.
    static constexpr float hung_share = 0.1f;

    std::pmr::vector<Eigen::Vector3f> at;  // m
    std::pmr::vector<Eigen::Vector3f> way; // unit, over the first part of the strand
    std::pmr::vector<Eigen::Vector<float, 12>>
        hung; // places at quarters of the strand; empty: unknown
};

// Each is the strand whose root is farthest from those of all before (Gonzalez 1985), so that no
// other set covers the scalp more than twice as closely; the first is the seed's.
std::pmr::vector<uint32_t> spread_order(const StrandRoots& roots, size_t count, uint64_t seed,
                                        std::pmr::memory_resource* memory);
// The same, ascending.
std::pmr::vector<uint32_t> spread_roots(const StrandRoots& roots, size_t count, uint64_t seed,
                                        std::pmr::memory_resource* memory);

struct NearRoot {
    uint32_t index = 0;                                    // into the list that was searched
    float square = std::numeric_limits<float>::infinity(); // distance^2; infinite: there is none
};
// The nearest first.
template <size_t N> using NearRoots = std::array<NearRoot, N>;

// Across a parting hair is farther apart: cos 60 deg.
inline constexpr float same_side = 0.5f;

// Those of `chosen` on the strand's own side of a parting; the one that is nearest at all where there
// is none.
template <size_t N>
NearRoots<N> nearest_roots(const StrandRoots& roots, uint32_t strand,
                           std::span<const uint32_t> chosen) {
    NearRoots<N> beside;
    NearRoot any;
    for (uint32_t i = 0; i < chosen.size(); ++i) {
        NearRoot candidate{i, roots.square(chosen[i], strand)};
        if (candidate.square < any.square)
            any = candidate;
        if (candidate.square < beside.back().square &&
            roots.way[chosen[i]].dot(roots.way[strand]) >= same_side)
            for (NearRoot& place : beside)
                if (candidate.square < place.square)
                    std::swap(candidate, place);
    }
    return beside[0].square < std::numeric_limits<float>::infinity() ? beside : NearRoots<N>{any};
}

} // namespace plait
