#include "io_support.hpp"

namespace plait {
namespace {

StrandSet skinned_sample() {
    StrandSet strands = sample_strands({3, 3});
    add_skin(strands);
    return strands;
}

// One bone, "b", and two strands: name at 12, strand count at 14, strands at 18 and 54.
std::vector<std::byte> one_bone_file(float weight = 1.0f) {
    ByteWriter out(std::pmr::get_default_resource());
    for (uint32_t word : {1u, 0u, 2u})
        out.u32(word);
    out.text("b");
    out.zeros(1);
    out.u32(2);
    for (uint32_t s = 0; s < 2; ++s) {
        out.u32(s);
        for (uint32_t i = 0; i < 4; ++i) {
            out.u32(0);
            out.f32(i == 0 ? weight : 0.0f);
        }
    }
    return to_vector(std::move(out).take());
}

Status read(std::span<const std::byte> bytes, StrandSet& strands) {
    return read_tfxbone({bytes, "some.tfxbone"}, strands);
}

TEST(IoTfxbone, SurvivesWritingAndReading) {
    const StrandSet strands = skinned_sample();
    auto written = write_tfxbone(strands);
    ASSERT_OK(written);
    StrandSet again = sample_strands({3, 3});
    ASSERT_OK(read(*written, again));
    expect_equal(again, strands);
}

TEST(IoTfxbone, WeightsAreScaledToSumOne) {
    StrandSet strands = sample_strands({3, 3});
    ASSERT_OK(read(one_bone_file(0.92f), strands));
    EXPECT_EQ(strands.bone_weights[0], 1.0f);
    EXPECT_EQ(strands.bone_weights[1], 0.0f);
}

TEST(IoTfxbone, BoneWithoutWeightMayBeNone) {
    std::vector<std::byte> bytes = one_bone_file();
    poke(bytes, 18 + 4 + 8, 0xffffffffu);
    StrandSet strands = sample_strands({3, 3});
    ASSERT_OK(read(bytes, strands));
    EXPECT_EQ(strands.bone_indices[1], 0u);
}

TEST(IoTfxbone, CutAnywhereIsRefused) {
    const std::vector<std::byte> bytes = one_bone_file();
    for (size_t size = 0; size < bytes.size(); ++size) {
        StrandSet strands = sample_strands({3, 3});
        expect_bad_data(read(std::span(bytes).first(size), strands), "some.tfxbone: byte ",
                        "file of");
    }
}

TEST(IoTfxbone, MustBeForAsManyStrands) {
    StrandSet strands = sample_strands({3, 3, 3});
    expect_bad_data(read(one_bone_file(), strands), "byte 14",
                    "number of strands is 2; the strands are 3");
}

struct Malformed {
    size_t at;
    uint32_t value;
    const char* place;
    const char* text;
};

TEST(IoTfxbone, MalformedFieldsAreRefusedWithPlaceAndValue) {
    const Malformed fields[] = {
        {0, 0, "byte 0", "number of bones is 0"},
        {0, 0xffffffff, "byte 0", "bones: 4294967295 elements"},
        {0, 2, "byte 14", "index of bone 1 is 2"},
        {4, 7, "byte 4", "index of bone 0 is 7"},
        {8, 0xffffffff, "byte 8", "bone name: 4294967295 elements"},
        {14, 0x7fffffff, "byte 14", "strands: 2147483647 elements"},
        {14, 1, "byte 14", "number of strands is 1"},
        {54, 5, "byte 54", "index of strand 1 is 5"},
        {22, 1, "byte 22", "bone index is 1; allowed 0 to 0"},
        {22, 0xfffffffe, "byte 22", "bone index is -2"},
        {26, 0x7fc00000, "byte 26", "bone weight is nan; allowed 0 to 1"},
        {26, 0xbf800000, "byte 26", "bone weight is -1"},
        {26, 0x40000000, "byte 26", "bone weight is 2"},
        {26, 0, "byte 26", "sum to 0"},
    };
    for (const Malformed& field : fields) {
        std::vector<std::byte> bytes = one_bone_file();
        poke(bytes, field.at, field.value);
        StrandSet strands = sample_strands({3, 3});
        expect_bad_data(read(bytes, strands), std::string("some.tfxbone: ") + field.place + ": ",
                        field.text);
    }
}

TEST(IoTfxbone, AbsurdBonesAreNotWritten) {
    StrandSet strands = skinned_sample();
    strands.bone_indices[3] = 0xffffffff;
    auto written = write_tfxbone(strands);
    ASSERT_FALSE(written.ok());
    EXPECT_EQ(written.error().code, PLAIT_UNSUPPORTED);
    EXPECT_NE(written.error().message.find("4294967295"), std::string::npos);
}

} // namespace
} // namespace plait
