#include "strand_contact/pair_inputs.hpp"

#include <bit>
#include <cmath>

namespace plait::cases {
namespace {

enum Buffers { vertex_count, position, position_prev, cell_count, cell_moves };

std::string compare_moves(const Setup&, const Outputs& expected, const Outputs& got) {
    for (size_t i = 0; i < expected[cell_moves].words.size(); ++i) {
        const auto right = std::bit_cast<float>(expected[cell_moves].words[i]);
        const auto found = std::bit_cast<float>(got[cell_moves].words[i]);
        if (!(std::abs(found - right) <= 3e-7f))
            return "cell_moves[" + std::to_string(i) + "]: " + std::to_string(found) +
                   " m, expected " + std::to_string(right) + " m";
    }
    return "";
}

} // namespace

// No segment has its middle so near a wall between cells that rounding decides.
Case contact_pair_count_case() {
    Case result = {PLAIT_STAGE_contact_pair_count,
                   {},
                   {},
                   {"longest", "diameter", "room", "steps", "position.w", "position_prev.w"},
                   {{"cell_moves", compare_moves}}};
    for (const PairHair& hair : make_pair_hair())
        for (const float before : {0.0f, 1.5e-3f}) { // what has been found so far
            Setup setup = hair.setup();
            setup.buffers = {uints(hair.hair.vertex_count), float4s(hair.hair.position),
                             float4s(hair.hair.position_prev),
                             uints(std::vector<uint32_t>(hair.cells(), 3)),
                             uints(std::vector<uint32_t>(make_pair_moves(hair).size(),
                                                         std::bit_cast<uint32_t>(before)))};
            result.setups.push_back(setup);
        }
    return result;
}

} // namespace plait::cases
