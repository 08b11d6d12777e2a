// Strands as a file or caller gives them: nothing checked yet beyond array sizes.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <vector>

namespace plait {

struct StrandSet {
    explicit StrandSet(std::pmr::memory_resource* memory = std::pmr::get_default_resource())
        : positions(memory), vertex_counts(memory), strand_uv(memory), thickness(memory),
          bone_indices(memory), bone_weights(memory), group(memory), id(memory), guide_ids(memory),
          guide_weights(memory) {}

    std::pmr::vector<float> positions; // xyz [vertices], metres, strand after strand, root first
    std::pmr::vector<uint32_t> vertex_counts; // [strands]; sums to positions.size() / 3
    std::pmr::vector<float> strand_uv;        // uv [strands] or empty
    std::pmr::vector<float> thickness;        // diameter in metres [strands] or empty
    std::pmr::vector<uint32_t> bone_indices;  // 4 [strands] or empty
    std::pmr::vector<float> bone_weights;     // 4 [strands] or empty
    std::pmr::vector<uint32_t> group;         // [strands] or empty
    // Of a file that says what follows what: a name of each strand, and names and weights of guides.
    static constexpr size_t guides_of_file = 3;
    std::pmr::vector<uint32_t> id;        // [strands] or empty
    std::pmr::vector<uint32_t> guide_ids; // guides_of_file [strands] or empty
    std::pmr::vector<float> guide_weights;
};

} // namespace plait
