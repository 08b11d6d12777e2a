#include "core/strands/length_classes.hpp"

#include <plait/params.h>

#include <array>
#include <limits>

namespace plait {
namespace {

constexpr size_t most_classes = 4;
// A class more has to save so much of all rows, and so many: it takes launches of its own, each
// about as long on a CPU as the solve of a thousand rows, and kernels built for its length.
constexpr uint64_t least_share = 8; // an eighth
constexpr uint64_t least_rows = 4096;

constexpr size_t lengths = PLAIT_MAX_VERTICES + 1;
using ByLength = std::array<uint64_t, lengths>;

// Strands of up to so many vertices.
ByLength accumulated(std::span<const uint32_t> counts) {
    ByLength all{};
    for (const uint32_t count : counts)
        ++all[count];
    for (size_t v = 1; v < lengths; ++v)
        all[v] += all[v - 1];
    return all;
}

// The fewest rows that all strands of up to v vertices take in k + 1 classes, v rows in the last,
// and up to which length the classes before it go.
struct Best {
    std::array<ByLength, most_classes> rows, before;
};

Best best_of(const ByLength& up_to) {
    Best best{};
    for (size_t v = 0; v < lengths; ++v)
        best.rows[0][v] = up_to[v] * v;
    for (size_t k = 1; k < most_classes; ++k)
        for (size_t v = 0; v < lengths; ++v) {
            best.rows[k][v] = std::numeric_limits<uint64_t>::max();
            for (size_t below = 0; below <= v; ++below) {
                const uint64_t rows = best.rows[k - 1][below] + (up_to[v] - up_to[below]) * v;
                if (rows < best.rows[k][v]) {
                    best.rows[k][v] = rows;
                    best.before[k][v] = below;
                }
            }
        }
    return best;
}

} // namespace

LengthClasses::LengthClasses(std::span<const uint32_t> counts, std::pmr::memory_resource* memory)
    : rows_(memory) {
    const auto [least, most] = std::minmax_element(counts.begin(), counts.end());
    rows_.push_back(*most);
    if (*least == *most)
        return;
    const Best best = best_of(accumulated(counts));
    size_t k = 0;
    const auto pays = [&] {
        const uint64_t rows = best.rows[k][*most], saved = rows - best.rows[k + 1][*most];
        return saved >= least_rows && saved * least_share >= rows;
    };
    while (k + 1 < most_classes && pays())
        ++k;
    for (; k > 0; --k)
        rows_.push_back(static_cast<uint32_t>(best.before[k][rows_.back()]));
    std::reverse(rows_.begin(), rows_.end());
}

} // namespace plait
