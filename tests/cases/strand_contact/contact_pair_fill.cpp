// Segments of one cell race for its places: any order of them is right.
#include "strand_contact/pair_inputs.hpp"

#include <algorithm>
#include <cmath>

namespace plait::cases {
namespace {

enum Buffers { vertex_count, position, position_prev, cell_end, cell_segment, cell_line };

std::string compare_segments(const Setup&, const Outputs& expected, const Outputs& got) {
    const std::vector<uint32_t>& end = expected[cell_end].words;
    uint32_t begin = 0;
    for (size_t cell = 0; cell < end.size(); begin = end[cell], ++cell) {
        const auto sorted = [&](const Outputs& of) {
            const auto first = of[cell_segment].words.begin();
            std::vector<uint32_t> list(first + begin, first + end[cell]);
            std::ranges::sort(list);
            return list;
        };
        if (sorted(expected) != sorted(got))
            return "cell_segment: other segments in cell " + std::to_string(cell);
    }
    return "";
}

// Of each segment, wherever it lies.
std::string compare_lines(const Setup& setup, const Outputs& expected, const Outputs& got) {
    const size_t stride = size_t{setup.items} + PLAIT_PAIR_PADDING;
    const uint32_t segments = expected[cell_end].words.back();
    const auto by_segment = [&](const Outputs& of) {
        std::vector<std::pair<uint32_t, uint32_t>> list;
        for (uint32_t k = 0; k < segments; ++k)
            list.emplace_back(of[cell_segment].words[k], k);
        std::ranges::sort(list);
        return list;
    };
    const auto right = by_segment(expected), found = by_segment(got);
    for (size_t i = 0; i < segments; ++i)
        for (size_t component = 0; component < PLAIT_PAIR_COMPONENTS; ++component) {
            const float a = got[cell_line].floats[component * stride + found[i].second];
            const float b = expected[cell_line].floats[component * stride + right[i].second];
            if (!(std::abs(a - b) <= 3e-7f))
                return "cell_line, component " + std::to_string(component) + " of segment " +
                       std::to_string(right[i].first) + ": " + std::to_string(a) + ", expected " +
                       std::to_string(b);
        }
    return "";
}

} // namespace

Case contact_pair_fill_case() {
    Case result = {
        PLAIT_STAGE_contact_pair_fill,
        {},
        {},
        {"longest", "diameter", "room", "steps", "position.w", "position_prev.w", "cell_line"},
        {{"cell_segment", compare_segments}, {"cell_line", compare_lines}}};
    for (const PairHair& hair : make_pair_hair()) {
        Setup setup = hair.setup();
        setup.buffers = {
            uints(hair.hair.vertex_count),
            float4s(hair.hair.position),
            float4s(hair.hair.position_prev),
            uints(make_pair_cells(hair).begin),
            uints(std::vector<uint32_t>(hair.vertices(), 7)),
            unwritten_floats(PLAIT_PAIR_COMPONENTS * (hair.vertices() + PLAIT_PAIR_PADDING))};
        result.setups.push_back(setup);
    }
    return result;
}

} // namespace plait::cases
