#include "io_support.hpp"

namespace plait {
namespace {

// Strands of 4, 2 and 1 vertices: segments at 128, points at 134, thickness at 218.
StrandSet sample() {
    StrandSet strands = sample_strands({4, 2, 1});
    strands.thickness = {7e-5f, 8e-5f, 9e-5f};
    return strands;
}

std::vector<std::byte> sample_file() {
    auto written = write_hair(sample());
    EXPECT_TRUE(written.ok());
    EXPECT_EQ(written->size(), 246u);
    return to_vector(*written);
}

Result<StrandSet> read(std::span<const std::byte> bytes, float scale = 1.0f) {
    return read_hair({bytes, "some.hair"}, {.scale = scale});
}

// A header and `points` points, with what the header's defaults say of them.
std::vector<std::byte> file_of_defaults(uint32_t strands, uint32_t points, uint32_t segments,
                                        float thickness) {
    ByteWriter out(std::pmr::get_default_resource());
    out.text("HAIR");
    for (uint32_t word : {strands, points, 2u, segments})
        out.u32(word);
    out.f32(thickness);
    out.zeros(128 - out.size());
    for (uint32_t i = 0; i < 3 * points; ++i)
        out.f32(static_cast<float>(i));
    return to_vector(std::move(out).take());
}

TEST(IoHair, SurvivesWritingAndReading) {
    auto again = read(sample_file());
    ASSERT_OK(again);
    expect_equal(*again, sample());
}

TEST(IoHair, SurvivesWithoutThickness) {
    const StrandSet strands = sample_strands({3, 7});
    auto written = write_hair(strands);
    ASSERT_OK(written);
    auto again = read(*written);
    ASSERT_OK(again);
    expect_equal(*again, strands);
}

TEST(IoHair, DefaultsOfTheHeaderHoldWhereThereIsNoArray) {
    auto strands = read(file_of_defaults(2, 6, 2, 1e-4f), 0.5f);
    ASSERT_OK(strands);
    EXPECT_EQ(strands->vertex_counts, (std::pmr::vector<uint32_t>{3, 3}));
    EXPECT_EQ(strands->thickness, (std::pmr::vector<float>{0.5e-4f, 0.5e-4f}));
    EXPECT_EQ(strands->positions[17], 8.5f);
}

TEST(IoHair, ThicknessIsTheMeanOfThePoints) {
    std::vector<std::byte> bytes = sample_file();
    for (uint32_t v = 0; v < 4; ++v)
        poke(bytes, 218 + 4 * v, 1e-4f * static_cast<float>(v + 1));
    auto strands = read(bytes);
    ASSERT_OK(strands);
    EXPECT_FLOAT_EQ(strands->thickness[0], 2.5e-4f);
    EXPECT_EQ(strands->thickness[1], 8e-5f);
}

TEST(IoHair, CutAnywhereIsRefused) {
    const std::vector<std::byte> bytes = sample_file();
    for (size_t size = 0; size < bytes.size(); ++size)
        expect_bad_data(read(std::span(bytes).first(size)), "some.hair: byte ", "file of");
}

struct Malformed {
    size_t at;
    uint32_t value;
    const char* place;
    const char* text;
};

TEST(IoHair, MalformedFieldsAreRefusedWithPlaceAndValue) {
    const Malformed fields[] = {
        {0, 0x45524148, "byte 0", "signature is not HAIR"},
        {4, 0, "byte 4", "number of strands is 0; allowed 1 to 4294967295"},
        {4, 0xffffffff, "byte 4", "segments: 4294967295 elements of 2 bytes at byte 128"},
        {4, 2, "byte 8", "number of points is 7; the strands' segments need 6"},
        {8, 0, "byte 8", "number of points is 0"},
        {8, 8, "byte 8", "thickness: 8 elements of 4 bytes"},
        {8, 0xffffffff, "byte 8", "points: 4294967295 elements of 12 bytes at byte 134"},
        {12, 5, "byte 12", "flags are 0x5; bit 1 (points) must be set"},
        {12, 0x27, "byte 12", "flags are 0x27"},
        {12, 15, "byte 8", "transparency: 7 elements of 4 bytes at byte 246"},
        {12, 23, "byte 8", "colours: 7 elements of 12 bytes at byte 246"},
        {128, 0x00010004, "byte 8", "the strands' segments need 8"},
    };
    for (const Malformed& field : fields) {
        std::vector<std::byte> bytes = sample_file();
        poke(bytes, field.at, field.value);
        expect_bad_data(read(bytes), std::string("some.hair: ") + field.place + ": ", field.text);
    }
}

// 2^32 vertices per strand: the count of them wraps to 0 in 32 bits.
TEST(IoHair, HugeDefaultSegmentsAreRefused) {
    expect_bad_data(read(file_of_defaults(2, 6, 0xffffffff, 0)), "byte 8",
                    "the strands' segments need 8589934592");
}

TEST(IoHair, StrandsTooLongForTheFormatAreNotWritten) {
    EXPECT_TRUE(write_hair(sample_strands({65536})).ok());
    auto written = write_hair(sample_strands({2, 65537}));
    ASSERT_FALSE(written.ok());
    EXPECT_EQ(written.error().code, PLAIT_UNSUPPORTED);
    EXPECT_NE(written.error().message.find("strand 1 has 65537 vertices"), std::string::npos);
}

TEST(IoHair, NoStrandsAreNotWritten) {
    EXPECT_EQ(write_hair(StrandSet()).error().code, PLAIT_UNSUPPORTED);
}

} // namespace
} // namespace plait
