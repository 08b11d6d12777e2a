#include "core/groom/root_ends.hpp"

#include "base/hash.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>

namespace plait {
namespace {

using Point = std::array<double, 3>;

constexpr size_t neighbours = 12; // ends of other strands that an end is compared with
constexpr size_t fewest = 3;      // and without which it tells nothing
// Of 2 x neighbours: a strand is contradicted from this on,
constexpr int contradicted = 6;
// where half of the strands agree by twice this; roots and tips that lie mixed tell nothing.
constexpr int agreed = 2;
constexpr size_t fading = 3;

double square(const Point& a, const Point& b) {
    const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return x * x + y * y + z * z;
}

// Both ends of every strand, 2 i and 2 i + 1, in cubes of an edge.
class Cells {
  public:
    Cells(const std::pmr::vector<Point>& ends, double edge, std::pmr::memory_resource* memory)
        : ends_(ends), edge_(edge), first_(memory), next_(ends.size(), none, memory) {
        for (uint32_t i = 0; i < ends.size(); ++i)
            next_[i] = std::exchange(first_.try_emplace(key(cell(ends[i])), none).first->second, i);
    }

    struct Near {
        double square;
        uint32_t end;
        bool operator<(const Near& other) const { return square < other.square; }
    };
    // The nearest ends of other strands in the cubes around that of `end`, the nearest first.
    void nearest(uint32_t end, std::pmr::vector<Near>& list) const {
        list.clear();
        const Cell middle = cell(ends_[end]);
        for (int64_t k = 0; k < 27; ++k) {
            const auto found = first_.find(
                key({middle[0] + k % 3 - 1, middle[1] + k / 3 % 3 - 1, middle[2] + k / 9 - 1}));
            if (found == first_.end())
                continue;
            for (uint32_t i = found->second; i != none; i = next_[i])
                if (i / 2 != end / 2)
                    list.push_back({square(ends_[i], ends_[end]), i});
        }
        const size_t kept = std::min(list.size(), neighbours);
        std::partial_sort(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(kept),
                          list.end());
        list.resize(kept);
    }

  private:
    using Cell = std::array<int64_t, 3>;
    static constexpr uint32_t none = std::numeric_limits<uint32_t>::max();

    Cell cell(const Point& p) const {
        Cell c{};
        for (size_t i = 0; i < 3; ++i)
            c[i] = static_cast<int64_t>(std::clamp(std::floor(p[i] / edge_), -1e15, 1e15));
        return c;
    }
    static uint64_t key(const Cell& c) {
        Hash hash;
        for (const int64_t i : c)
            hash.add(i);
        return hash.value();
    }

    const std::pmr::vector<Point>& ends_;
    double edge_;
    std::pmr::unordered_map<uint64_t, uint32_t> first_;
    std::pmr::vector<uint32_t> next_;
};

std::pmr::vector<Point> ends_of(const StrandSet& strands, std::pmr::memory_resource* memory) {
    std::pmr::vector<Point> ends(memory);
    const float* p = strands.positions.data();
    for (const uint32_t count : strands.vertex_counts) {
        const float* tip = p + 3 * (size_t{count} - 1);
        ends.push_back({double(p[0]), double(p[1]), double(p[2])});
        ends.push_back({double(tip[0]), double(tip[1]), double(tip[2])});
        p = tip + 3;
    }
    return ends;
}

// An edge of cubes with which half of a sample of ends has enough neighbours; 0: there is none.
double edge_for(const std::pmr::vector<Point>& ends, std::pmr::memory_resource* memory) {
    double reach = 0;
    for (size_t i = 0; i < ends.size(); i += 2)
        reach += std::sqrt(square(ends[i], ends[i + 1])) / double(ends.size() / 2);
    std::pmr::vector<Cells::Near> near(memory);
    for (double edge = reach / 64; edge > 0 && edge <= 2 * reach; edge *= 2) {
        const Cells cells(ends, edge, memory);
        const size_t stride = std::max<size_t>(1, ends.size() / 256) | 1; // of both kinds
        size_t asked = 0, enough = 0;
        for (size_t i = 0; i < ends.size(); i += stride, ++asked) {
            cells.nearest(static_cast<uint32_t>(i), near);
            enough += near.size() == neighbours;
        }
        if (2 * enough >= asked)
            return edge;
    }
    return 0;
}

// How many more ends near `end` are of the other kind than of its own.
int others_near(const Cells& cells, uint32_t end, std::pmr::vector<Cells::Near>& near) {
    cells.nearest(end, near);
    if (near.size() < fewest)
        return 0;
    int sum = 0;
    for (const Cells::Near& other : near)
        sum += other.end % 2 == end % 2 ? -1 : 1;
    return sum;
}

// What the ends of a strand say: how many more around each are of the other kind than of its own.
struct Votes {
    int root, tip;
    int sum() const { return root + tip; }
};

int median_of(const std::pmr::vector<Votes>& votes, std::pmr::memory_resource* memory) {
    std::pmr::vector<int> sums(memory);
    for (const Votes& v : votes)
        sums.push_back(v.sum());
    const auto middle = sums.begin() + static_cast<std::ptrdiff_t>(sums.size() / 2);
    std::nth_element(sums.begin(), middle, sums.end());
    return *middle;
}

} // namespace

// Strands that are stored the other way round are a crowd of their own, about the others' votes with the
// other sign. In short fur, whose tips lie among roots here and there, votes fade out towards there
// instead: more of them are between than beyond half the way.
std::pmr::vector<uint32_t> contradicted_roots(const StrandSet& strands,
                                              std::pmr::memory_resource* memory, bool some_are) {
    std::pmr::vector<uint32_t> list(memory);
    const std::pmr::vector<Point> ends = ends_of(strands, memory);
    const double edge = edge_for(ends, memory);
    if (edge == 0)
        return list;
    const Cells cells(ends, edge, memory);
    std::pmr::vector<Cells::Near> near(memory);
    std::pmr::vector<Votes> votes(memory);
    for (uint32_t i = 0; i < ends.size() / 2; ++i)
        votes.push_back({others_near(cells, 2 * i, near), others_near(cells, 2 * i + 1, near)});
    const int half = -median_of(votes, memory) / 2;
    if (half < agreed)
        return list;
    size_t between = 0, beyond = 0;
    for (uint32_t i = 0; i < votes.size(); ++i) {
        const Votes& v = votes[i];
        between += v.sum() >= 0 && v.sum() < half;
        if (v.root > 0 && v.tip > 0 && v.sum() >= contradicted) {
            list.push_back(i);
            beyond += v.sum() >= half;
        }
    }
    if (!some_are && between > fading * beyond)
        list.clear();
    return list;
}

void turn_around(StrandSet& strands, const std::pmr::vector<uint32_t>& which) {
    size_t strand = 0, first = 0;
    for (const uint32_t i : which) {
        for (; strand < i; ++strand)
            first += strands.vertex_counts[strand];
        float* const p = strands.positions.data() + 3 * first;
        for (size_t a = 0, b = size_t{strands.vertex_counts[i]} - 1; a < b; ++a, --b)
            std::swap_ranges(p + 3 * a, p + 3 * a + 3, p + 3 * b);
    }
}

void turn_all_around(StrandSet& strands) {
    size_t first = 0;
    for (const uint32_t count : strands.vertex_counts) {
        float* const p = strands.positions.data() + 3 * first;
        for (size_t a = 0; 2 * a + 1 < count; ++a)
            std::swap_ranges(p + 3 * a, p + 3 * a + 3, p + 3 * (count - 1 - a));
        first += count;
    }
}

} // namespace plait
