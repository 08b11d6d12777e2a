// Segments of one cell race for its places: any order of them is right.
#include "pair_inputs.hpp"

#include <algorithm>

namespace plait::cases {
namespace {

enum Buffers { vertex_count, position, cell_end, cell_segment };

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

} // namespace

Case pair_fill_case() {
    Case result = {PLAIT_STAGE_pair_fill,
                   {},
                   {},
                   {"diameter", "room", "steps", "position.w"},
                   {{"cell_segment", compare_segments}}};
    for (const PairHair& hair : make_pair_hair()) {
        Setup setup = hair.setup();
        setup.buffers = {uints(hair.hair.vertex_count), float4s(hair.hair.position),
                         uints(make_pair_cells(hair).begin),
                         uints(std::vector<uint32_t>(hair.vertices(), 7))};
        result.setups.push_back(setup);
    }
    return result;
}

} // namespace plait::cases
