// What the tests of lib/io share: small strand sets, files made byte by byte, a place for files.
#pragma once

#include "io/bytes.hpp"
#include "io/formats.hpp"
#include "io/io.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

namespace plait {

#define ASSERT_OK(result) ASSERT_TRUE((result).ok()) << (result).error().message

// Removed with all its files at the end of the scope.
class TemporaryDirectory {
  public:
    TemporaryDirectory()
        : path_(std::filesystem::temp_directory_path() /
                format("plait-io-%08x", std::random_device{}())) {
        std::filesystem::create_directory(path_);
    }
    TemporaryDirectory(const TemporaryDirectory&) = delete;
    TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
    ~TemporaryDirectory() { std::filesystem::remove_all(path_); }

    std::string path() const { return path_.string(); }
    std::string file(const std::string& name) const { return (path_ / name).string(); }
    size_t entries() const {
        const std::filesystem::directory_iterator all(path_);
        return static_cast<size_t>(std::distance(begin(all), end(all)));
    }

  private:
    std::filesystem::path path_;
};

inline std::vector<std::byte> file_bytes(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    const auto* first = reinterpret_cast<const std::byte*>(text.data());
    return {first, first + text.size()};
}

inline void put_file(const std::string& path, std::span<const std::byte> bytes) {
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
}

inline void put_file(const std::string& path, const std::string& text) {
    put_file(path, std::as_bytes(std::span(text)));
}

// Overwrites a little-endian word.
inline void poke(std::vector<std::byte>& bytes, size_t at, uint32_t value) {
    value = little_endian(value);
    std::memcpy(&bytes[at], &value, sizeof value);
}

inline void poke(std::vector<std::byte>& bytes, size_t at, float value) {
    poke(bytes, at, std::bit_cast<uint32_t>(value));
}

inline std::vector<std::byte> to_vector(const ByteVector& bytes) {
    return {bytes.begin(), bytes.end()};
}

// Strands with different numbers in every place. `counts`: vertices of each.
inline StrandSet sample_strands(const std::vector<uint32_t>& counts) {
    StrandSet strands;
    strands.vertex_counts.assign(counts.begin(), counts.end());
    for (size_t s = 0; s < counts.size(); ++s)
        for (uint32_t v = 0; v < counts[s]; ++v)
            for (float value : {0.1f * static_cast<float>(s), -0.01f * static_cast<float>(v),
                                1.0f / static_cast<float>(1 + s + v)})
                strands.positions.push_back(value);
    return strands;
}

inline void add_uv_and_thickness(StrandSet& strands) {
    for (size_t s = 0; s < strands.vertex_counts.size(); ++s) {
        strands.strand_uv.push_back(0.25f * static_cast<float>(s));
        strands.strand_uv.push_back(1.0f - 0.125f * static_cast<float>(s));
        strands.thickness.push_back(7e-5f + 1e-6f * static_cast<float>(s));
    }
}

inline void add_skin(StrandSet& strands) {
    for (uint32_t s = 0; s < strands.vertex_counts.size(); ++s)
        for (uint32_t i = 0; i < 4; ++i) {
            strands.bone_indices.push_back((s + 2 * i) % 9);
            strands.bone_weights.push_back(0.125f * static_cast<float>(i == 0 ? 5 : 1));
        }
}

inline void expect_equal(const StrandSet& a, const StrandSet& b) {
    EXPECT_EQ(a.vertex_counts, b.vertex_counts);
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_EQ(a.strand_uv, b.strand_uv);
    EXPECT_EQ(a.thickness, b.thickness);
    EXPECT_EQ(a.bone_indices, b.bone_indices);
    EXPECT_EQ(a.bone_weights, b.bone_weights);
}

// A reader of `bytes` that fails, with `place` and `text` in its message.
template <typename Outcome>
void expect_bad_data(const Outcome& outcome, const std::string& place, const std::string& text) {
    ASSERT_FALSE(outcome.ok());
    EXPECT_EQ(outcome.error().code, PLAIT_BAD_DATA);
    EXPECT_NE(outcome.error().message.find(place), std::string::npos) << outcome.error().message;
    EXPECT_NE(outcome.error().message.find(text), std::string::npos) << outcome.error().message;
}

} // namespace plait
