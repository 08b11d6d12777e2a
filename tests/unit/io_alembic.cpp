#include "io_support.hpp"

#include "io/alembic/compound.hpp"
#include "io/curves/clip.hpp"
#include "io/curves/save.hpp"

#include <gmock/gmock.h>

#include <array>
#include <functional>

namespace plait {
namespace {

using testing::HasSubstr;

std::vector<std::byte> corpus(const std::string& name) {
    return file_bytes(PLAIT_SOURCE_DIR "/tests/fuzz/corpus/alembic/" + name);
}

struct Read {
    Result<StrandSet> strands = StrandSet();
    std::string notes;
};

Read read(std::span<const std::byte> bytes, StrandPart part = StrandPart::ALL, float scale = 1) {
    Read all;
    ReadOptions options{.scale = scale, .part = part, .notes = &all.notes};
    all.strands = read_alembic({bytes, "some.abc"}, options);
    return all;
}

std::vector<std::byte> sample_file() {
    const TemporaryDirectory directory;
    StrandSet strands = sample_strands({4, 2, 3});
    add_uv_and_thickness(strands);
    EXPECT_TRUE(save_curves(directory.file("a.abc"), strands).ok());
    EXPECT_EQ(directory.entries(), 1u);
    return file_bytes(directory.file("a.abc"));
}

TEST(IoAlembic, SurvivesWritingAndReading) {
    StrandSet strands = sample_strands({4, 2, 3});
    add_uv_and_thickness(strands);
    const Read again = read(sample_file());
    ASSERT_OK(again.strands);
    expect_equal(*again.strands, strands);
    EXPECT_EQ(again.notes, "");
}

TEST(IoAlembic, TheExtensionChooses) {
    const TemporaryDirectory directory;
    const StrandSet strands = sample_strands({5, 9});
    ASSERT_OK(write_strands(directory.file("a.ABC"), strands));
    const auto again = read_strands(directory.file("a.ABC"));
    ASSERT_OK(again);
    expect_equal(*again, strands);
}

TEST(IoAlembic, AnyBitsOfFloatsSurvive) {
    const TemporaryDirectory directory;
    StrandSet strands = sample_strands({3});
    const uint32_t bits[] = {0x80000000, 1, 0x7f7fffff, 0x7fc12345, 0xff800000};
    for (size_t i = 0; i < 5; ++i)
        strands.positions[i] = std::bit_cast<float>(bits[i]);
    ASSERT_OK(write_strands(directory.file("a.abc"), strands));
    const auto again = read_strands(directory.file("a.abc"));
    ASSERT_OK(again);
    EXPECT_EQ(0, std::memcmp(again->positions.data(), strands.positions.data(), 36));
}

// Blender 4.5 wrote it, its z up turned to Alembic's y up: two objects, one of which it put elsewhere.
TEST(IoAlembic, ReadsWhatBlenderWrites) {
    const Read file = read(corpus("blender"));
    ASSERT_OK(file.strands);
    EXPECT_EQ(file.strands->vertex_counts, (std::pmr::vector<uint32_t>{4, 5, 4, 3, 5, 6}));
    const float* const first = &file.strands->positions[27]; // of the second object, scaled by 2
    EXPECT_FLOAT_EQ(first[0], 0.5f);
    EXPECT_FLOAT_EQ(first[1], 0.125f);
    EXPECT_FLOAT_EQ(first[2], -0.25f);
    EXPECT_FLOAT_EQ(first[4], 0.225f);
    EXPECT_FLOAT_EQ(file.strands->thickness[0], 0.002f);
    EXPECT_FLOAT_EQ(file.strands->thickness[2], 0.004f); // twice as thick, too
    EXPECT_THAT(file.notes, HasSubstr(".userProperties"));
}

// Alembic 1.8.12 wrote it: below a scale, a turn of 90 degrees about z and a translation.
TEST(IoAlembic, TransformsAreTakenAndCubicCurvesEvaluated) {
    const Read file = read(corpus("cubic"));
    ASSERT_OK(file.strands);
    const StrandSet& s = *file.strands;
    ASSERT_EQ(s.vertex_counts.size(), 7u);
    const std::array<float, 6> line{1, 2, 5, 1, 4, 5};
    for (size_t i = 0; i < 6; ++i)
        EXPECT_NEAR(s.positions[i], line[i], 1e-6f);
    EXPECT_FLOAT_EQ(s.thickness[1], 0.4f);
    EXPECT_FLOAT_EQ(s.thickness[6], 0.2f);
    EXPECT_GT(s.vertex_counts[2], 4u);
    EXPECT_THAT(file.notes, HasSubstr("5 cubic curves were evaluated to polylines"));
    EXPECT_THAT(file.notes, HasSubstr("1 objects are not read: AbcGeom_PolyMesh_v1"));
}

TEST(IoAlembic, UnrealsSchemaTellsGuidesAndWinsOverAlembics) {
    const auto bytes = corpus("unreal");
    const Read all = read(bytes, StrandPart::ALL, 0.01f);
    ASSERT_OK(all.strands);
    EXPECT_EQ(all.strands->vertex_counts, (std::pmr::vector<uint32_t>{2, 3, 2, 2}));
    EXPECT_FLOAT_EQ(all.strands->thickness[3], 0.0004f);
    EXPECT_FLOAT_EQ(all.strands->strand_uv[7], 0.8f);
    for (const char* sentence :
         {"Unreal's groom schema, version 1.4", "2 of its 4 curves are guides",
          "2 runs of curves with one group id: 0, 1",
          "1 of its transforms and curves move and are read at their first sample: "
          "/groom/strands"})
        EXPECT_THAT(all.notes, HasSubstr(sentence));
    const Read guides = read(bytes, StrandPart::GUIDES), follows = read(bytes, StrandPart::FOLLOWS);
    ASSERT_OK(guides.strands);
    ASSERT_OK(follows.strands);
    EXPECT_EQ(guides.strands->positions[9], 3);
    EXPECT_EQ(follows.strands->vertex_counts, (std::pmr::vector<uint32_t>{3, 2}));
}

TEST(IoAlembic, AFileWithoutGuidesSaysSo) {
    expect_bad_data(read(corpus("plait"), StrandPart::GUIDES).strands,
                    "some.abc: ", "has no guides among its 6 curves");
}

TEST(IoAlembic, Hdf5IsRefusedWithTheCommandThatHelps) {
    const Read file = read(corpus("hdf5"));
    EXPECT_EQ(file.strands.error().code, PLAIT_UNSUPPORTED);
    EXPECT_THAT(file.strands.error().message, HasSubstr("abcconvert -toOgawa"));
}

TEST(IoAlembic, CutAnywhereIsRefused) {
    const std::vector<std::byte> bytes = sample_file();
    for (size_t size = 0; size < bytes.size(); ++size)
        expect_bad_data(read(std::span(bytes).first(size)).strands, "some.abc: byte ", "");
}

TEST(IoAlembic, MalformedHeadersAreRefusedWithPlaceAndValue) {
    struct Malformed {
        size_t at;
        uint32_t value;
        const char* text;
    };
    const Malformed fields[] = {
        {0, 0x61776741, "byte 0: signature is not Ogawa"},
        {4, 0x01000061, "byte 5: the mark of a closed file is 0; allowed is 255"},
        {4, 0x0200ff61, "byte 6: version of Ogawa is 2; allowed is 1"},
        {8, 0xffffff, "byte 8: root group: 8 elements of 1 bytes at byte 16777215"},
    };
    for (const Malformed& field : fields) {
        std::vector<std::byte> bytes = sample_file();
        poke(bytes, field.at, field.value);
        expect_bad_data(read(bytes).strands, "some.abc: ", field.text);
    }
}

// Whatever byte is wrong, the answer is strands or an error.
TEST(IoAlembic, AnyWrongByteIsRead) {
    for (const char* name : {"plait", "blender", "unreal"}) {
        const std::vector<std::byte> good = corpus(name);
        for (size_t i = 0; i < good.size(); ++i)
            for (const unsigned value : {0x00u, 0x01u, 0x7fu, 0xffu}) {
                std::vector<std::byte> bytes = good;
                bytes[i] = static_cast<std::byte>(value);
                const Read file = read(bytes);
                if (!file.strands) {
                    EXPECT_THAT(file.strands.error().message, HasSubstr("some.abc: "));
                }
            }
    }
}

// A file with one object whose properties are what `fill` makes them.
Result<StrandSet> read_made(const std::function<Status(CompoundWriter&)>& fill) {
    const TemporaryDirectory directory;
    auto file = NewFile::create(directory.file("a.abc"));
    EXPECT_TRUE(file.ok());
    OgawaWriter out(*file);
    MetadataList metadata;
    CompoundWriter geometry(out, metadata), properties(out, metadata);
    EXPECT_TRUE(out.begin().ok());
    EXPECT_TRUE(fill(geometry).ok());
    EXPECT_TRUE(properties.add(".geom", "", geometry).ok());
    const std::array<std::byte, 32> hashes{};
    ByteWriter header(std::pmr::get_default_resource());
    header.u32(1);
    header.text("c");
    header.u8(static_cast<uint8_t>(metadata.index("schema=AbcGeom_Curve_v2")));
    header.add(hashes);
    const OgawaWord none[] = {*properties.write(), *out.data({hashes})};
    const OgawaWord top[] = {0, *out.group(none), *out.data({header.bytes()})};
    const uint32_t zero = 0;
    const OgawaWord version = *out.data({std::as_bytes(std::span(&zero, 1))});
    const OgawaWord root[] = {version,    version,    *out.group(top),
                              OGAWA_DATA, OGAWA_DATA, *out.data({metadata.bytes()})};
    EXPECT_TRUE(out.end(*out.group(root)).ok());
    EXPECT_TRUE(file->commit().ok());
    return read_alembic({file_bytes(directory.file("a.abc")), "some.abc"}, {});
}

Status put_points(CompoundWriter& to, const std::vector<float>& points) {
    return to.constant({"P", "", AlembicType::ARRAY, AlembicPod::F32, 3}, 0, 1,
                       std::as_bytes(std::span(points)), points.size() / 3);
}

Status put_counts(CompoundWriter& to, const std::vector<int32_t>& counts) {
    return to.constant({"nVertices", "", AlembicType::ARRAY, AlembicPod::I32, 1}, 0, 1,
                       std::as_bytes(std::span(counts)), counts.size());
}

Status put_basis(CompoundWriter& to, const std::array<uint8_t, 4>& basis) {
    return to.constant({"curveBasisAndType", "", AlembicType::SCALAR, AlembicPod::U8, 4}, 0, 1,
                       std::as_bytes(std::span(basis)));
}

TEST(IoAlembic, CurvesThatDoNotFitAreRefused) {
    const std::vector<float> points(12, 0.5f);
    struct Case {
        std::vector<int32_t> counts;
        std::array<uint8_t, 4> basis;
        plait_result code;
        const char* text;
    };
    const Case cases[] = {
        {{2, 3}, {1}, PLAIT_BAD_DATA, "some.abc: /c: curve 1 has 3 points; allowed are 1 to 2"},
        {{2, -1}, {1}, PLAIT_BAD_DATA, "curve 1 has -1 points"},
        {{2, 1}, {1}, PLAIT_BAD_DATA, "its curves have 3 points together; it has 4"},
        {{4}, {1, 1}, PLAIT_UNSUPPORTED, "closed (wrap is 1)"},
        {{4}, {2, 0, 2}, PLAIT_UNSUPPORTED, "have type 2 and basis 2"},
        {{4}, {0, 0, 4}, PLAIT_UNSUPPORTED, "have type 0 and basis 4"},
        {{2, 2}, {0, 0, 1}, PLAIT_BAD_DATA, "has 2 points; a Bezier curve has 4, 7, 10, ..."},
        {{3, 1}, {0, 0, 2}, PLAIT_BAD_DATA, "has 3 points; a B-spline curve has 4 or more"},
    };
    for (const Case& wrong : cases) {
        const auto strands = read_made([&](CompoundWriter& to) -> Status {
            PLAIT_TRY(put_points(to, points));
            PLAIT_TRY(put_basis(to, wrong.basis));
            return put_counts(to, wrong.counts);
        });
        ASSERT_FALSE(strands.ok()) << wrong.text;
        EXPECT_EQ(strands.error().code, wrong.code);
        EXPECT_THAT(strands.error().message, HasSubstr(wrong.text));
    }
}

Status put_knots(CompoundWriter& to, const std::vector<float>& knots) {
    return to.constant({".knots", "", AlembicType::ARRAY, AlembicPod::F32, 1}, 0, 1,
                       std::as_bytes(std::span(knots)), knots.size());
}

// Fourfold knots at the ends are those of a curve that reaches its first and its last point.
TEST(IoAlembic, KnotsOfCubicCurvesAreUsed) {
    const std::vector<float> points{0, 0, 0, 0, 1, 0, 1, 2, 0, 2, 1, 0, 2, 0, 0};
    const auto make = [&](const std::vector<float>& knots, std::array<uint8_t, 4> basis) {
        return read_made([&](CompoundWriter& to) -> Status {
            PLAIT_TRY(put_points(to, points));
            PLAIT_TRY(put_counts(to, {5}));
            PLAIT_TRY(put_basis(to, basis));
            return knots.empty() ? Status() : put_knots(to, knots);
        });
    };
    const auto clamped = make({0, 0, 0, 0, 1, 2, 2, 2, 2}, {0, 0, 0, 0});
    ASSERT_OK(clamped);
    EXPECT_EQ(clamped->positions[0], 0);
    EXPECT_EQ(clamped->positions[clamped->positions.size() - 3], 2);
    const auto even = make({0, 1, 2, 3, 4, 5, 6, 7, 8}, {0, 0, 2, 2});
    const auto without = make({}, {0, 0, 2, 2});
    ASSERT_OK(even);
    ASSERT_OK(without);
    ASSERT_EQ(even->positions.size(), without->positions.size());
    for (size_t i = 0; i < even->positions.size(); ++i)
        EXPECT_NEAR(even->positions[i], without->positions[i], 1e-6f);
    expect_bad_data(make({0, 1, 2, 3, 4, 5, 4, 7, 8}, {0, 0, 2, 2}), "some.abc: /c: ",
                    "knot 6 of curve 0 is 4; allowed are finite ones that rise or stay");
    expect_bad_data(make({1, 1, 1, 1, 1, 1, 1, 1, 1}, {0, 0, 2, 2}), "some.abc: /c: ",
                    "curve 0 has no length: its knots are 1 from knot 3 to knot 5");
    expect_bad_data(make({0, 1, 2}, {0, 0, 2, 2}), "some.abc: /c: ",
                    "has 3 knots; allowed are four more than points for each curve, 9");
    EXPECT_THAT(make({}, {0, 0, 0, 0}).error().message, HasSubstr("of basis 0 (none)"));
}

TEST(IoAlembic, AFrameIsASampleAndTimesAreKept) {
    const TemporaryDirectory directory;
    const StrandSet strands = sample_strands({3, 2});
    for (const bool even : {true, false}) {
        auto clip = make_clip_writer(directory.file("a.abc"), {.velocities = true});
        ASSERT_OK(clip);
        ASSERT_OK((*clip)->begin({strands.vertex_counts, {}, {}}));
        for (int frame = 0; frame < 3; ++frame) {
            ASSERT_OK(
                (*clip)->add_frame(frame == 2 && !even ? 0.5 : frame / 24.0, strands.positions));
            ASSERT_OK((*clip)->add_velocities(strands.positions));
        }
        EXPECT_FALSE(std::filesystem::exists(directory.file("a.abc")));
        ASSERT_OK((*clip)->commit());
        const Read again = read(file_bytes(directory.file("a.abc")));
        ASSERT_OK(again.strands);
        EXPECT_EQ(again.strands->positions, strands.positions);
        EXPECT_THAT(again.notes, HasSubstr("move and are read at their first sample"));
        EXPECT_THAT(again.notes, HasSubstr("1 properties are not read: .velocities"));
        std::filesystem::remove(directory.file("a.abc"));
    }
    EXPECT_EQ(directory.entries(), 0u);
}

TEST(IoAlembic, WhatIsNotCommittedLeavesNothing) {
    const TemporaryDirectory directory;
    put_file(directory.file("a.abc"), "before");
    {
        auto clip = make_clip_writer(directory.file("a.abc"), {});
        ASSERT_OK(clip);
        EXPECT_EQ(directory.entries(), 2u);
    }
    EXPECT_EQ(directory.entries(), 1u);
    EXPECT_EQ(file_bytes(directory.file("a.abc")).size(), 6u);
}

} // namespace
} // namespace plait
