#include "core/groom/root_ends.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace plait {
namespace {

using EndPoint = std::array<double, 3>;

constexpr size_t neighbours = 12; // ends of other strands that an end is compared with
constexpr size_t fewest = 3;      // and without which it tells nothing
// Of 2 x neighbours: a strand is contradicted from this on,
constexpr int contradicted = 6;
// where half of the strands agree by twice this; roots and tips that lie mixed tell nothing.
constexpr int agreed = 2;
// Where this many times as many votes lie between both crowds as beyond half the way, there is one.
constexpr size_t fading = 3;

double square(const EndPoint& a, const EndPoint& b) {
    const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return x * x + y * y + z * z;
}

// Of other strands, the nearest to an end.
class Near {
  public:
    size_t count() const { return count_; }
    // How many more are of the other kind than as `end`; 0 where there are too few to tell.
    int votes_on(uint32_t end) const {
        int sum = 0;
        for (size_t i = 0; i < count_; ++i)
            sum += list_[i].end % 2 == end % 2 ? -1 : 1;
        return count_ < fewest ? 0 : sum;
    }
    void add(double square, uint32_t end) {
        if (count_ == neighbours && square >= list_[count_ - 1].square)
            return;
        size_t at = count_ < neighbours ? count_++ : count_ - 1;
        for (; at > 0 && list_[at - 1].square > square; --at)
            list_[at] = list_[at - 1];
        list_[at] = {square, end};
    }

  private:
    struct Entry {
        double square;
        uint32_t end;
    };
    std::array<Entry, neighbours> list_; // ascending
    size_t count_ = 0;
};

// Both ends of every strand, 2 i and 2 i + 1, sorted by the cube that they are in: x runs fastest, so that
// three cubes beside each other are one run.
class Cells {
  public:
    Cells(const std::pmr::vector<EndPoint>& ends, double edge, std::pmr::memory_resource* memory)
        : edge_(edge), from_(lowest(ends)), places_(memory) {
        for (uint32_t i = 0; i < ends.size(); ++i)
            places_.push_back({key_of(ends[i]), i, ends[i]});
        std::ranges::sort(places_, {}, [](const Place& p) { return std::pair(p.key, p.end); });
    }

    // Calls visit(end, its Near) for every `stride`-th end, from cube to cube.
    template <typename Visit> void visit(size_t stride, const Visit& visit) const {
        std::array<Run, 9> runs{};
        for (size_t k = 0; k < places_.size(); k += stride) {
            Near near;
            for (size_t row = 0; row < runs.size(); ++row) {
                find(places_[k].key, row, runs[row]);
                for (size_t i = runs[row].first; i < runs[row].last; ++i)
                    add(places_[i], places_[k], near);
            }
            visit(places_[k].end, near);
        }
    }

  private:
    struct Place {
        uint64_t key;
        uint32_t end;
        EndPoint at;
    };
    struct Run {
        size_t first, last;
    };
    static constexpr uint64_t bits =
        20; // of a cube's number along an axis, and one more to either side

    static EndPoint lowest(const std::pmr::vector<EndPoint>& ends) {
        EndPoint from = ends.front();
        for (const EndPoint& p : ends)
            for (size_t i = 0; i < 3; ++i)
                from[i] = std::min(from[i], p[i]);
        return from;
    }
    // Numbers begin anew after a million cubes: what is that far off shares some, and is told by its distance.
    uint64_t key_of(const EndPoint& p) const {
        constexpr uint64_t round = (uint64_t{1} << bits) - 1;
        uint64_t key = 0;
        for (size_t i = 3; i-- > 0;) {
            const double cell = std::min((p[i] - from_[i]) / edge_, 1e18);
            key = key << (bits + 1) | ((static_cast<uint64_t>(cell) & round) + 1);
        }
        return key;
    }
    void add(const Place& other, const Place& to, Near& near) const {
        const double far = square(other.at, to.at);
        if (other.end / 2 != to.end / 2 &&
            far <= 12 * edge_ * edge_) // of two cubes in a row, corner to corner
            near.add(far, other.end);
    }
    // The cubes beside that of `key` in one of nine rows: keys rise, and so do the row's places.
    void find(uint64_t key, size_t row, Run& run) const {
        const uint64_t y = uint64_t{1} << (bits + 1), z = y << (bits + 1);
        const uint64_t middle = key + row % 3 * y + row / 3 * z - y - z;
        while (run.first < places_.size() && places_[run.first].key < middle - 1)
            ++run.first;
        run.last = std::max(run.last, run.first);
        while (run.last < places_.size() && places_[run.last].key <= middle + 1)
            ++run.last;
    }

    double edge_;
    EndPoint from_;
    std::pmr::vector<Place> places_;
};

std::pmr::vector<EndPoint> ends_of(const StrandSet& strands, std::pmr::memory_resource* memory) {
    std::pmr::vector<EndPoint> ends(memory);
    const float* p = strands.positions.data();
    for (const uint32_t count : strands.vertex_counts) {
        const float* tip = p + 3 * (size_t{count} - 1);
        ends.push_back({double(p[0]), double(p[1]), double(p[2])});
        ends.push_back({double(tip[0]), double(tip[1]), double(tip[2])});
        p = tip + 3;
    }
    return ends;
}

// An edge of cubes with which two in three ends of a sample have enough neighbours; 0: there is none.
double edge_for(const std::pmr::vector<EndPoint>& ends, std::pmr::memory_resource* memory) {
    double reach = 0;
    for (size_t i = 0; i < ends.size(); i += 2)
        reach += std::sqrt(square(ends[i], ends[i + 1])) / double(ends.size() / 2);
    for (double edge = reach / 64; edge > 0 && edge <= 2 * reach; edge *= 2) {
        size_t asked = 0, enough = 0;
        Cells(ends, edge, memory).visit(ends.size() / 256 + 1, [&](uint32_t, const Near& near) {
            ++asked;
            enough += near.count() == neighbours;
        });
        if (3 * enough >= 2 * asked)
            return edge;
    }
    return 0;
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
    const std::pmr::vector<EndPoint> ends = ends_of(strands, memory);
    const double edge = edge_for(ends, memory);
    if (edge == 0)
        return list;
    std::pmr::vector<Votes> votes(ends.size() / 2, memory);
    Cells(ends, edge, memory).visit(1, [&](uint32_t end, const Near& near) {
        (end % 2 == 0 ? votes[end / 2].root : votes[end / 2].tip) = near.votes_on(end);
    });
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
