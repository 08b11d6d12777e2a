#include "ball.hpp"

#include <plait/params.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace bench {
namespace {

using Corners = std::array<uint32_t, 3>;

class Maker {
  public:
    Maker(Ball& ball, float radius) : ball_(ball), radius_(radius) {}

    uint32_t vertex(float x, float y, float z) {
        const float scale = radius_ / std::sqrt(x * x + y * y + z * z);
        for (const float c : {scale * x, scale * y, scale * z, 0.0f})
            ball_.vertices.push_back(c);
        return static_cast<uint32_t>(ball_.vertices.size() / 4 - 1);
    }
    // What was cut lies together, so that halves of the list are near together, too.
    void cut(const Corners& t, uint32_t levels) {
        if (levels == 0) {
            list_.push_back(t);
            return;
        }
        const Corners m = {middle(t[0], t[1]), middle(t[1], t[2]), middle(t[2], t[0])};
        for (const Corners& part : {Corners{t[0], m[0], m[2]}, Corners{m[0], t[1], m[1]},
                                    Corners{m[2], m[1], t[2]}, Corners{m[0], m[1], m[2]}})
            cut(part, levels - 1);
    }
    void finish() {
        neighbours();
        rings();
        node(0, static_cast<uint32_t>(list_.size()));
    }

  private:
    uint32_t middle(uint32_t a, uint32_t b) {
        const auto [place, fresh] = middles_.try_emplace(std::minmax(a, b), 0u);
        if (fresh) {
            const float *p = &ball_.vertices[size_t{4} * a], *q = &ball_.vertices[size_t{4} * b];
            place->second = vertex(p[0] + q[0], p[1] + q[1], p[2] + q[2]);
        }
        return place->second;
    }
    void neighbours() {
        std::map<std::pair<uint32_t, uint32_t>, uint32_t> edges; // as they run
        for (uint32_t t = 0; t < list_.size(); ++t)
            for (size_t k = 0; k < 3; ++k)
                edges[{list_[t][k], list_[t][(k + 1) % 3]}] = t;
        for (const Corners& t : list_) {
            ball_.triangle.insert(ball_.triangle.end(), t.begin(), t.end());
            for (size_t k = 0; k < 3; ++k)
                ball_.triangle.push_back(edges.at({t[(k + 1) % 3], t[k]}));
        }
    }
    void rings() {
        std::vector<std::vector<uint32_t>> around(ball_.vertices.size() / 4);
        for (uint32_t t = 0; t < list_.size(); ++t)
            for (const uint32_t corner : list_[t])
                around[corner].push_back(t);
        auto next = static_cast<uint32_t>(around.size() + 1);
        for (const auto& list : around)
            ball_.ring.push_back(std::exchange(next, next + static_cast<uint32_t>(list.size())));
        ball_.ring.push_back(next);
        for (const auto& list : around)
            ball_.ring.insert(ball_.ring.end(), list.begin(), list.end());
    }
    void node(uint32_t begin, uint32_t end) {
        const size_t at = ball_.tree.size();
        ball_.tree.insert(ball_.tree.end(), {begin, end - begin});
        std::array<float, 8> box = {1e9f, 1e9f, 1e9f, 0, -1e9f, -1e9f, -1e9f, 0};
        for (uint32_t t = begin; t < end; ++t)
            for (const uint32_t corner : list_[t])
                for (size_t k = 0; k < 3; ++k) {
                    const float c = ball_.vertices[size_t{4} * corner + k];
                    box[k] = std::min(box[k], c - 1e-7f);
                    box[k + 4] = std::max(box[k + 4], c + 1e-7f);
                }
        ball_.box.insert(ball_.box.end(), box.begin(), box.end());
        const size_t own = ball_.under.size();
        for (const uint32_t word : {begin, end - begin, 1u})
            ball_.under.push_back(word);
        if (end - begin <= 4)
            return;
        const uint32_t half = (begin + end) / 2;
        node(begin, half);
        ball_.tree[at] = static_cast<uint32_t>(ball_.tree.size() / 2);
        ball_.tree[at + 1] = 0;
        node(half, end);
        ball_.under[own + 2] = static_cast<uint32_t>((ball_.tree.size() - at) / 2);
    }

    Ball& ball_;
    float radius_;
    std::vector<Corners> list_;
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles_;
};

} // namespace

Ball make_ball(float radius, uint32_t levels) {
    Ball ball;
    Maker maker(ball, radius);
    const uint32_t x[2] = {maker.vertex(1, 0, 0), maker.vertex(-1, 0, 0)},
                   y[2] = {maker.vertex(0, 1, 0), maker.vertex(0, -1, 0)},
                   z[2] = {maker.vertex(0, 0, 1), maker.vertex(0, 0, -1)};
    for (uint32_t face = 0; face < 8; ++face) {
        Corners t = {x[face & 1], y[face >> 1 & 1], z[face >> 2]};
        if ((face & 1) ^ (face >> 1 & 1) ^ (face >> 2)) // mirrored an odd number of times
            std::swap(t[1], t[2]);
        maker.cut(t, levels);
    }
    maker.finish();
    return ball;
}

} // namespace bench
