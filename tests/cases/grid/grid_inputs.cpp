#include "grid/grid_inputs.hpp"

#include <array>
#include <cmath>
#include <cstdio>

namespace plait::cases {
namespace {

constexpr std::array<double, 4> turned = {0.18, -0.36, 0.54, 0.7389181280764466}; // unit

plait_grid_params make_params(uint32_t stride, uint32_t edge_count, uint32_t capacity) {
    plait_grid_params params = {};
    params.vertex_stride = stride;
    params.edge_count = edge_count;
    params.capacity = capacity;
    params.voxel_edge = 0.8f / static_cast<float>(edge_count);
    for (size_t lane = 0; lane < 4; ++lane)
        params.q[lane] = static_cast<float>(turned[lane]);
    params.t[0] = -0.45f;
    params.t[1] = -0.35f;
    params.t[2] = 0.25f;
    params.h = 1.0f / 60;
    params.slot_hash = PLAIT_SLOT_HASH_PCG;
    params.frame = 17;
    params.seed = 4711;
    params.tent = PLAIT_TENT_VOXEL;
    params.diffuse_rule = PLAIT_DIFFUSE_FLOORED;
    params.diffuse_ratio = 2;
    params.diffuse_factor = 0.7f;
    params.diffuse_floor = 0.6f;
    return params;
}

double grid_coordinate(Random& random, uint32_t edge_count) {
    const bool outside = random.below(30) == 0; // per component
    const double cell = outside ? (random.below(2) ? -1.0 : edge_count)
                                : static_cast<double>(random.below(edge_count));
    return cell + random.uniform(0.01, 0.99);
}

void add_vertex(GridHair& hair, Random& random) {
    Point p, v;
    for (size_t c = 0; c < 3; ++c)
        p[c] = grid_coordinate(random, hair.params.edge_count) *
               static_cast<double>(hair.params.voxel_edge);
    for (double& component : v)
        component = random.uniform(-1, 1); // m/s
    const Point x = rotate(turned, p);
    const double w = random.below(10) == 0 ? 0 : 1;
    for (size_t c = 0; c < 3; ++c) {
        const float world = static_cast<float>(x[c] + static_cast<double>(hair.params.t[c]));
        hair.position.push_back(world);
        hair.position_prev.push_back(
            static_cast<float>(world - v[c] * static_cast<double>(hair.params.h)));
    }
    hair.position.push_back(static_cast<float>(w));
    hair.position_prev.push_back(static_cast<float>(w));
}

GridHair make(const Size& size, uint32_t edge_count, uint32_t capacity) {
    Random random(size.stride * 31 + edge_count);
    GridHair hair;
    hair.size = size;
    hair.params = make_params(size.stride, edge_count, capacity);
    hair.name = name_of(size) + ", " + std::to_string(edge_count) + " voxels, " +
                std::to_string(capacity) + " slots";
    for (uint32_t s = 0; s < size.strands; ++s) {
        hair.vertex_count.push_back(s % 3 == 1 ? 2 + random.below(size.stride - 1) : size.stride);
        for (uint32_t i = 0; i < size.stride; ++i)
            add_vertex(hair, random);
    }
    return hair;
}

uint32_t pcg(uint32_t value) {
    const uint32_t state = value * 747796405u + 2891336453u;
    const uint32_t word = ((state >> ((state >> 28) + 4)) ^ state) * 277803737u;
    return (word >> 22) ^ word;
}

double sum_of(const std::vector<uint32_t>& words, size_t voxel, size_t which) {
    const size_t first = voxel * PLAIT_SUM_STRIDE + 2 * which;
    const auto sum =
        static_cast<int64_t>(static_cast<uint64_t>(words[first + 1]) << 32 | words[first]);
    const double scale = which == 0   ? PLAIT_SUM_DENSITY_SCALE
                         : which == 4 ? PLAIT_SUM_ENERGY_SCALE
                                      : PLAIT_SUM_MOMENTUM_SCALE;
    return static_cast<double>(sum) / scale;
}

constexpr std::array<double, PLAIT_SUM_COUNT> tolerance = {4e-5, 4e-4, 4e-4, 4e-4, 8e-4};

} // namespace

Setup GridHair::setup() const {
    Setup result;
    result.name = name;
    return result.with(params);
}

std::vector<GridHair> make_grid_hair() {
    return {make({67, 16}, 3, 5), make({7, 31}, 8, 16),   make({1, 2}, 1, 1), make({5, 100}, 5, 67),
            make({67, 5}, 4, 1),  make({2, 256}, 2, 300), make({9, 9}, 12, 2)};
}

GridHair make_much_grid_hair() {
    return make({1100, 4}, 5, 8);
}

std::optional<uint32_t> voxel_of(const plait_grid_params& params, const float* position) {
    Point x;
    for (size_t c = 0; c < 3; ++c)
        x[c] = static_cast<double>(position[c]) - static_cast<double>(params.t[c]);
    const Point p = rotate({-params.q[0], -params.q[1], -params.q[2], params.q[3]}, x);
    std::array<uint32_t, 3> cell;
    for (size_t c = 0; c < 3; ++c) {
        const double index = std::floor(p[c] / static_cast<double>(params.voxel_edge));
        if (!(index >= 0 && index < params.edge_count))
            return std::nullopt;
        cell[c] = static_cast<uint32_t>(index);
    }
    return (cell[1] * params.edge_count + cell[2]) * params.edge_count + cell[0];
}

uint32_t pcg_slot_of(const plait_grid_params& params, uint32_t vertex) {
    const uint64_t hash = pcg(vertex ^ pcg(params.frame ^ pcg(params.seed)));
    return static_cast<uint32_t>(hash * params.capacity >> 32);
}

std::vector<uint32_t> filled_slots(const GridHair& hair) {
    const plait_grid_params& params = hair.params;
    std::vector<uint32_t> slots(size_t{hair.voxels()} * params.capacity, PLAIT_SLOT_EMPTY);
    for (uint32_t item = 0; item < hair.vertices(); ++item) {
        if (item % params.vertex_stride >= hair.vertex_count[item / params.vertex_stride])
            continue;
        if (const auto voxel = voxel_of(params, &hair.position[4 * size_t{item}]))
            slots[size_t{*voxel} * params.capacity + pcg_slot_of(params, item)] = item;
    }
    return slots;
}

GridField make_grid_field(const GridHair& hair) {
    Random random(hair.voxels());
    GridField field;
    for (uint32_t voxel = 0; voxel < hair.voxels(); ++voxel) {
        const bool empty = voxel % 5 == 3;
        field.density.push_back(empty ? 0 : static_cast<float>(random.uniform(0.1, 4)));
        for (int lane = 0; lane < 3; ++lane)
            field.velocity.push_back(empty ? 0 : static_cast<float>(random.uniform(-.4, .4)));
        field.velocity.push_back(empty ? 0 : static_cast<float>(random.uniform(.2, .6))); // rms
    }
    return field;
}

LaneGridHair over_lanes(const GridHair& hair) {
    LaneGridHair lanes;
    const uint32_t stride = hair.size.stride;
    const auto at = [&](const std::vector<float>& of, uint32_t vertex, size_t c) {
        return static_cast<double>(of[4 * size_t{vertex} + c]);
    };
    for (uint32_t vertex = 0; vertex < hair.vertices(); ++vertex)
        for (size_t c = 0; c < 3; ++c) {
            const double x = at(hair.position, vertex, c);
            const uint32_t row = vertex % stride;
            const double root = row > 0 ? at(hair.position, vertex - row, c) : 0;
            lanes.x.push_back(static_cast<float>(x - root));
            lanes.v.push_back(static_cast<float>((x - at(hair.position_prev, vertex, c)) /
                                                 static_cast<double>(hair.params.h)));
        }
    lanes.v_before = lanes.v;
    for (float& v : lanes.v_before)
        v *= 0.7f;
    const plait_grid_params& grid = hair.params;
    lanes.params = {grid.vertex_stride,
                    1,
                    grid.edge_count,
                    grid.voxel_edge,
                    {grid.q[0], grid.q[1], grid.q[2], grid.q[3]},
                    {grid.t[0], grid.t[1], grid.t[2], grid.t[3]},
                    grid.tent,
                    0,
                    grid.diffuse_rule,
                    grid.diffuse_ratio,
                    grid.diffuse_factor,
                    grid.diffuse_floor,
                    0};
    return lanes;
}

std::string compare_sums(const Array& expected, const Array& got) {
    const auto& want = expected.words;
    for (size_t voxel = 0; voxel < want.size() / PLAIT_SUM_STRIDE; ++voxel)
        for (size_t which = 0; which < PLAIT_SUM_COUNT; ++which) {
            const double a = sum_of(got.words, voxel, which), b = sum_of(want, voxel, which);
            if (std::abs(a - b) > tolerance[which]) {
                char text[120];
                std::snprintf(text, sizeof text, "grid_sum of voxel %zu, sum %zu is %.9g, not %.9g",
                              voxel, which, a, b);
                return text;
            }
        }
    return "";
}

} // namespace plait::cases
