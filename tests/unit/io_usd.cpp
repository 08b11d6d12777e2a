#include "io_support.hpp"

#include "io/curves/clip.hpp"
#include "io/curves/number.hpp"
#include "io/curves/save.hpp"

#include <gmock/gmock.h>

#include <bit>

namespace plait {
namespace {

using testing::HasSubstr;

std::vector<std::byte> corpus(const std::string& name) {
    return file_bytes(PLAIT_SOURCE_DIR "/tests/fuzz/corpus/usd/" + name);
}

struct Read {
    Result<StrandSet> strands = StrandSet();
    std::string notes;
};

Read read(std::span<const std::byte> bytes, StrandPart part = StrandPart::ALL) {
    Read all;
    ReadOptions options{.part = part, .notes = &all.notes};
    all.strands = read_usd({bytes, "some.usda"}, options);
    return all;
}

Read read(const std::string& text) {
    return read(std::as_bytes(std::span(text)));
}

// A stage with one prim of curves that has these lines.
std::string stage(const std::string& lines) {
    return "#usda 1.0\n(\n    metersPerUnit = 1\n    upAxis = \"Y\"\n)\ndef BasisCurves "
           "\"c\"\n{\n" +
           lines + "\n}\n";
}

std::string linear(const std::string& lines) {
    return stage("uniform token type = \"linear\"\n" + lines);
}

std::vector<std::byte> saved(const StrandSet& strands) {
    const TemporaryDirectory directory;
    EXPECT_TRUE(write_strands(directory.file("a.usda"), strands).ok());
    EXPECT_EQ(directory.entries(), 1u);
    return file_bytes(directory.file("a.usda"));
}

TEST(IoUsd, SurvivesWritingAndReading) {
    StrandSet strands = sample_strands({4, 2, 3});
    add_uv_and_thickness(strands);
    strands.positions[0] = -0.0f;
    strands.positions[1] = 1e-45f;
    strands.positions[2] = std::numeric_limits<float>::max();
    const auto bytes = saved(strands);
    const Read again = read(bytes);
    ASSERT_OK(again.strands);
    expect_equal(*again.strands, strands);
    EXPECT_TRUE(std::signbit(again.strands->positions[0]));
    EXPECT_EQ(again.notes, "metersPerUnit is 1, upAxis is Y");
    EXPECT_EQ(saved(*again.strands), bytes);
}

TEST(IoUsd, ReadsWhatBlenderWrites) {
    const Read file = read(corpus("blender"));
    ASSERT_OK(file.strands);
    ASSERT_EQ(file.strands->vertex_counts.size(), 6u); // two of them cubic
    EXPECT_EQ(file.strands->vertex_counts[2], 4u);
    const float* const point = &file.strands->positions[file.strands->positions.size() - 54];
    EXPECT_FLOAT_EQ(point[0], 0.5f);
    EXPECT_FLOAT_EQ(point[1], 0.125f);
    EXPECT_FLOAT_EQ(point[2], -0.25f);
    EXPECT_FLOAT_EQ(file.strands->thickness[2], 0.004f);
    EXPECT_THAT(file.notes, HasSubstr("metersPerUnit is 1, upAxis is Z; 2 cubic curves"));
}

// Where USD 26.11, which wrote the file, puts the points of its first prim, in metres and with y up.
TEST(IoUsd, TransformsAreThoseOfUsd) {
    const Read file = read(corpus("features"));
    ASSERT_OK(file.strands);
    const float world[5][3] = {{0.1780559f, 0.2046877f, -0.2066586f},
                               {0.2126884f, 0.0884806f, -0.3657073f},
                               {0.1755317f, 0.2204416f, -0.2187186f},
                               {0.2101642f, 0.1042344f, -0.3777673f},
                               {0.3078415f, 0.1247130f, -0.3714607f}};
    for (size_t i = 0; i < 15; ++i)
        EXPECT_NEAR(file.strands->positions[i], world[i / 3][i % 3], 1e-7f) << i;
    EXPECT_FLOAT_EQ(file.strands->thickness[1], 0.02f * 0.01f * 2);
    EXPECT_EQ(file.strands->strand_uv[0], 0.75f); // by its index
    EXPECT_EQ(file.strands->strand_uv[2], 0.25f);
    for (const char* sentence :
         {"metersPerUnit is 0.01, upAxis is Z", "1 of its 5 curves are guides",
          "3 cubic curves were evaluated", "1 properties are not read: primvars:colour",
          "1 prims are not read: Mesh", "not read: variantSet of /world"})
        EXPECT_THAT(file.notes, HasSubstr(sentence));
    EXPECT_EQ(read(corpus("features"), StrandPart::GUIDES).strands->vertex_counts.size(), 1u);
}

TEST(IoUsd, FirstSamplesOfTimeAreTaken) {
    const Read file = read(corpus("short"));
    ASSERT_OK(file.strands);
    EXPECT_EQ(file.strands->positions[5], 0.01f);
    EXPECT_THAT(file.notes, HasSubstr("metersPerUnit is 0.01, USD's default, as it is not given"));
    EXPECT_THAT(file.notes, HasSubstr("move and are read at their first sample: /a"));
}

TEST(IoUsd, TheEarliestSampleIsTakenWhereverItStands) {
    const Read file =
        read(linear("point3f[] points.timeSamples = {5: [(5, 0, 0)], -1: [(1, 0, 0)],\n"
                    "2: [(2, 0, 0)]}\nint[] curveVertexCounts = [1]"));
    ASSERT_OK(file.strands);
    EXPECT_EQ(file.strands->positions[0], 1);
}

TEST(IoUsd, AMarkOfUtf8AndCarriageReturnsArePassedOver) {
    std::string text = linear("point3f[] points = [(1, 2, 3)]\nint[] curveVertexCounts = [1]");
    std::ranges::replace(text, '\n', '\r');
    const Read file = read("\xef\xbb\xbf" + text);
    ASSERT_OK(file.strands);
    EXPECT_EQ(file.strands->positions[2], 3);
}

// Of a prim that another file may define.
TEST(IoUsd, OversAreNoHair) {
    const std::string over = "over BasisCurves \"far\" { int[] curveVertexCounts = [1] }\n";
    const Read file = read(
        linear("point3f[] points = [(0, 0, 0)]\nint[] curveVertexCounts = [1]\n" + over) + over);
    ASSERT_OK(file.strands);
    EXPECT_EQ(file.strands->vertex_counts.size(), 1u);
    EXPECT_THAT(file.notes,
                HasSubstr("2 parts that come from elsewhere are not read: over /c/far, over /far"));
}

TEST(IoUsd, AFileWithoutCurvesSaysWhatOfItWasNotRead) {
    const Read file = read("#usda 1.0\n(subLayers = [@a.usda@])\ndef Mesh \"a\" {}\n"
                           "def BasisCurves \"b\" (active = false) {}\n"
                           "def \"c\" (references = @b.usda@) {}\n");
    expect_bad_data(file.strands,
                    "some.usda: has no curves; 2 prims are not read: Mesh, /b (inactive); ",
                    "2 parts that come from elsewhere are not read: subLayers, references of /c");
}

TEST(IoUsd, InactivePrimsAreLeftOut) {
    const std::string two =
        linear("point3f[] points = [(0, 0, 0)]\nint[] curveVertexCounts = [1]") +
        "def BasisCurves \"off\" (active = false) { point3f[] points = [(2, 2, 2)] }";
    const Read file = read(two);
    ASSERT_OK(file.strands);
    EXPECT_EQ(file.strands->vertex_counts.size(), 1u);
    EXPECT_THAT(file.notes, HasSubstr("1 prims are not read: /off (inactive)"));
}

TEST(IoUsd, BinaryAndArchivesAreRefusedWithTheCommandThatHelps) {
    EXPECT_THAT(read(corpus("binary")).strands.error().message,
                HasSubstr("is USD, but binary, which is not read; \"usdcat IN -o OUT.usda\""));
    for (const char* path : {"no/such.usdc", "no/such.USDZ"}) {
        const auto refused = read_strands(path);
        EXPECT_EQ(refused.error().code, PLAIT_UNSUPPORTED);
        EXPECT_THAT(refused.error().message, HasSubstr("usdcat"));
    }
}

TEST(IoUsd, MalformedTextIsRefusedWithItsLine) {
    struct Malformed {
        std::string text;
        const char* message;
    };
    const Malformed cases[] = {
        {"#usd\n", "some.usda: line 1: does not begin with \"#usda 1.0\""},
        {"#usda 1.0\n(\n upAxis = \"X\"\n)",
         "line 3: upAxis is \"X\"; allowed are \"Y\" and \"Z\""},
        {"#usda 1.0\n(\n metersPerUnit = 0\n)", "line 3: metersPerUnit is 0; allowed is (0, 1e6]"},
        {"#usda 1.0\n(\n doc = \"\"\"a\nb", "line 3: a text in quotes does not end"},
        {"#usda 1.0\ndef Xform \"a\"\n{\n", "line 4: the text ends; allowed is a word"},
        {"#usda 1.0\ndef Xform \"a\" (b = [1}\n", "line 2: has \"}\"; allowed is \"]\""},
        {linear("point3f[] points = [(0, 0)]"), "line 9: has \")]\n}\n\"; allowed is \",\""},
        {linear("point3f[] points = [(0, 0, x)]"), "line 9: has \"x\"; allowed is a number"},
        {linear("point3f[] points = [(0, 0, 1)\nint[] x"),
         "line 10: has \"int[] x\n\"; allowed is"},
        {linear("int[] curveVertexCounts = [3000000000]"),
         "has \"3000000000\"; allowed is a number"},
        {linear("int[] curveVertexCounts = [1]"),
         "some.usda: /c: curve 0 has 1 points; allowed are 1 to 0"},
        {stage("int[] curveVertexCounts = [1]\npoint3f[] points = [(0, 0, 0)]"),
         "curve 0, from point 0 on, has 1 points; a Bezier curve has 4, 7, 10, ..."},
        {linear("uniform token[] xformOpOrder = [\"xformOp:scale\"]"),
         "/c: operation \"xformOp:scale\" has 0 values"},
        {linear("point3f[] points = [(0, 0, 0)]\nint[] curveVertexCounts = [1]\n"
                "float[] widths = [1, 2]"),
         "width has 2 values; allowed are 1"},
        {stage("}\ndef Xform \"d\" {\ndef Xform \"e\" {}\ndouble3 xformOp:scale = (1, 1, 1)\n"),
         "its transform comes behind the prims that it moves"},
        {"#usda 1.0\n", "some.usda: has no curves"},
    };
    for (const Malformed& wrong : cases)
        expect_bad_data(read(wrong.text).strands, "some.usda: ", wrong.message);
}

TEST(IoUsd, CurvesOfOtherKindsAreRefused) {
    for (const auto& [line, message] :
         {std::pair("uniform token wrap = \"periodic\"", "wrap of its curves is \"periodic\""),
          std::pair("uniform token basis = \"hermite\"", "type \"cubic\" and basis \"hermite\"")}) {
        const Read file = read(stage(line));
        EXPECT_EQ(file.strands.error().code, PLAIT_UNSUPPORTED);
        EXPECT_THAT(file.strands.error().message, HasSubstr(message));
    }
}

TEST(IoUsd, CutAnywhereIsRefused) {
    for (const char* name : {"plait", "features"}) {
        const auto bytes = corpus(name);
        for (size_t size = 0; size + 2 < bytes.size(); ++size)
            expect_bad_data(read(std::span(bytes).first(size)).strands, "some.usda: ", "");
    }
}

TEST(IoUsd, AFrameIsASampleAndVelocitiesFollow) {
    const TemporaryDirectory directory;
    const StrandSet strands = sample_strands({3, 2});
    auto clip = make_clip_writer(directory.file("a.usda"), {.velocities = true});
    ASSERT_OK(clip);
    ASSERT_OK((*clip)->begin({strands.vertex_counts, {}, {}}));
    for (int frame = 0; frame < 3; ++frame) {
        ASSERT_OK((*clip)->add_frame(frame / 24.0, strands.positions));
        ASSERT_OK((*clip)->add_velocities(strands.positions));
    }
    EXPECT_FALSE(std::filesystem::exists(directory.file("a.usda")));
    ASSERT_OK((*clip)->commit());
    clip->reset();
    EXPECT_EQ(directory.entries(), 1u);
    const auto bytes = file_bytes(directory.file("a.usda"));
    const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    for (const char* part :
         {"startTimeCode = 0 ", "endTimeCode = 2 ", "timeCodesPerSecond = 24",
          "            1: [(0, -0, 1), ", "vector3f[] velocities.timeSamples = {"})
        EXPECT_THAT(text, HasSubstr(part));
    const Read again = read(bytes);
    ASSERT_OK(again.strands);
    EXPECT_EQ(again.strands->positions, strands.positions);
}

// Of every exponent: both signs, both ends and many between.
TEST(IoUsd, NumbersAreReadBackToTheBit) {
    const auto text_of = [](float value) {
        char text[24];
        return std::string(text, put_number(text, value));
    };
    for (uint32_t bits = 0; bits < 0x7f800000u; bits += 4093) // which 2^23 is no multiple of
        for (const uint32_t near : {bits, bits & 0xff800000u, bits | 0x7fffffu})
            for (const float value : {std::bit_cast<float>(near), -std::bit_cast<float>(near)}) {
                const std::string text = text_of(value);
                EXPECT_EQ(std::strtof(text.c_str(), nullptr), value) << text;
                EXPECT_EQ(static_cast<float>(std::strtod(text.c_str(), nullptr)), value) << text;
            }
    EXPECT_EQ(text_of(1), "1");
    EXPECT_EQ(text_of(-12), "-12");
    EXPECT_EQ(text_of(0.25f), "0.25000000");
    EXPECT_EQ(text_of(-0.0f), "-0");
}

TEST(IoUsd, LeftHandedAxesAreRefused) {
    const auto clip = make_clip_writer("a.usda", {.axes = PLAIT_AXES_Z_UP_LEFT_HANDED});
    ASSERT_FALSE(clip.ok());
    EXPECT_EQ(clip.error().code, PLAIT_UNSUPPORTED);
}

} // namespace
} // namespace plait
