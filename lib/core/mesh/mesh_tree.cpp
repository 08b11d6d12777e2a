#include "core/mesh/mesh_tree.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace plait {
namespace {

constexpr uint32_t leaf_triangles = 4;

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
    under_.clear();
    add_node(surface, 0, static_cast<uint32_t>(order_.size()));
}

// Halves by the middles of triangles along the side in which these lie farthest apart.
void MeshTree::add_node(const TriangleSet& surface, uint32_t first, uint32_t last) {
    const size_t index = nodes_.size();
    nodes_.push_back({first, last - first});
    under_.push_back({first, last - first, 1});
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
    under_[index].nodes = static_cast<uint32_t>(nodes_.size() - index);
}

} // namespace plait
