#include "inputs.hpp"

#include "stage_sizes.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string>

namespace bench {
namespace {

using Words = std::vector<uint32_t>;

uint32_t word(float value) {
    return std::bit_cast<uint32_t>(value);
}

void append(Words& words, float x, float y, float z, float w) {
    words.insert(words.end(), {word(x), word(y), word(z), word(w)});
}

// Strands that hang from the head; `shift` metres along x. The first two vertices are pinned.
// As a sim keeps strands: those of a tile lie near together, by Morton codes of their roots.
std::vector<float> roots_side_by_side(uint32_t strands) {
    using Root = std::array<float, 3>;
    const auto code = [](const Root& root) {
        uint32_t bits = 0;
        for (uint32_t bit = 10; bit-- > 0;)
            for (const float x : root)
                bits = bits << 1 | (static_cast<uint32_t>((x / head_radius + 1) * 511) >> bit & 1u);
        return bits;
    };
    const auto apart = root_positions(strands);
    std::vector<Root> roots;
    for (size_t i = 0; i < apart.size(); i += 3)
        roots.push_back({apart[i], apart[i + 1], apart[i + 2]});
    std::stable_sort(roots.begin(), roots.end(),
                     [&](const Root& a, const Root& b) { return code(a) < code(b); });
    std::vector<float> list;
    for (const Root& root : roots)
        list.insert(list.end(), root.begin(), root.end());
    return list;
}

Words strands_from(const std::vector<float>& roots, const Shape& shape, float shift) {
    Words words;
    for (uint32_t strand = 0; strand < shape.strands; ++strand)
        for (uint32_t vertex = 0; vertex < shape.vertices; ++vertex) {
            const float along =
                strand_length * static_cast<float>(vertex) / static_cast<float>(shape.vertices - 1);
            const float* root = &roots[3 * size_t{strand}];
            append(words, root[0] + shift, root[1] - along, root[2], vertex < 2 ? 0.0f : 1.0f);
        }
    return words;
}

Words strands(const Shape& shape, float shift) {
    return strands_from(root_positions(shape.strands), shape, shift);
}

Words vectors(size_t count, float x, float y, float z, float w) {
    Words words;
    for (size_t i = 0; i < count; ++i)
        append(words, x, y, z, w);
    return words;
}

// Each strand held at its middle, where the groom has it.
Words pins(const Shape& shape) {
    Words words = strands(shape, 0);
    for (size_t vertex = 0; vertex < shape.total(); ++vertex)
        words[4 * vertex + 3] = word(vertex % shape.vertices == shape.vertices / 2 ? -1e6f : 0.0f);
    return words;
}

// Pairs of a unit quaternion and a translation.
Words poses(const Shape& shape) {
    Words words;
    for (uint32_t strand = 0; strand < shape.strands; ++strand) {
        append(words, 0, 0, 0, 1);
        append(words, 0, 0, 0, 0);
    }
    return words;
}

Words capsules() {
    Words words;
    for (uint32_t collider = 0; collider < colliders; ++collider) {
        const float x = 0.1f * static_cast<float>(collider);
        for (int end = 0; end < 2; ++end) {
            append(words, x, 0, 0, head_radius / 2);
            append(words, x, -0.1f, 0, head_radius / 4);
        }
        append(words, 0, 0, 0, 1);
        append(words, 0.3f, 0, 0, 0);
    }
    return words;
}

// A ball as a mesh at rest, of the head's size, in a grid of this many nodes each way.
constexpr uint32_t mesh_nodes = 48;

template <size_t N> Words bits_of(const float (&row)[N]) {
    Words words(N);
    std::transform(row, row + N, words.begin(),
                   [](float value) { return std::bit_cast<uint32_t>(value); });
    return words;
}

// Hair in all nodes but those of the outermost layer, which are air.
Words volume_nodes() {
    Words words;
    const auto inner = [](uint32_t i) { return i > 0 && i + 1 < grid_edge_count; };
    for (uint32_t node = 0; node < voxels; ++node) {
        const bool hair = inner(node % grid_edge_count) &&
                          inner(node / grid_edge_count % grid_edge_count) &&
                          inner(node / (grid_edge_count * grid_edge_count));
        const Words one = bits_of<4>({0, 0, hair ? 0.5f : 0.0f, 0});
        words.insert(words.end(), one.begin(), one.end());
    }
    return words;
}

Words mesh_row() {
    return bits_of<4 * PLAIT_COLLIDER_STRIDE>({0, 0, 0, 0, 0, 0, 0, 1, 0,    0,
                                               0, 0, // begin, orientation, end
                                               0, 0, 0, 0, 0, 0, 0, 1, 0.3f, PLAIT_KIND_MESH,
                                               0, 0});
}

constexpr float mesh_edge = 2.4f * head_radius / (mesh_nodes - 1); // m
constexpr float mesh_origin = -1.2f * head_radius;

Words words_of(const std::vector<float>& floats) {
    Words words(floats.size());
    std::transform(floats.begin(), floats.end(), words.begin(),
                   [](float value) { return std::bit_cast<uint32_t>(value); });
    return words;
}

Words mesh_values() {
    Words words;
    for (uint32_t z = 0; z < mesh_nodes; ++z)
        for (uint32_t y = 0; y < mesh_nodes; ++y)
            for (uint32_t x = 0; x < mesh_nodes; ++x) {
                const auto at = [](uint32_t i) {
                    return mesh_origin + mesh_edge * static_cast<float>(i);
                };
                words.push_back(
                    std::bit_cast<uint32_t>(std::hypot(at(x), at(y), at(z)) - head_radius));
            }
    return words;
}

Words counting(uint32_t count) {
    Words words(count);
    for (uint32_t i = 0; i < count; ++i)
        words[i] = i;
    return words;
}

// One slice of the grid in x, through the head: a voxel in eight.
bool holds_hair(uint32_t voxel) {
    return voxel % grid_edge_count == grid_edge_count / 2;
}

// Slots as full as grid_slots leaves them.
Words slots(const Shape& shape) {
    Words words(size_t{voxels} * slot_capacity, PLAIT_SLOT_EMPTY);
    for (size_t slot = 0; slot < words.size(); ++slot)
        if (holds_hair(static_cast<uint32_t>(slot / slot_capacity)))
            words[slot] = static_cast<uint32_t>(slot % shape.total());
    return words;
}

Words densities() {
    Words words(voxels);
    for (uint32_t voxel = 0; voxel < voxels; ++voxel)
        words[voxel] = word(holds_hair(voxel) ? 10.0f : 0.0f);
    return words;
}

Words lengths(const Shape& shape) {
    Words words(shape.total(), word(strand_length / static_cast<float>(shape.vertices - 1)));
    for (size_t strand = 1; strand <= shape.strands; ++strand)
        words[strand * shape.vertices - 1] = word(0);
    return words;
}

// Neighbours of one another.
Words three_guides(const Shape& shape) {
    Words words;
    for (uint32_t follow = 0; follow < shape.strands; ++follow)
        for (const uint32_t next : {0u, 1u, 2u, 0u})
            words.push_back((follow + next) % shape.strands);
    return words;
}

// From the root, m.
Words arcs(const Shape& shape) {
    Words words;
    const float length = strand_length / static_cast<float>(shape.vertices - 1);
    for (size_t vertex = 0; vertex < shape.total(); ++vertex)
        words.push_back(word(length * static_cast<float>(vertex % shape.vertices)));
    return words;
}

// Vertex by vertex.
Words own_places(const Shape& shape) {
    Words words;
    for (size_t vertex = 0; vertex < shape.total(); ++vertex)
        words.push_back(word(static_cast<float>(vertex % shape.vertices)));
    return words;
}

// Follows are where guides are.
Words with_follows(const Shape& shape) {
    Words words = strands(shape, 0);
    words.resize(2 * words.size());
    std::copy_n(words.begin(), words.size() / 2, words.begin() + words.size() / 2);
    return words;
}

// [tile][V][components][strands of the tile] of one strand's rows, [V][components].
Words in_lanes(const Shape& shape, const std::vector<float>& rows) {
    Words words;
    const uint32_t tiles = (shape.strands + shape.tile - 1) / shape.tile;
    for (uint32_t t = 0; t < tiles; ++t)
        for (const float value : rows)
            words.insert(words.end(), shape.tile, word(value));
    return words;
}

// Half way between two turns of each guide.
Words places(const Shape& shape) {
    std::vector<float> rows;
    for (uint32_t i = 0; i < shape.vertices; ++i) {
        const float place = static_cast<float>(i) - 0.5f;
        const float held = std::clamp(place, 0.0f, static_cast<float>(shape.vertices - 2));
        rows.insert(rows.end(), {held, held, held, 0});
    }
    return in_lanes(shape, rows);
}

// A root, and what leads from each vertex to the next.
Words segments(const Shape& shape) {
    const float length = strand_length / static_cast<float>(shape.vertices - 1);
    std::vector<float> rows;
    for (uint32_t i = 0; i < shape.vertices; ++i)
        rows.insert(rows.end(), {0, i == 0 ? head_radius : -length, 0, i == 0 ? 0.0f : 1.0f});
    return in_lanes(shape, rows);
}

// A strand that hangs down, relative to its root.
Words lane_positions(const Shape& shape) {
    std::vector<float> rows;
    for (uint32_t i = 0; i < shape.vertices; ++i)
        for (const float x :
             {0.0f, -strand_length * static_cast<float>(i) / static_cast<float>(shape.vertices - 1),
              0.0f})
            rows.push_back(x);
    return in_lanes(shape, rows);
}

// Strands that begin on the head, lie on it for a share of their length, down its meridians, and
// stand off it from there: row 0 the root, the others relative to it.
Words lying_positions(const Shape& shape) {
    const auto roots = roots_side_by_side(shape.strands);
    const size_t lanes = (size_t{shape.strands} + shape.tile - 1) / shape.tile * shape.tile;
    Words words(lanes * shape.vertices * 3);
    for (size_t lane = 0; lane < lanes; ++lane) {
        const float* root = &roots[3 * std::min<size_t>(lane, shape.strands - 1)];
        const float polar = std::acos(root[1] / head_radius);
        const float across = std::max(std::hypot(root[0], root[2]), 1e-6f);
        const float along[2] = {root[0] / across, root[2] / across};
        for (size_t i = 0; i < shape.vertices; ++i) {
            const float arc =
                strand_length * static_cast<float>(i) / static_cast<float>(shape.vertices - 1);
            const float lies = std::min(arc, shape.lies * strand_length);
            const float angle = polar + lies / head_radius;
            const float radius = head_radius + (arc - lies) + (i > 0 ? 0.001f : 0.0f);
            const float x[3] = {radius * std::sin(angle) * along[0], radius * std::cos(angle),
                                radius * std::sin(angle) * along[1]};
            for (size_t c = 0; c < 3; ++c)
                words[((lane / shape.tile * shape.vertices + i) * 3 + c) * shape.tile +
                      lane % shape.tile] = word(i == 0 ? x[c] : x[c] - root[c]);
        }
    }
    return words;
}

// Every row the same.
template <size_t Components>
Words lane_rows(const Shape& shape, const std::array<float, Components>& row) {
    std::vector<float> rows;
    for (uint32_t i = 0; i < shape.vertices; ++i)
        rows.insert(rows.end(), row.begin(), row.end());
    return in_lanes(shape, rows);
}

// A hair of 5e-6 kg/m and 4.7e-9 N m^2, the stretch that gives it 1 % at 10 g.
Words lane_material(const Shape& shape) {
    constexpr float density = 5e-6f, bend = 4.7e-9f, stretch = 1.2e-2f;
    const float l = strand_length / static_cast<float>(shape.vertices - 1);
    std::vector<float> rows;
    for (uint32_t i = 0; i < shape.vertices; ++i)
        for (const float value : {l, stretch / l, 4 * bend / l, density * l, 0.0f, 0.0f})
            rows.push_back(value);
    const auto last = rows.end() - PLAIT_LANE_MATERIAL_COMPONENTS;
    last[PLAIT_LANE_DRAG] = last[PLAIT_LANE_FRICTION] = 1;
    return in_lanes(shape, rows);
}

// Turned a little further about y, bone by bone.
Words bone_matrices() {
    Words words;
    for (uint32_t bone = 0; bone < bones; ++bone) {
        const float turn = 0.01f * static_cast<float>(bone), c = std::cos(turn), s = std::sin(turn);
        append(words, c, 0, s, 0.1f);
        append(words, 0, 1, 0, 0);
        append(words, -s, 0, c, 0);
    }
    return words;
}

// On a helix, so that no three vertices in a row lie on a line; turned by so much.
Words skin_mesh(float turn) {
    Words words;
    for (uint32_t i = 0; i < skin_vertices; ++i) {
        const float angle = static_cast<float>(i) + turn;
        append(words, 0.1f * std::cos(angle), 1e-4f * static_cast<float>(i), 0.1f * std::sin(angle),
               0);
    }
    return words;
}

// The segments of strands that hang, in the cells of their middles, and which may meet: those beside.
struct Cells {
    Words end, segments, lines;
};

Cells cells_of(const Shape& shape) {
    plait_pair_params params{};
    const auto bytes = typical_params(PLAIT_STAGE_contact_pair_count, shape);
    std::memcpy(&params, bytes.data(), sizeof params);
    const Words words = strands(shape, 0);
    std::vector<Words> cells(size_t{pair_cells} * pair_cells * pair_cells);
    for (uint32_t vertex = 0; vertex < shape.total(); ++vertex) {
        if (vertex % shape.vertices + 1 == shape.vertices)
            continue;
        size_t cell = 0;
        for (size_t k = 3; k-- > 0;) {
            const auto at = [&](size_t v) { return std::bit_cast<float>(words[4 * v + k]); };
            const float middle = (at(vertex) + at(size_t{vertex} + 1)) / 2;
            const auto place = static_cast<int>(std::floor(middle / params.voxel_edge));
            const auto n = static_cast<int>(pair_cells);
            cell = cell * pair_cells + static_cast<size_t>((place % n + n) % n);
        }
        cells[cell].push_back(vertex);
    }
    Cells sorted;
    for (const Words& cell : cells) {
        sorted.segments.insert(sorted.segments.end(), cell.begin(), cell.end());
        sorted.end.push_back(static_cast<uint32_t>(sorted.segments.size()));
    }
    const size_t stride = shape.total() + PLAIT_PAIR_PADDING, in_cells = sorted.segments.size();
    sorted.lines.resize(PLAIT_PAIR_COMPONENTS * stride);
    for (size_t i = 0; i < in_cells; ++i)
        for (size_t k = 0; k < 3; ++k) {
            const size_t first = 4 * size_t{sorted.segments[i]} + k;
            const auto at = [&](size_t word) { return std::bit_cast<float>(words[word]); };
            const float from = at(first), way = at(first + 4) - from;
            sorted.lines[(PLAIT_PAIR_MIDDLE + k) * stride + i] = word(from + way / 2);
            sorted.lines[(PLAIT_PAIR_HALF + k) * stride + i] = word(std::abs(way) / 2);
            sorted.lines[(PLAIT_PAIR_FROM + k) * stride + i] = word(from);
            sorted.lines[(PLAIT_PAIR_WAY + k) * stride + i] = word(way);
            sorted.lines[(PLAIT_PAIR_MOVES + k) * stride + i] = word(k == 0 ? 0.001f : 0.0f);
        }
    sorted.segments.resize(shape.total());
    return sorted;
}

Words pairs(const Shape& shape) {
    Words words;
    for (size_t vertex = 0; vertex < shape.total(); ++vertex)
        for (size_t k = 1; k <= PLAIT_PAIR_COUNT; ++k) {
            const size_t other = (vertex + k * shape.vertices) % shape.total();
            const bool some = other % shape.vertices + 1 < shape.vertices && shape.strands > k;
            words.push_back(some ? static_cast<uint32_t>(other) : PLAIT_PAIR_NONE);
        }
    return words;
}

// What is not zero.
using Maker = Words (*)(const Shape&);

const std::map<std::string, Maker>& makers() {
    constexpr Maker still = [](const Shape& s) { return strands(s, 0); };
    constexpr Maker moved = [](const Shape& s) { return strands(s, -0.001f); };
    constexpr Maker moved_twice = [](const Shape& s) { return strands(s, -0.002f); };
    // The x axis turned to -y.
    constexpr Maker downwards = [](const Shape& s) {
        return lane_rows<4>(
            s, {0, 0, -std::numbers::sqrt2_v<float> / 2, std::numbers::sqrt2_v<float> / 2});
    };
    static const std::map<std::string, Maker> table = {
        {"rest", still},
        {"position", still},
        {"position_prev", moved},
        {"position_prev2", moved_twice},
        {"position_local", moved},
        {"held", moved},
        {"wake_from", moved},
        {"wake_to", moved},
        {"points", still},
        {"bone_matrix", [](const Shape&) { return bone_matrices(); }},
        {"bone_index",
         [](const Shape& s) {
             Words words;
             for (uint32_t i = 0; i < 4 * s.strands; ++i)
                 words.push_back(i % bones);
             return words;
         }},
        {"skin_corner",
         [](const Shape& s) {
             Words words;
             for (uint32_t i = 0; i < 3 * s.strands; ++i)
                 words.push_back((i / 3 + i % 3) % skin_vertices);
             return words;
         }},
        {"skin_rest", [](const Shape&) { return skin_mesh(0); }},
        {"skin_at", [](const Shape&) { return skin_mesh(0.1f); }},
        {"bone_weight", [](const Shape& s) { return vectors(s.strands, 0.4f, 0.3f, 0.2f, 0.1f); }},
        {"pin", pins},
        {"pin_at", pins},
        {"pin_from", pins},
        {"pin_to", pins},
        {"pose", poses},
        {"pose_before", poses},
        {"root_pose", poses},
        {"pose_next", poses},
        {"pose_was", poses},
        {"pose_from", poses},
        {"pose_to", poses},
        {"pose_now", poses},
        {"root_before", poses},
        {"root_from", poses},
        {"root_to", poses},
        {"strand_motion", poses},
        {"vertex_count", [](const Shape& s) { return Words(s.strands, s.vertices); }},
        {"rest_length", lengths},
        {"collider", [](const Shape&) { return capsules(); }},
        {"mesh_grid",
         [](const Shape&) {
             return bits_of<4>({mesh_origin, mesh_origin, mesh_origin, mesh_edge});
         }},
        {"mesh_nodes",
         [](const Shape&) {
             return Words{mesh_nodes, mesh_nodes, mesh_nodes, 0};
         }},
        {"mesh_values", [](const Shape&) { return mesh_values(); }},
        {"mesh_clearance", [](const Shape& s) { return Words(s.total()); }},
        {"mesh_side", [](const Shape&) { return Words(4); }}, // none is a sheet
        {"mesh_first",
         [](const Shape&) {
             const auto count = ball().triangle.size() / PLAIT_MESH_TRIANGLE_STRIDE;
             return Words{0, 0, 0, 0, 0, static_cast<uint32_t>(count)};
         }},
        {"mesh_box", [](const Shape&) { return words_of(ball().box); }},
        {"mesh_tree", [](const Shape&) { return ball().tree; }},
        {"mesh_triangle", [](const Shape&) { return ball().triangle; }},
        {"mesh_ring", [](const Shape&) { return ball().ring; }},
        {"mesh_from", [](const Shape&) { return words_of(ball().vertices); }},
        {"mesh_to", [](const Shape&) { return words_of(ball().vertices); }},
        {"mesh_bends", [](const Shape&) { return Words(1); }},
        {"mesh_taken", [](const Shape&) { return words_of(ball().vertices); }},
        {"mesh_at", [](const Shape&) { return words_of(ball().vertices); }},
        {"mesh_target", [](const Shape&) { return words_of(ball().vertices); }},
        {"mesh_way", [](const Shape&) { return Words(ball().tree.size() / 2); }},
        {"mesh_under", [](const Shape&) { return ball().under; }},
        {"cell_count", [](const Shape&) { return Words(pair_cells * pair_cells * pair_cells); }},
        {"cell_end", [](const Shape& s) { return cells_of(s).end; }},
        {"cell_segment", [](const Shape& s) { return cells_of(s).segments; }},
        {"cell_line", [](const Shape& s) { return cells_of(s).lines; }},
        {"cell_moves",
         [](const Shape&) {
             const size_t blocks = pair_cells / PLAIT_PAIR_BLOCK;
             return Words(blocks * blocks * blocks, word(0.001f));
         }},
        {"pair_segment", pairs},
        {"pair_offset",
         [](const Shape& s) { return Words(PLAIT_PAIR_COUNT * s.total(), word(0.004f)); }},
        {"follow_guide", [](const Shape& s) { return counting(s.strands); }},
        {"root_guide", [](const Shape& s) { return counting(s.strands); }},
        {"follow_offset", [](const Shape& s) { return vectors(s.strands, 0.002f, 0, 0.001f, 0); }},
        {"follow_guides", three_guides},
        {"follow_weight", [](const Shape& s) { return vectors(s.strands, 0.5f, 0.3f, 0.2f, 0); }},
        {"follow_place", places},
        {"follow_rest", segments},
        {"follow_way", [](const Shape& s) { return vectors(s.strands, 0, -1, 0, 0); }},
        {"follow_arc", arcs},
        {"clump_centre", [](const Shape& s) { return counting(s.strands); }},
        {"clump_place", own_places},
        {"wetness_given", [](const Shape& s) { return Words(s.strands, word(1)); }},
        {"wetness_held", [](const Shape& s) { return Words(s.strands, word(0.5f)); }},
        {"lane_dry", lane_material}, // of which all rows are to be scaled
        {"guide_turn", [](const Shape& s) { return vectors(s.total(), 0, 0, 0, 1); }},
        {"grid_slot", slots},
        {"lane_material", lane_material},
        {"lane_rest",
         [](const Shape& s) {
             return lane_rows<4>(s, {0, 0, 0, 1});
         }},
        {"lane_x", lane_positions},
        {"lane_x_before", lane_positions},
        {"lane_v",
         [](const Shape& s) {
             return lane_rows<3>(s, {0.1f, 0, 0});
         }},
        {"lane_v_before",
         [](const Shape& s) {
             return lane_rows<3>(s, {0.1f, 0, 0});
         }},
        {"lane_normal_force", [](const Shape& s) { return lane_rows<1>(s, {0}); }},
        {"lane_strand", [](const Shape& s) { return counting(s.strands); }},
        {"lane_slot",
         [](const Shape& s) {
             Words words;
             for (uint32_t i = 0; i < s.strands; ++i)
                 words.insert(words.end(), {s.strands - 1 - i, i});
             return words;
         }},
        {"lane_from", lane_positions},
        {"lane_to", lane_positions},
        {"lane_q", downwards},
        {"lane_q_before", downwards},
        {"lane_share",
         [](const Shape& s) {
             return lane_rows<PLAIT_LANE_SHARE_COMPONENTS>(s, {1, 20});
         }},
        {"lane_groom",
         [](const Shape& s) {
             return lane_rows<PLAIT_LANE_GROOM_COMPONENTS>(s, {0, 1e-5f});
         }},
        {"volume_rest", [](const Shape&) { return densities(); }},
        {"volume_link", [](const Shape&) { return vectors(voxels, 0.05f, 0.05f, 0.05f, 0); }},
        {"volume_node", [](const Shape&) { return volume_nodes(); }},
        {"grid_sum", [](const Shape&) { return Words(size_t{voxels} * PLAIT_SUM_STRIDE, 1); }},
        {"grid_density", [](const Shape&) { return densities(); }},
        {"grid_velocity", [](const Shape&) { return vectors(voxels, 0.01f, 0.01f, 0.01f, 0.02f); }},
    };
    return table;
}

bool places_follows(plait_stage stage) {
    return stage == PLAIT_STAGE_tressfx_follow || stage == PLAIT_STAGE_follow_turns ||
           stage == PLAIT_STAGE_follow_clump || stage == PLAIT_STAGE_follow_curl ||
           stage == PLAIT_STAGE_follow_collide || stage == PLAIT_STAGE_follow_field ||
           stage == PLAIT_STAGE_follow_nearest;
}
} // namespace

// Elements of a buffer by buffers.def, whose expressions take these names.
size_t elements_of(const std::string& name, plait_stage stage, const Shape& shape) {
    constexpr size_t VOXELS = voxels, SLOTS = slot_capacity, COLLIDERS = colliders;
    const size_t ITEMS = item_count(stage, shape), STRANDS = shape.strands, ROW = shape.vertices,
                 VERTICES = shape.total(), POINTS = VERTICES,
                 TILED = (STRANDS + shape.tile - 1) / shape.tile * shape.tile * ROW,
                 FOLLOWERS = places_follows(stage) ? STRANDS : 0;
#define PLAIT_BUFFER(buffer, when, extent, components)                                             \
    if (name == #buffer)                                                                           \
        return extent;
#include <plait/buffers.def>
    return 0;
}

std::vector<uint32_t> typical_buffer(const plait_stage_info& stage, const plait_stage_arg& arg,
                                     const Shape& shape) {
    if (places_follows(stage.stage) && std::string(arg.name) == "position")
        return with_follows(shape);
    const std::string_view name = arg.name;
    if (stage.stage != PLAIT_STAGE_lane_accelerate && arg.access == PLAIT_ACCESS_READ &&
        name.ends_with("acceleration"))
        return {}; // hair that gravity alone pulls
    if (stage.stage != PLAIT_STAGE_lane_pin && name == "lane_pin")
        return {}; // and that nothing pins
    if (!finds_planes(stage.stage) && stage.stage != PLAIT_STAGE_strand_contact &&
        name == "lane_plane")
        return {}; // and that is near no mesh
    if (name == "lane_hollow")
        return {}; // nor any sheet
    if (name == "mesh_solid" && arg.access == PLAIT_ACCESS_READ)
        return {}; // a grid without meshes
    if ((finds_planes(stage.stage) || finds_solids(stage.stage) ||
         follows_meet_meshes(stage.stage)) &&
        name == "collider")
        return mesh_row();
    if (finds_planes(stage.stage) && name == "rest")
        return strands_from(roots_side_by_side(shape.strands), shape, 0);
    if (finds_planes(stage.stage) && name == "lane_x")
        return lying_positions(shape);
    const auto maker = makers().find(arg.name);
    if (maker != makers().end())
        return maker->second(shape);
    const size_t elements = elements_of(arg.name, stage.stage, shape);
    if (elements == 0)
        throw std::runtime_error(std::string("stage ") + stage.name + ": no typical contents for " +
                                 arg.name);
    return Words(elements * (arg.element == PLAIT_ELEMENT_FLOAT4 ? 4 : 1)); // zeros
}

uint64_t traffic(const plait_stage_info& stage, const Shape& shape) {
    std::vector<size_t> elements;
    for (const plait_stage_arg& arg : std::span(stage.args, stage.arg_count))
        if (arg.access != PLAIT_ACCESS_LOCAL)
            elements.push_back(typical_buffer(stage, arg, shape).size() /
                               (arg.element == PLAIT_ELEMENT_FLOAT4 ? 4 : 1));
    return plait_stage_traffic(stage.stage, item_count(stage.stage, shape), shape.vertices,
                               elements.data());
}

std::vector<float> root_positions(uint32_t strands) {
    std::vector<float> roots;
    const float golden = std::numbers::pi_v<float> * (3 - std::sqrt(5.0f));
    for (uint32_t strand = 0; strand < strands; ++strand) {
        const float height = (static_cast<float>(strand) + 0.5f) / static_cast<float>(strands);
        const float radius = std::sqrt(1 - height * height);
        const float angle = golden * static_cast<float>(strand);
        for (const float x : {radius * std::cos(angle), height, radius * std::sin(angle)})
            roots.push_back(head_radius * x);
    }
    return roots;
}

} // namespace bench
