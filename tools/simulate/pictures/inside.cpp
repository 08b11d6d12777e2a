#include "inside.hpp"

#include "render/inside.hpp"
#include "scene/read_field.hpp"

#include <algorithm>
#include <utility>

namespace simulate {

namespace {

constexpr uint32_t looks_per_second = 10;

}

struct Inside::State {
    const Figure& figure;
    render::Solid solid;
    float rate;
    uint32_t every;
    uint32_t simulated; // strands
};

Inside::Inside(const Scene& scene, const Figure& figure) {
    if (figure.solids.triangles.empty())
        return;
    state_.reset(
        new State{figure, render::Solid(figure.solids.triangles), static_cast<float>(scene.rate),
                  std::max(1u, scene.rate / looks_per_second), figure.simulated_strands()});
    report_.groomed = groomed();
}

// Before the first step, with head and body at rest.
double Inside::groomed() const {
    const Figure& figure = state_->figure;
    state_->solid.set_vertices(figure.posed_solids({{0, 0, 0, 1}, {0, 0, 0}}, 0.0f));
    const auto positions = read_field<float>(figure.groom.get(), PLAIT_GROOM_FIELD_POSITIONS);
    InsideCount count;
    size_t at = 0;
    for (const uint32_t vertices :
         read_field<uint32_t>(figure.groom.get(), PLAIT_GROOM_FIELD_VERTEX_COUNTS)) {
        for (size_t vertex = at + 1; vertex < at + vertices; ++vertex) {
            const float* const p = &positions[3 * vertex];
            ++count.vertices;
            count.deeper += state_->solid.depth({p[0], p[1], p[2]}) > InsideReport::limit;
        }
        at += vertices;
    }
    return count.share();
}

Inside::~Inside() = default;

bool Inside::wants(uint32_t frame) const {
    return state_ && frame % state_->every == 0;
}

InsideReport Inside::finish() {
    InsideReport next;
    next.groomed = report_.groomed;
    return std::exchange(report_, next);
}

void Inside::take(const Shot& shot) {
    // Positions are those of the step's end.
    state_->solid.set_vertices(
        state_->figure.posed_solids(shot.head, shot.time + 1.0f / state_->rate));
    uint64_t deeper[2] = {}, looked[2] = {};
    InsideCount* const kinds[2] = {&report_.simulated, &report_.following};
    for (uint32_t strand = 0; strand < shot.vertex_count.size(); ++strand)
        for (uint32_t vertex = 1; vertex < shot.vertex_count[strand]; ++vertex) {
            const int kind = strand < state_->simulated ? 0 : 1;
            const float* const p = &shot.positions[4 * (size_t{strand} * shot.row + vertex)];
            const float depth = state_->solid.depth({p[0], p[1], p[2]});
            ++looked[kind];
            deeper[kind] += depth > InsideReport::limit;
            if (InsideCount& count = *kinds[kind]; depth > count.deepest) {
                count.deepest = depth;
                count.frame = shot.frame;
                count.strand = strand;
                count.vertex = vertex;
            }
        }
    for (int kind = 0; kind < 2; ++kind) {
        InsideCount& count = *kinds[kind];
        count.vertices += looked[kind];
        count.deeper += deeper[kind];
        if (looked[kind])
            count.worst_share = std::max(count.worst_share, static_cast<double>(deeper[kind]) /
                                                                static_cast<double>(looked[kind]));
    }
    ++report_.frames;
}

} // namespace simulate
