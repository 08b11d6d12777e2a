// The caller's function that adds up what parts of a groom have, and what they have beside the grid's sums.
#pragma once

#include <plait/plait_cluster.h>

#include <cstdint>
#include <memory_resource>
#include <vector>

namespace plait {

struct Reduce {
    explicit Reduce(std::pmr::memory_resource* memory) : sums(memory) {}
    explicit operator bool() const { return add != nullptr; }

    plait_reduce_fn add = nullptr; // null: the sim has all strands
    void* user = nullptr;
    std::pmr::vector<int64_t> sums; // on the host; keeps its room
};

// Of strands that are simulated.
struct StrandLengths {
    float mean;  // m
    int64_t sum; // of 2^-20 m, each strand rounded: the same in any parts
};

} // namespace plait
