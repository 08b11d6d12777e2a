// Segments that share a joint are often equally near, and rounding decides which is first: what is
// compared is how near the pairs are, not which.
#include "strand_contact/pair_inputs.hpp"

#include <algorithm>
#include <cmath>

namespace plait::cases {
namespace {

enum Buffers {
    vertex_count,
    rest,
    cell_end,
    cell_segment,
    cell_line,
    cell_moves,
    pair_segment,
    pair_offset
};

std::string complain(const char* what, size_t pair, double found, double expected) {
    return std::string(what) + "[" + std::to_string(pair) + "]: " + std::to_string(1e3 * found) +
           " mm, expected " + std::to_string(1e3 * expected) + " mm";
}

// float4 of the vertices of segments, as they lie in the cells.
std::vector<float> positions(const Setup& setup) {
    const std::vector<float>& line = setup.buffers[cell_line].floats;
    const size_t stride = size_t{setup.items} + PLAIT_PAIR_PADDING;
    std::vector<float> list(4 * size_t{setup.items});
    for (size_t i = 0; i < setup.buffers[cell_end].words.back(); ++i)
        for (size_t k = 0; k < 3; ++k) {
            const size_t first = 4 * size_t{setup.buffers[cell_segment].words[i]} + k;
            list[first] = line[(PLAIT_PAIR_FROM + k) * stride + i];
            list[first + 4] = list[first] + line[(PLAIT_PAIR_WAY + k) * stride + i];
        }
    return list;
}

std::string compare_pairs(const Setup& setup, const Outputs& expected, const Outputs& got) {
    const std::vector<float> x = positions(setup);
    for (size_t i = 0; i < got[pair_segment].words.size(); ++i) {
        const uint32_t other = got[pair_segment].words[i], right = expected[pair_segment].words[i];
        if (other == right)
            continue;
        if (other == PLAIT_PAIR_NONE || right == PLAIT_PAIR_NONE || other + 1 >= setup.items)
            return "pair_segment[" + std::to_string(i) + "] is " + std::to_string(other) +
                   ", expected " + std::to_string(right);
        const auto own = static_cast<uint32_t>(i / PLAIT_PAIR_COUNT);
        const double far = segment_distance(x, own, other), near = segment_distance(x, own, right);
        if (std::abs(far - near) > 2e-6)
            return complain("pair_segment", i, far, near);
    }
    return "";
}

std::string compare_offsets(const Setup& setup, const Outputs& expected, const Outputs& got) {
    const auto diameter = double(setup.params_as<plait_pair_params>().diameter);
    for (size_t i = 0; i < got[pair_offset].floats.size(); ++i) {
        const uint32_t other = got[pair_segment].words[i];
        const auto own = static_cast<uint32_t>(i / PLAIT_PAIR_COUNT);
        double right = double(expected[pair_offset].floats[i]);
        if (other != expected[pair_segment].words[i])
            right = std::min(diameter, segment_distance(setup.buffers[rest].floats, own, other));
        if (!(std::abs(double(got[pair_offset].floats[i]) - right) <= 2e-6))
            return complain("pair_offset", i, double(got[pair_offset].floats[i]), right);
    }
    return "";
}

// The segments of every cell the other way round.
std::vector<uint32_t> turned(const PairCells& cells) {
    std::vector<uint32_t> segments = cells.segments;
    for (size_t cell = 0; cell < cells.end.size(); ++cell)
        std::reverse(segments.begin() + cells.begin[cell], segments.begin() + cells.end[cell]);
    return segments;
}

} // namespace

Case contact_pair_find_case() {
    Case result = {PLAIT_STAGE_contact_pair_find,
                   {},
                   {},
                   {},
                   {{"pair_segment", compare_pairs}, {"pair_offset", compare_offsets}}};
    result.decides = {"longest"}; // where it looks, not what it finds
    for (const PairHair& hair : make_pair_hair()) {
        const PairCells cells = make_pair_cells(hair);
        const size_t pairs = size_t{PLAIT_PAIR_COUNT} * hair.vertices();
        Setup setup = hair.setup();
        setup.buffers = {uints(hair.hair.vertex_count),
                         float4s(hair.hair.rest),
                         uints(cells.end),
                         uints(cells.segments),
                         floats(make_pair_lines(hair, cells.segments)),
                         uints(make_pair_moves(hair)),
                         uints(std::vector<uint32_t>(pairs, 5)),
                         unwritten_floats(pairs),
                         uints({3})};
        result.setups.push_back(setup);
        setup.name += ", in another order";
        setup.buffers[cell_segment] = uints(turned(cells));
        setup.buffers[cell_line] = floats(make_pair_lines(hair, turned(cells)));
        result.setups.push_back(setup);
    }
    return result;
}

} // namespace plait::cases
