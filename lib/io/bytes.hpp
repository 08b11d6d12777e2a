// Little-endian reading and writing of bytes, with errors that say where in which file.
#pragma once

#include "base/format.hpp"
#include "base/result.hpp"

#include <bit>
#include <cinttypes>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory_resource>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace plait {

using ByteVector = std::pmr::vector<std::byte>;

template <typename Word> Word little_endian(Word word) {
    if constexpr (std::endian::native == std::endian::big) {
        Word swapped = 0;
        for (size_t i = 0; i < sizeof word; ++i)
            swapped = static_cast<Word>(swapped << 8 | (word >> 8 * i & 0xff));
        return swapped;
    }
    return word;
}

// The bytes of one file. The readers of words trust that check_range() has passed.
class ByteReader {
  public:
    ByteReader(std::span<const std::byte> bytes, std::string file)
        : bytes_(bytes), file_(std::move(file)) {}

    uint64_t size() const { return bytes_.size(); }
    const std::string& file() const { return file_; }

    uint8_t u8(uint64_t offset) const { return word<uint8_t>(offset); }
    uint16_t u16(uint64_t offset) const { return word<uint16_t>(offset); }
    uint32_t u32(uint64_t offset) const { return word<uint32_t>(offset); }
    uint64_t u64(uint64_t offset) const { return word<uint64_t>(offset); }
    double f64(uint64_t offset) const { return std::bit_cast<double>(u64(offset)); }
    float f32(uint64_t offset) const { return std::bit_cast<float>(u32(offset)); }
    std::string text(uint64_t offset, uint64_t length) const {
        return std::string(view(offset, length));
    }
    // The same, as long as the bytes live.
    std::string_view view(uint64_t offset, uint64_t length) const {
        return {reinterpret_cast<const char*>(bytes_.data() + offset), static_cast<size_t>(length)};
    }
    const std::byte* data(uint64_t offset) const { return bytes_.data() + offset; }

    // BAD_DATA unless `count` elements of `element` bytes at `offset` lie inside the file. No sum
    // or product here can wrap: each is compared by subtraction or division. `field` is the place
    // of the number that asked for the range.
    Status check_range(const char* what, uint64_t field, uint64_t offset, uint64_t count,
                       uint64_t element) const {
        if (offset <= size() && count <= (size() - offset) / element)
            return {};
        return bad(field, format("%s: %" PRIu64 " elements of %" PRIu64 " bytes at byte %" PRIu64
                                 " do not fit in the file of %" PRIu64 " bytes",
                                 what, count, element, offset, size()));
    }

    Error bad(uint64_t offset, const std::string& text) const {
        return {PLAIT_BAD_DATA,
                format("%s: byte %" PRIu64 ": %s", file_.c_str(), offset, text.c_str())};
    }

  private:
    template <typename Word> Word word(uint64_t offset) const {
        Word value;
        std::memcpy(&value, bytes_.data() + offset, sizeof value);
        return little_endian(value);
    }

    std::span<const std::byte> bytes_;
    std::string file_;
};

class ByteWriter {
  public:
    explicit ByteWriter(std::pmr::memory_resource* memory) : bytes_(memory) {}

    void u8(uint8_t value) { word(value); }
    void u16(uint16_t value) { word(value); }
    void u32(uint32_t value) { word(value); }
    void u64(uint64_t value) { word(value); }
    void f64(double value) { word(std::bit_cast<uint64_t>(value)); }
    void f32(float value) { word(std::bit_cast<uint32_t>(value)); }
    void text(std::string_view value) { add(std::as_bytes(std::span(value))); }
    void add(std::span<const std::byte> more) {
        bytes_.insert(bytes_.end(), more.begin(), more.end());
    }
    void zeros(size_t count) { bytes_.resize(bytes_.size() + count); }
    void reserve(size_t count) { bytes_.reserve(count); }
    size_t size() const { return bytes_.size(); }
    std::span<const std::byte> bytes() const { return bytes_; }
    ByteVector take() && { return std::move(bytes_); }

  private:
    template <typename Word> void word(Word value) {
        value = little_endian(value);
        std::byte raw[sizeof value];
        std::memcpy(raw, &value, sizeof value);
        bytes_.insert(bytes_.end(), raw, raw + sizeof value);
    }

    ByteVector bytes_;
};

} // namespace plait
