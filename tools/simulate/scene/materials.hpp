// Materials by name: what some strands are made of in place of the scene's params, and which strands
// take which.
#pragma once

#include "common.hpp"

#include <plait/plait.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace simulate {

// Strands whose roots lie within `radius` of `at`, m, in the groom.
struct RootRegion {
    std::array<float, 3> at{};
    float radius = 0.0f;
};

// Of the strands that `strands` and `roots` both name (absent: all), `share`, drawn by the seed.
struct MaterialChoice {
    std::string name, place; // "scene.json:12: materials[0]", of what it says about strands
    plait_material material;
    std::optional<std::vector<std::array<uint32_t, 2>>> strands; // first and last
    std::optional<RootRegion> roots;
    float share = 1.0f;
};

// What a material leaves out is as in `usual`.
std::vector<MaterialChoice> read_materials(JsonReader& top, const plait_material& usual);

// Of every strand of `groom` which material it takes, the last of the list that names it, or as many
// as there are: none of them; empty without materials. Throws Failure where one names a strand that is
// none, or takes none.
std::vector<uint32_t> strand_materials(const std::vector<MaterialChoice>& materials,
                                       const plait_groom* groom, uint64_t seed);

} // namespace simulate
