// Trajectories: what is written is read back; what is cut short or wrong is recognised.
#include "cache.hpp"
#include "common.hpp"
#include "support.hpp"

#include <numeric>
#include <vector>

using simulate::CacheReader;
using simulate::CacheWriter;
using simulate::Shot;

namespace {

constexpr uint32_t strands = 3, row = 4, frames = 5;

class Cache : public TemporaryFolder {
  protected:
    static std::vector<float> positions(uint32_t frame) {
        std::vector<float> values(4 * strands * row);
        std::iota(values.begin(), values.end(), 1000.0f * static_cast<float>(frame));
        return values;
    }

    std::string write_all() const {
        const std::vector<uint32_t> counts{4, 3, 2};
        CacheWriter writer(path("a.cache"), counts, row, frames, 50.0f);
        for (uint32_t frame = 0; frame < frames; ++frame) {
            const std::vector<float> values = positions(frame);
            writer.append({frame,
                           0.0f,
                           {{0, 0, 0, 1}, {0.5f * static_cast<float>(frame), 0, 0}},
                           values,
                           counts,
                           row});
        }
        return path("a.cache");
    }
};

TEST_F(Cache, reads_what_was_written_in_any_order) {
    CacheReader reader(write_all());
    EXPECT_EQ(reader.frames(), frames);
    EXPECT_EQ(reader.header().frames_planned, frames);
    for (const uint32_t frame : {4u, 0u, 2u}) {
        const Shot shot = reader.read(frame);
        const std::vector<float> expected = positions(frame);
        EXPECT_FLOAT_EQ(shot.head.t[0], 0.5f * static_cast<float>(frame));
        EXPECT_FLOAT_EQ(shot.time, static_cast<float>(frame) / 50.0f);
        EXPECT_EQ(shot.vertex_count[1], 3u);
        for (size_t i = 0; i < expected.size(); ++i) {
            if (i % 4 != 3) { // the fourth component is not stored
                EXPECT_EQ(shot.positions[i], expected[i]) << frame << ": " << i;
            }
        }
    }
}

TEST_F(Cache, cut_anywhere_holds_its_whole_frames) {
    const std::string file = write_all();
    const uintmax_t whole = std::filesystem::file_size(file);
    const uintmax_t frame_size = 4 * (7 + 3 * strands * row);
    std::filesystem::resize_file(file, whole - 1);
    EXPECT_EQ(CacheReader(file).frames(), frames - 1);
    std::filesystem::resize_file(file, whole - 3 * frame_size);
    EXPECT_EQ(CacheReader(file).frames(), frames - 3);
    std::filesystem::resize_file(file, 32 + 4 * strands);
    EXPECT_EQ(CacheReader(file).frames(), 0u);
    std::filesystem::resize_file(file, 40);
    EXPECT_THROW(CacheReader{file}, simulate::Failure);
    std::filesystem::resize_file(file, 10);
    EXPECT_THROW(CacheReader{file}, simulate::Failure);
}

TEST_F(Cache, other_files_are_refused) {
    EXPECT_THROW(CacheReader{write("b.cache", std::string(200, 'x'))}, simulate::Failure);
    EXPECT_THROW(CacheReader{path("missing")}, simulate::Failure);
    CacheReader reader(write_all());
    EXPECT_THROW(reader.read(frames), simulate::Failure);
}

} // namespace
