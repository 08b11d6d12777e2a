// A 64-bit two's complement sum stored as two words, low first (params.h, grid_sum).
#pragma once

#include "backend/reference/base/view.hpp"

#include <cstdint>

namespace plait::reference {

template <typename Word> int64_t load_sum(const View<Word>& words, size_t first) {
    return static_cast<int64_t>(static_cast<uint64_t>(words[first + 1]) << 32 | words[first]);
}

inline void add_to_sum(const View<uint32_t>& words, size_t first, int64_t value) {
    const uint64_t sum =
        static_cast<uint64_t>(load_sum(words, first)) + static_cast<uint64_t>(value);
    words[first] = static_cast<uint32_t>(sum);
    words[first + 1] = static_cast<uint32_t>(sum >> 32);
}

} // namespace plait::reference
