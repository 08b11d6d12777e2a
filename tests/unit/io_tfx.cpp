#include "io_support.hpp"

namespace plait {
namespace {

StrandSet full_sample() {
    StrandSet strands = sample_strands({5, 5, 5});
    add_uv_and_thickness(strands);
    return strands;
}

// A version 4 file of 3 strands of 5 vertices: positions at 160, UV at 400, thickness at 424.
std::vector<std::byte> sample_file() {
    auto written = write_tfx(full_sample());
    EXPECT_TRUE(written.ok());
    EXPECT_EQ(written->size(), 436u);
    return to_vector(*written);
}

Result<StrandSet> read(std::span<const std::byte> bytes, float scale = 1.0f) {
    return read_tfx({bytes, "some.tfx"}, {.scale = scale});
}

TEST(IoTfx, SurvivesWritingAndReading) {
    auto again = read(sample_file());
    ASSERT_OK(again);
    expect_equal(*again, full_sample());
}

TEST(IoTfx, SurvivesWithoutUvAndThickness) {
    const StrandSet strands = sample_strands({2, 2});
    auto written = write_tfx(strands);
    ASSERT_OK(written);
    EXPECT_EQ(written->size(), 160u + 4 * 16);
    auto again = read(*written);
    ASSERT_OK(again);
    expect_equal(*again, strands);
}

TEST(IoTfx, WritesTheLayoutOfVersion4) {
    const std::vector<std::byte> bytes = sample_file();
    const ByteReader file(bytes, "some.tfx");
    EXPECT_EQ(file.f32(0), 4.0f);
    const uint32_t words[] = {3, 5, 160, 400, 0, 424, 0};
    for (size_t i = 0; i < std::size(words); ++i)
        EXPECT_EQ(file.u32(4 + 4 * i), words[i]) << "word " << i;
    for (uint64_t at = 32; at < 160; at += 4)
        EXPECT_EQ(file.u32(at), 0u) << "reserved byte " << at;
    for (uint32_t v = 0; v < 15; ++v) // inverse mass: the first two of each strand are pinned
        EXPECT_EQ(file.f32(160 + 16 * v + 12), v % 5 < 2 ? 0.0f : 1.0f) << "vertex " << v;
}

TEST(IoTfx, ScaleIsOfPositionsAndThicknessOnly) {
    auto scaled = read(sample_file(), 0.5f);
    ASSERT_OK(scaled);
    StrandSet expected = full_sample();
    for (float& value : expected.positions)
        value *= 0.5f;
    for (float& value : expected.thickness)
        value *= 0.5f;
    expect_equal(*scaled, expected);
}

TEST(IoTfx, StrandsOfOneVertexAreLeftToRepair) {
    auto written = write_tfx(sample_strands({1, 1}));
    ASSERT_OK(written);
    auto strands = read(*written);
    ASSERT_OK(strands);
    EXPECT_EQ(strands->vertex_counts.front(), 1u);
}

TEST(IoTfx, NonFinitePositionsAreLeftToRepair) {
    std::vector<std::byte> bytes = sample_file();
    poke(bytes, 164, 0x7fc00000u);
    auto strands = read(bytes);
    ASSERT_OK(strands);
    EXPECT_NE(strands->positions[1], strands->positions[1]);
}

// Version 3: 296-byte header, positions of three floats.
std::vector<std::byte> version_3_file(const StrandSet& strands) {
    ByteWriter out(std::pmr::get_default_resource());
    out.f32(3.0f);
    out.u32(static_cast<uint32_t>(strands.vertex_counts.size()));
    out.u32(strands.vertex_counts.front());
    out.zeros(144 - out.size());
    const uint32_t thickness = 296 + 4 * static_cast<uint32_t>(strands.positions.size());
    const uint32_t uv = thickness + 4 * static_cast<uint32_t>(strands.thickness.size());
    for (uint32_t offset : {296u, thickness, uv})
        out.u32(offset);
    out.zeros(296 - out.size());
    for (const auto* values : {&strands.positions, &strands.thickness, &strands.strand_uv})
        for (float value : *values)
            out.f32(value);
    return to_vector(std::move(out).take());
}

TEST(IoTfx, ReadsVersion3) {
    auto strands = read(version_3_file(full_sample()));
    ASSERT_OK(strands);
    expect_equal(*strands, full_sample());
}

TEST(IoTfx, Version3CutAnywhereIsRefused) {
    const std::vector<std::byte> bytes = version_3_file(full_sample());
    for (size_t size = 0; size < bytes.size(); ++size)
        expect_bad_data(read(std::span(bytes).first(size)), "some.tfx: byte ", "file of");
}

TEST(IoTfx, CutAnywhereIsRefused) {
    const std::vector<std::byte> bytes = sample_file();
    for (size_t size = 0; size < bytes.size(); ++size)
        expect_bad_data(read(std::span(bytes).first(size)), "some.tfx: byte ", "file of");
}

struct Malformed {
    const char* what;
    size_t at;
    uint32_t value;
    const char* text; // in the message, which must name the byte `at` too
};

class IoTfxMalformed : public testing::TestWithParam<Malformed> {};

TEST_P(IoTfxMalformed, IsRefusedWithItsPlaceAndValue) {
    const Malformed& field = GetParam();
    std::vector<std::byte> bytes = sample_file();
    poke(bytes, field.at, field.value);
    expect_bad_data(read(bytes), format("some.tfx: byte %zu: ", field.at), field.text);
}

constexpr uint32_t MOST = 0xffffffff;
const Malformed MALFORMED[] = {
    {"version 2", 0, 0x40000000, "version is 2; allowed 3 and 4"},
    {"version 5", 0, 0x40a00000, "version is 5"},
    {"version NaN", 0, 0x7fc00000, "version is nan"},
    {"text for a version", 0, 0x72696148, "version is"},
    {"no strands", 4, 0, "number of strands is 0; allowed 1 to 4294967295"},
    {"no vertices", 8, 0, "number of vertices per strand is 0"},
    {"positions absent", 12, 0, "offset of positions is 0, inside the header of 160 bytes"},
    {"positions in the header", 12, 156, "offset of positions is 156"},
    {"positions cut", 12, 197, "positions: 15 elements of 16 bytes at byte 197"},
    {"positions beyond the file", 12, MOST, "at byte 4294967295 do not fit in the file of 436"},
    {"UV in the header", 16, 8, "offset of strand UV is 8"},
    {"UV cut", 16, 413, "strand UV: 3 elements of 8 bytes at byte 413"},
    {"UV beyond the file", 16, MOST, "strand UV"},
    {"vertex UV in the header", 20, 1, "offset of vertex UV is 1"},
    {"vertex UV cut", 20, 317, "vertex UV: 15 elements of 8 bytes at byte 317"},
    {"thickness in the header", 24, 159, "offset of strand thickness is 159"},
    {"thickness cut", 24, 425, "strand thickness: 3 elements of 4 bytes at byte 425"},
    {"colour in the header", 28, 12, "offset of vertex colour is 12"},
    {"colour cut", 28, 400, "vertex colour: 15 elements of 16 bytes at byte 400"},
};

std::string test_name(const testing::TestParamInfo<Malformed>& info) {
    std::string name = info.param.what;
    for (char& c : name)
        if (c == ' ')
            c = '_';
    return name;
}

INSTANTIATE_TEST_SUITE_P(Header, IoTfxMalformed, testing::ValuesIn(MALFORMED), test_name);

// Their products wrap in 32 and in 64 bits.
TEST(IoTfx, HugeCountsAreRefusedBeforeMemoryIsTaken) {
    const uint32_t counts[][2] = {
        {MOST, MOST},          {MOST, 1}, {1, MOST}, {0x10000, 0x10000}, {3, 0x10000000},
        {0x80000000, 0x20000}, {4, 5},    {3, 6}};
    for (const auto& [strands, vertices] : counts) {
        std::vector<std::byte> bytes = sample_file();
        poke(bytes, 4, strands);
        poke(bytes, 8, vertices);
        const ReadOptions options = {.memory = std::pmr::null_memory_resource()};
        expect_bad_data(read_tfx({bytes, "some.tfx"}, options), "byte 12", "do not fit");
    }
}

TEST(IoTfx, UnequalStrandsAreNotWritten) {
    auto written = write_tfx(sample_strands({4, 4, 3}));
    ASSERT_FALSE(written.ok());
    EXPECT_EQ(written.error().code, PLAIT_UNSUPPORTED);
    EXPECT_NE(written.error().message.find("strand 2 has 3 vertices"), std::string::npos);
}

TEST(IoTfx, NoStrandsAreNotWritten) {
    EXPECT_EQ(write_tfx(StrandSet()).error().code, PLAIT_UNSUPPORTED);
}

} // namespace
} // namespace plait
