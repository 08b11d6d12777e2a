// Strands of .ply and .data.
#include "io_support.hpp"

#include <gmock/gmock.h>

namespace plait {
namespace {

using testing::HasSubstr;

std::vector<std::byte> corpus(const std::string& name) {
    return file_bytes(PLAIT_SOURCE_DIR "/tests/fuzz/corpus/" + name);
}

struct Read {
    Result<StrandSet> strands = StrandSet();
    std::string notes;
};

Read read(std::span<const std::byte> bytes,
          Result<StrandSet> (*reader)(const ByteReader&, const ReadOptions&) = read_ply) {
    Read all;
    ReadOptions options{.scale = 2, .notes = &all.notes};
    all.strands = reader({bytes, "some.file"}, options);
    return all;
}

Read read_text(const std::string& text) {
    return read(std::as_bytes(std::span(text)));
}

TEST(IoPoints, PlyIsReadInEveryFormat) {
    for (const char* name : {"edges_text", "edges_big", "colours_text", "colours_little"}) {
        const Read file = read(corpus(std::string("ply/") + name));
        ASSERT_OK(file.strands);
        EXPECT_EQ(file.strands->vertex_counts, (std::pmr::vector<uint32_t>{2, 3})) << name;
        EXPECT_EQ(file.strands->positions,
                  (std::pmr::vector<float>{0, 0, 0, 0, 0, 2, 2, 0, 0, 2, 0, 2, 2, 0, 4}));
        EXPECT_THAT(file.notes, HasSubstr(std::string(name).starts_with("edges")
                                              ? "1 elements face are not read"
                                              : "its 2 strands are runs of points of one colour"));
    }
}

std::string ply(const std::string& header, const std::string& values) {
    return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
           "property float z\n" +
           header + "end_header\n" + values;
}

TEST(IoPoints, MalformedPlyIsRefusedWithPlaceAndValue) {
    const std::string points = "0 0 0\n0 0 1\n0 0 2\n";
    const std::string edges = "element edge 2\nproperty int vertex1\nproperty int vertex2\n";
    const std::string edges3 = "element edge 3\nproperty int vertex1\nproperty int vertex2\n";
    const std::pair<std::string, const char*> cases[] = {
        {"plx\n", "some.file: line 1: does not begin with \"ply\""},
        {"ply\nend_header\n", "line 2: has \"end_header\"; allowed are comment"},
        {"ply\nformat text 1.0\n", "line 2: format is \"text\"; allowed are ascii"},
        {"ply\nformat ascii 1.0\nelement vertex -1\n", "line 3: number of elements is \"-1\""},
        {"ply\nformat ascii 1.0\nelement vertex 3\nproperty half x\n", "line 4: type is \"half\""},
        {"ply\nformat ascii 1.0\n", "the header does not end"},
        {ply("element vertex 0\n", points), "line 7: element \"vertex\" comes twice"},
        {ply("", points), "has points, and neither edges (vertex1, vertex2) nor colours"},
        {ply("", "0 0 0\n0 0 1\n0 0\n"), "element vertex: 3 of at least 6 bytes do not fit"},
        {ply(edges, points + "0 1\n1 2\n2 0\n"), "\"2\" follows the last element"},
        {ply("property uchar red\nproperty uchar green\nproperty uchar blue\n",
             "0 0 0 1 1 1 7\n0 0 0 1 1 1\n0 0 0 1 1 1\n"),
         "\"1\" follows the last element"},
        {ply("", "0 0 0\n0 0 1\n0 0 x\n"), "vertex 2 has \"x\"; allowed is a number"},
        {ply(edges, points + "0 1\n1 3\n"), "edge 1: vertex2 is 3; allowed is 0 to 2"},
        {ply(edges, points + "0 1\n1 0.5\n"), "edge 1: vertex2 is 0.5; allowed is 0 to 2"},
        {ply(edges, points + "0 1\n1 1\n"), "edge 1: joins vertex 1 to itself"},
        {ply(edges3, points + "0 1\n0 2\n0 1\n"), "edge 2: vertex 0 is of three edges"},
        {ply(edges3, points + "0 1\n1 2\n2 0\n"), "the edges of vertex 0 close a ring"},
        {ply("property uchar red\nproperty uchar green\nproperty uchar blue\n",
             "0 0 0 1 1 1\n0 0 0 2 2 2\n0 0 0 3 3 3\n"),
         "no two of one colour in a row"},
    };
    for (const auto& [text, message] : cases)
        expect_bad_data(read_text(text).strands, "some.file: ", message);
}

TEST(IoPoints, VerticesWithoutAnEdgeAreCounted) {
    const Read file = read_text(ply("element edge 1\nproperty int vertex1\nproperty int vertex2\n",
                                    "0 0 0\n0 0 1\n0 0 2\n1 0\n"));
    ASSERT_OK(file.strands);
    EXPECT_EQ(file.strands->vertex_counts, (std::pmr::vector<uint32_t>{2}));
    EXPECT_EQ(file.notes, "1 vertices without an edge are not read");
}

TEST(IoPoints, DataIsCountsAndPoints) {
    const Read file = read(corpus("strand_data/two"), read_strand_data);
    ASSERT_OK(file.strands);
    EXPECT_EQ(file.strands->vertex_counts, (std::pmr::vector<uint32_t>{2, 3}));
    EXPECT_EQ(file.strands->positions[5], 10);
    EXPECT_EQ(file.strands->positions[14], 16);
    EXPECT_EQ(file.notes, "");
    EXPECT_EQ(read(corpus("strand_data/single"), read_strand_data).notes,
              "1 of its 2 strands have one point: there is no hair");
}

TEST(IoPoints, DataCutAnywhereIsRefused) {
    const auto bytes = corpus("strand_data/two");
    for (size_t size = 0; size < bytes.size(); ++size)
        expect_bad_data(read(std::span(bytes).first(size), read_strand_data).strands,
                        "some.file: byte ", "");
    expect_bad_data(read(corpus("strand_data/huge"), read_strand_data).strands, "byte 0",
                    "strands: 4294967295 elements of 4 bytes");
}

TEST(IoPoints, OtherFormatsAreRefusedByName) {
    for (const auto& [path, text] :
         {std::pair("a.npz", "arrays of NumPy"), {"a.MA", "Alembic Cache"}}) {
        const auto refused = read_strands(path);
        EXPECT_EQ(refused.error().code, PLAIT_UNSUPPORTED);
        EXPECT_THAT(refused.error().message, HasSubstr(text));
    }
}

TEST(IoPoints, OnlySomeFormatsTellGuides) {
    EXPECT_EQ(read_strands("a.ply", {.part = StrandPart::GUIDES}).error().code, PLAIT_UNSUPPORTED);
}

} // namespace
} // namespace plait
