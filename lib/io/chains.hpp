// Strands whose vertices are joined by lines, in any order and from either end.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory_resource>
#include <span>
#include <utility>
#include <vector>

namespace plait {

class Chains {
  public:
    static constexpr uint32_t NONE = std::numeric_limits<uint32_t>::max();

    explicit Chains(std::pmr::memory_resource* memory) : vertices_(memory), way_(memory) {}
    void resize(size_t vertices) { vertices_.resize(vertices); }

    bool is_free(uint32_t vertex) const { return vertices_[vertex].next[0] == NONE; }
    // +1 where its only line begins, -1 where that ends, 0 where neither is known.
    int is_end(uint32_t vertex) const {
        const Vertex& v = vertices_[vertex];
        return v.next[1] == NONE ? v.grows[0] : 0;
    }
    // `grows`: +1 if hair grows from `from` to `to`, -1 for the other way, 0: not known. False: `from`
    // has two lines already.
    bool link(uint32_t from, uint32_t to, int grows) {
        Vertex& vertex = vertices_[from];
        for (size_t k = 0; k < 2; ++k)
            if (vertex.next[k] == NONE) {
                vertex.next[k] = to;
                vertex.grows[k] = static_cast<int8_t>(grows);
                return true;
            }
        return false;
    }
    // Calls `visit(std::span<const uint32_t> vertices)` for each strand, in the order of their ends of
    // lower number, from these on, unless they grow the other way. Returns a vertex of a ring, or NONE.
    template <typename Visit> uint32_t for_each(const Visit& visit) {
        for (uint32_t i = 0; i < vertices_.size(); ++i)
            if (!vertices_[i].taken && !is_free(i) && vertices_[i].next[1] == NONE) {
                walk(i);
                visit(std::span<const uint32_t>(way_));
            }
        for (uint32_t i = 0; i < vertices_.size(); ++i)
            if (!vertices_[i].taken && !is_free(i))
                return i;
        return NONE;
    }

  private:
    // The two ways on from a vertex, and whether its line says that hair grows that way.
    struct Vertex {
        std::array<uint32_t, 2> next{NONE, NONE};
        std::array<int8_t, 2> grows{};
        bool taken = false;
    };

    void walk(uint32_t end) {
        way_.clear();
        int64_t grows = 0;
        for (uint32_t at = end, before = NONE; at != NONE;) {
            Vertex& vertex = vertices_[at];
            vertex.taken = true;
            way_.push_back(at);
            const size_t on = vertex.next[0] != before || before == NONE ? 0 : 1;
            grows += vertex.next[on] != NONE ? vertex.grows[on] : 0;
            before = std::exchange(at, vertex.next[on]);
        }
        if (grows < 0)
            std::ranges::reverse(way_);
    }

    std::pmr::vector<Vertex> vertices_;
    std::pmr::vector<uint32_t> way_; // in hand
};

} // namespace plait
