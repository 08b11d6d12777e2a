// C. Yuksel, "Sample elimination for generating Poisson disk sample sets", Computer Graphics Forum
// 34 (2015): of many points, take away the most crowded one until as many are left as wanted.
#include "scatter.hpp"

#include "random.hpp"

namespace plait_generator {

PointGrid::PointGrid(const std::vector<Vec3>& points, double reach)
    : points_(points), reach_(reach), starts_(points.size() + 2, 0), members_(points.size()) {
    for (const Vec3 p : points_)
        ++starts_[bucket(cell(p)) + 1];
    for (size_t b = 1; b < starts_.size(); ++b)
        starts_[b] += starts_[b - 1];
    std::vector<uint32_t> next = starts_;
    for (uint32_t i = 0; i < points_.size(); ++i)
        members_[next[bucket(cell(points_[i]))]++] = i;
}

PointGrid::Cell PointGrid::cell(Vec3 p) const {
    const auto floor = [&](double x) { return static_cast<int64_t>(std::floor(x / reach_)); };
    return {floor(p.x), floor(p.y), floor(p.z)};
}

size_t PointGrid::bucket(Cell c) const {
    const uint64_t key =
        scramble(scramble(scramble(static_cast<uint64_t>(c.x)) ^ static_cast<uint64_t>(c.y)) ^
                 static_cast<uint64_t>(c.z));
    return key % (starts_.size() - 1);
}

namespace {

// Binary heap of points, the most crowded on top, in which the weight of any point may fall.
class Crowd {
  public:
    explicit Crowd(std::vector<double> weights)
        : weights_(std::move(weights)), heap_(weights_.size()), place_(weights_.size()) {
        for (uint32_t i = 0; i < heap_.size(); ++i)
            heap_[i] = place_[i] = i;
        for (size_t i = heap_.size() / 2; i-- > 0;)
            sink(i);
    }

    bool contains(uint32_t point) const { return place_[point] != gone; }
    size_t size() const { return heap_.size(); }

    uint32_t pop() {
        const uint32_t top = heap_[0];
        put(0, heap_.back());
        heap_.pop_back();
        place_[top] = gone;
        if (!heap_.empty())
            sink(0);
        return top;
    }

    void lighten(uint32_t point, double by) {
        weights_[point] -= by;
        sink(place_[point]);
    }

  private:
    static constexpr uint32_t gone = ~0u;

    bool heavier(uint32_t a, uint32_t b) const {
        return weights_[a] != weights_[b] ? weights_[a] > weights_[b] : a < b;
    }
    void put(size_t at, uint32_t point) {
        heap_[at] = point;
        place_[point] = static_cast<uint32_t>(at);
    }
    void sink(size_t at) {
        const uint32_t point = heap_[at];
        for (size_t child; (child = 2 * at + 1) < heap_.size(); at = child) {
            if (child + 1 < heap_.size() && heavier(heap_[child + 1], heap_[child]))
                ++child;
            if (!heavier(heap_[child], point))
                break;
            put(at, heap_[child]);
        }
        put(at, point);
    }

    std::vector<double> weights_;
    std::vector<uint32_t> heap_, place_;
};

} // namespace

std::vector<uint32_t> spread_out(const std::vector<Vec3>& points, size_t count, double area) {
    // Twice the greatest radius that `count` equal discs on the area can have.
    const double reach = 2 * std::sqrt(area / (2 * std::sqrt(3.0) * static_cast<double>(count)));
    const PointGrid grid(points, reach);
    const auto for_each_weight = [&](uint32_t i, auto function) {
        grid.for_each_near(points[i], [&](uint32_t j) {
            const double closeness = 1 - length(points[i] - points[j]) / reach;
            if (j == i || closeness <= 0)
                return;
            const double square = closeness * closeness, fourth = square * square;
            function(j, fourth * fourth); // the paper's alpha = 8
        });
    };

    std::vector<double> weights(points.size(), 0);
    for (uint32_t i = 0; i < points.size(); ++i)
        for_each_weight(i, [&](uint32_t, double weight) { weights[i] += weight; });
    Crowd crowd(std::move(weights));
    while (crowd.size() > count)
        for_each_weight(crowd.pop(), [&](uint32_t j, double weight) {
            if (crowd.contains(j))
                crowd.lighten(j, weight);
        });

    std::vector<uint32_t> kept;
    for (uint32_t i = 0; i < points.size(); ++i)
        if (crowd.contains(i))
            kept.push_back(i);
    return kept;
}

} // namespace plait_generator
