// Little-endian values that lie close together in bytes, at any alignment.
#pragma once

#include "io/bytes.hpp"

#include <bit>
#include <cstddef>
#include <cstring>

namespace plait {

class PackedFloats {
  public:
    PackedFloats() = default;
    PackedFloats(const std::byte* at, size_t count) : at_(at), count_(count) {}

    size_t size() const { return count_; }
    bool empty() const { return count_ == 0; }
    float operator[](size_t i) const {
        uint32_t word;
        std::memcpy(&word, at_ + sizeof word * i, sizeof word);
        return std::bit_cast<float>(little_endian(word));
    }

  private:
    const std::byte* at_ = nullptr;
    size_t count_ = 0;
};

// Whole numbers of 1, 2, 4 or 8 bytes.
class PackedIntegers {
  public:
    PackedIntegers() = default;
    PackedIntegers(const std::byte* at, size_t count, uint32_t bytes, bool has_sign)
        : at_(at), count_(count), bytes_(bytes), has_sign_(has_sign) {}

    size_t size() const { return count_; }
    bool empty() const { return count_ == 0; }
    int64_t operator[](size_t i) const {
        uint64_t word = 0;
        for (uint32_t b = 0; b < bytes_; ++b)
            word |= std::to_integer<uint64_t>(at_[bytes_ * i + b]) << 8 * b;
        const uint32_t unused = 64 - 8 * bytes_;
        return has_sign_ ? static_cast<int64_t>(word << unused) >> unused
                         : static_cast<int64_t>(word);
    }

  private:
    const std::byte* at_ = nullptr;
    size_t count_ = 0;
    uint32_t bytes_ = 4;
    bool has_sign_ = true;
};

} // namespace plait
