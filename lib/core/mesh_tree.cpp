#include "core/mesh_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace plait {
namespace {

constexpr uint32_t leaf_triangles = 4;
constexpr float infinite = std::numeric_limits<float>::infinity();

void cover(MeshTree::Box& box, const MeshPoint& low, const MeshPoint& high) {
    for (size_t k = 0; k < 3; ++k) {
        box.low[k] = std::min(box.low[k], low[k]);
        box.high[k] = std::max(box.high[k], high[k]);
    }
}

MeshTree::Box nothing() {
    return {{infinite, infinite, infinite}, {-infinite, -infinite, -infinite}};
}

double middle_of(const TriangleSet& surface, uint32_t triangle, size_t axis) {
    double sum = 0;
    for (const uint32_t corner : surface.triangles[triangle])
        sum += double(surface.positions[corner][axis]);
    return sum;
}

} // namespace

void MeshTree::build(const TriangleSet& surface) {
    order_.resize(surface.triangles.size());
    std::iota(order_.begin(), order_.end(), 0u);
    nodes_.clear();
    add_node(surface, 0, static_cast<uint32_t>(order_.size()));
}

// Halves by the middles of triangles along the side in which these lie farthest apart.
void MeshTree::add_node(const TriangleSet& surface, uint32_t first, uint32_t last) {
    const size_t index = nodes_.size();
    nodes_.push_back({first, last - first});
    if (last - first <= leaf_triangles)
        return;
    double widest = -1;
    size_t axis = 0;
    for (size_t k = 0; k < 3; ++k) {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (uint32_t i = first; i < last; ++i) {
            const double middle = middle_of(surface, order_[i], k);
            low = std::min(low, middle);
            high = std::max(high, middle);
        }
        if (high - low > widest) {
            widest = high - low;
            axis = k;
        }
    }
    const uint32_t middle = first + (last - first) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                     [&](uint32_t a, uint32_t b) {
                         const double at_a = middle_of(surface, a, axis),
                                      at_b = middle_of(surface, b, axis);
                         return at_a < at_b || (at_a == at_b && a < b);
                     });
    add_node(surface, first, middle);
    nodes_[index] = {static_cast<uint32_t>(nodes_.size()), 0};
    add_node(surface, middle, last);
}

void MeshTree::fit(std::span<const Triangle> triangles, std::span<const MeshPoint> from,
                   std::span<const MeshPoint> to, std::pmr::vector<Box>& boxes) const {
    float largest = 0;
    for (const auto points : {from, to})
        for (const MeshPoint& p : points)
            for (const float c : p)
                largest = std::max(largest, std::abs(c));
    const float more = 4 * std::numeric_limits<float>::epsilon() * largest;
    boxes.assign(nodes_.size(), nothing());
    for (size_t n = nodes_.size(); n-- > 0;) { // children come after their parent
        const Node& node = nodes_[n];
        if (node.number == 0) {
            for (const size_t child : {n + 1, size_t{node.first}})
                cover(boxes[n], boxes[child].low, boxes[child].high);
            continue;
        }
        for (uint32_t i = node.first; i < node.first + node.number; ++i)
            for (const uint32_t corner : triangles[order_[i]])
                for (const auto points : {from, to})
                    cover(boxes[n], points[corner], points[corner]);
        for (size_t k = 0; k < 3; ++k) {
            boxes[n].low[k] -= more;
            boxes[n].high[k] += more;
        }
    }
}

} // namespace plait
