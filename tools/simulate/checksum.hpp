// A checksum of bytes, which finds damage and change.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace simulate {

// FNV-1a over words of 8 bytes; what is fed in several calls is another checksum than in one.
class Checksum {
  public:
    void add(const void* data, size_t size) {
        const auto* bytes = static_cast<const unsigned char*>(data);
        for (size_t word = 0; size > 0; bytes += word, size -= word) {
            word = size < 8 ? size : 8;
            uint64_t value = 0;
            std::memcpy(&value, bytes, word);
            state_ = (state_ ^ value ^ (uint64_t{word} << 56)) * 0x100000001b3u;
            state_ ^= state_ >> 29;
        }
    }
    uint64_t value() const { return state_; }

  private:
    uint64_t state_ = 0xcbf29ce484222325u;
};

} // namespace simulate
