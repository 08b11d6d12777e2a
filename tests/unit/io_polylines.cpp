#include "io_support.hpp"

namespace plait {
namespace {

Result<StrandSet> read_obj(const std::string& text, float scale = 1.0f) {
    const auto bytes = std::as_bytes(std::span(text));
    return read_polylines({bytes.begin(), bytes.end()}, "memory.obj", {.scale = scale});
}

using Counts = std::pmr::vector<uint32_t>;
using Floats = std::pmr::vector<float>;

const std::string POINTS = "v 0 0 0\nv 0 1 0\nv 0 2 0\nv 1 0 0\nv 1 1 0.5\n";

TEST(IoPolylines, EachLineOfObjIsAStrand) {
    auto strands = read_obj(POINTS + "l 1 2 3\nl 4 5\n", 2.0f);
    ASSERT_OK(strands);
    EXPECT_EQ(strands->vertex_counts, (Counts{3, 2}));
    EXPECT_EQ(strands->positions, (Floats{0, 0, 0, 0, 2, 0, 0, 4, 0, 2, 0, 0, 2, 2, 1}));
}

TEST(IoPolylines, ConsecutiveSegmentsOfObjAreOneStrand) {
    auto strands = read_obj(POINTS + "l 1 2\nl 2 3\nl 4 5\n");
    ASSERT_OK(strands);
    EXPECT_EQ(strands->vertex_counts, (Counts{3, 2}));
}

// Five vertices at x = 0..4, which the tests below begin their files with.
const std::string FIVE = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nv 4 0 0\n";

// The x of all vertices of all strands.
void expect_x(const std::string& text, const std::vector<float>& expected) {
    auto strands = read_obj(text);
    ASSERT_OK(strands) << text;
    std::vector<float> x;
    for (size_t i = 0; i < strands->positions.size(); i += 3)
        x.push_back(strands->positions[i]);
    EXPECT_EQ(x, expected) << text;
}

// Six strands of eight vertices, as one line per segment: in order, shuffled, each from its far end.
TEST(IoPolylines, SegmentsInAnyOrderAndDirectionAreStrands) {
    std::string points;
    std::vector<std::pair<int, int>> in_order;
    for (int strand = 0; strand < 6; ++strand)
        for (int i = 0; i < 8; ++i) {
            points += format("v %d %d 0\n", strand, i);
            if (i > 0)
                in_order.emplace_back(8 * strand + i, 8 * strand + i + 1);
        }
    const auto read = [&](const std::vector<std::pair<int, int>>& lines) {
        std::string text = points;
        for (const auto& [from, to] : lines)
            text += format("l %d %d\n", from, to);
        return read_obj(text);
    };
    const auto expected = read(in_order);
    ASSERT_OK(expected);
    EXPECT_EQ(expected->vertex_counts, Counts(6, 8));
    auto turned = in_order, shuffled = in_order, both = in_order;
    for (auto& [from, to] : turned)
        std::swap(from, to);
    for (size_t i = 0; i < shuffled.size(); ++i) {
        shuffled[i] = in_order[i * 17 % 42];
        both[i] = (i % 3 ? in_order : turned)[i * 25 % 42];
    }
    for (const auto& lines : {turned, shuffled, both}) {
        const auto strands = read(lines);
        ASSERT_OK(strands);
        EXPECT_EQ(strands->vertex_counts, expected->vertex_counts);
        EXPECT_EQ(strands->positions, expected->positions);
    }
}

TEST(IoPolylines, ALineOfThreeAndMoreSaysWhichEndIsTheRoot) {
    expect_x(FIVE + "l 5 4 3\nl 3 2\nl 2 1\n", {4, 3, 2, 1, 0});
    expect_x(FIVE + "l 3 2\nl 2 1\n", {0, 1, 2});
}

// A tuft at one vertex, and tips that meet.
TEST(IoPolylines, LinesThatBeginOrEndTogetherAreStrandsOfTheirOwn) {
    auto strands = read_obj(FIVE + "v 5 0 0\nv 6 0 0\nl 1 2 3\nl 1 4 5\nl 1 6 7\n");
    ASSERT_OK(strands);
    EXPECT_EQ(strands->vertex_counts, Counts({3, 3, 3}));
    for (size_t s = 0; s < 3; ++s)
        EXPECT_EQ(strands->positions[9 * s], 0) << "strand " << s << " begins elsewhere";
    strands = read_obj(FIVE + "l 1 2 5\nl 3 4 5\n");
    ASSERT_OK(strands);
    EXPECT_EQ(strands->vertex_counts, Counts({3, 3}));
    expect_bad_data(read_obj(FIVE + "l 1 2 3\nl 1 4 5\nl 1 2\n"),
                    "memory.obj: line 8: ", "vertex 1 is of three lines");
}

TEST(IoPolylines, AVertexOfThreeLinesIsRefusedByName) {
    expect_bad_data(read_obj(FIVE + "l 1 2\nl 2 3\nl 4 2\n"),
                    "memory.obj: line 8: ", "vertex 2 is of three lines; allowed are two");
    expect_bad_data(read_obj(FIVE + "l 1 2 3 1\n"),
                    "memory.obj: ", "lines of vertex 1 close a ring");
}

TEST(IoPolylines, AMarkOfUtf8IsPassedOverAndUtf16IsNamed) {
    expect_x("\xef\xbb\xbf" + FIVE + "l 1 2\n", {0, 1});
    expect_bad_data(read_obj("\xff\xfe" + FIVE), "memory.obj: ", "is UTF-16; allowed is UTF-8");
}

TEST(IoPolylines, FacesOfObjAreLeftOut) {
    auto strands = read_obj(POINTS + "f 1 2 4\nl 4 5\n");
    ASSERT_OK(strands);
    EXPECT_EQ(strands->vertex_counts, Counts{2});
}

TEST(IoPolylines, FileWithoutPolylines) {
    expect_bad_data(read_obj(POINTS + "f 1 2 4\n"), "memory.obj", "has no polylines");
}

TEST(IoPolylines, LegalTextOfManyKinds) {
    const std::string data = "vt 0 0\nvt 0 0 1\nvn 0 0 1\nvp 1\n";
    for (const char* line :
         {"l 1 2 4\n", "l 1 2 4", "l 1 2 4 \t \n", "l\t1\t2\t4\n", "\n \nl 1 2 4\n", "l -5 -4 -2\n",
          "l 1/1 2/2 4/2\n", "l 1/-2 2/-1 4/-1\n", "l 1//1 2//1 4//1\n", "l 1/1/1 2/2/-1 4/2/1\n",
          "f 1/2/1 2/2/1 3/1/1\nf 1//1 2//1 3//1\nf 1 2 3\np 1 2\nl 1 2 4\n",
          "# C:\\hair \xc3\xa4\no h\xc3\xa4r\ng a b\nusemtl m\xc3\xbc\nl 1 2 4\n",
          "mtllib none.mtl\ns off\nmg 1 2\nbevel on\nl 1 2 4\n  # end"})
        expect_x(FIVE + data + line, {0, 1, 3});
}

TEST(IoPolylines, LineEndsOfOtherSystems) {
    for (const char* end : {"\r\n", "\r"}) {
        const std::string n = end;
        expect_x("# one" + n + "v 1 0 0" + n + "v 2 0 0" + n + "l 1 2" + n, {1, 2});
    }
}

TEST(IoPolylines, NumbersOfManyForms) {
    expect_x("v 1. 0 0\nv -2.5e-1 0 0\nv +3E+2 0 0\nv 6 0 0 2\nv 7 0 0 1 0 0\nl 1 2 3 4 5\n",
             {1, -0.25f, 300, 3, 7});
}

TEST(IoPolylines, IndicesAheadOfTheirVertices) {
    expect_x("l 1 2\n" + FIVE, {0, 1});
}

TEST(IoPolylines, LastLineOfALargeFileWithoutALineEnd) {
    std::string text = FIVE;
    text.resize((size_t{16} << 20) - 4, '\n'); // assimp reads 16 MiB at a time
    auto strands = read_obj(text + "l 1 2\nl 4 5");
    ASSERT_OK(strands);
    EXPECT_EQ(strands->vertex_counts, (Counts{2, 2}));
}

// assimp refuses the groom when it sees these materials.
TEST(IoPolylines, OtherFilesAreNotOpened) {
    TemporaryDirectory directory;
    const std::string materials = directory.file("a.mtl");
    put_file(materials, "newmtl a\nNs none\n");
    put_file(directory.file("a.obj"), "mtllib " + materials + "\nusemtl a\n" + FIVE + "l 1 2\n");
    auto strands = read_strands(directory.file("a.obj"));
    ASSERT_OK(strands);
    EXPECT_EQ(strands->vertex_counts, Counts{2});
}

void expect_refusal(const std::string& line, const std::string& text) {
    expect_bad_data(read_obj(FIVE + line + "\nl 1 2\n"), "memory.obj: line 6: ", text);
}

TEST(IoPolylines, RefusedBytes) {
    expect_refusal(std::string("l 1 2\0", 6), "byte 0x00; allowed are text and tabs");
    expect_refusal("# \x1b[1m", "byte 0x1b");
    expect_refusal("l 1 \v 2", "byte 0x0b");
    expect_refusal("l 1 2 \\", "goes on after \\; allowed are whole lines");
    expect_refusal("# C:\\", "goes on after \\");
    expect_refusal("# C:\\\r", "goes on after \\");
    expect_refusal(" l 1 2", "blanks before \"l\"; allowed are none");
}

TEST(IoPolylines, RefusedKeywords) {
    for (const char* word : {"lod", "l1", "v1", "parm", "curv", "call", "L", "\xef\xbb\xbfv", "1"})
        expect_refusal(format("%s 1", word),
                       format("unknown keyword \"%s\"; known are v, vt, vn, p, l", word));
    const std::string x(32, 'x');
    expect_refusal(x + x, format("\"%s\"", x.c_str()));
}

TEST(IoPolylines, RefusedNumbers) {
    for (const char* number : {"nan", "inf", "-inf", "1e39", "-1e400", ".5", "1,5", "1x", "+", "-",
                               "+-1", "0x1", "#", "\xc3\xa4"})
        expect_refusal(format("v 1 2 %s", number),
                       format("vertex has \"%s\"; allowed are finite numbers", number));
    for (const int count : {0, 1, 2, 5, 7, 35}) { // 35: more than the bits of a word
        std::string line = "v";
        for (int i = 0; i < count; ++i)
            line += " 1";
        expect_refusal(line, "numbers; allowed 3, 4 or 6");
    }
    expect_refusal("vt 1", "texture vertex of 1 numbers; allowed 2 or 3");
    expect_refusal("vt nan 1", "texture vertex has \"nan\"");
    expect_refusal("vn 1 2", "vertex normal of 2 numbers; allowed 3");
}

TEST(IoPolylines, RefusedIndices) {
    for (const char* index :
         {"0", "-0", "01", "-01", "+1", "1.5", "1x", "x", "99999999999999999999"})
        expect_refusal(format("l 1 %s", index),
                       format("vertex index is \"%s\"; allowed are whole numbers", index));
    expect_refusal("l 1 25", "vertex index is 25; allowed 1 to 5");
    expect_refusal("l 1 2147483648", "vertex index is 2147483648; allowed 1 to 5");
    expect_refusal("l -6 -1", "vertex index is -6; allowed -5 to -1");
    expect_refusal("f 1 2 6", "vertex index is 6; allowed 1 to 5");
    expect_refusal("p 6", "vertex index is 6; allowed 1 to 5");
    expect_refusal("l 1/1 2/1", "texture vertex index is 1; there are none");
    expect_refusal("l 1//1 2//1", "vertex normal index is 1; there are none");
    expect_refusal("l 1/-1 2/-1", "texture vertex index is -1; there are none");
}

TEST(IoPolylines, RefusedReferences) {
    const std::string data = "vt 0 0\nvn 0 0 1\n";
    for (const char* word : {"1/", "1//", "1/1/", "/1", "/"})
        expect_bad_data(read_obj(FIVE + data + "l 1 " + word),
                        "memory.obj: line 8: ", "index is \"\"; allowed are whole numbers");
    expect_bad_data(read_obj(FIVE + data + "l 1 1/1/1/1"),
                    "memory.obj: line 8: ", "\"1/1/1/1\" has more than three parts");
    expect_bad_data(read_obj(FIVE + data + "l 1/2 2"),
                    "memory.obj: line 8: ", "texture vertex index is 2; allowed 1 to 1");
    expect_bad_data(read_obj(FIVE + data + "l 1//-2 2"),
                    "memory.obj: line 8: ", "vertex normal index is -2; allowed -1 to -1");
}

// Two lines of one vertex make assimp write beyond its arrays.
TEST(IoPolylines, ElementsOfTooFewVertices) {
    expect_refusal("l 1\nl 1", "l of 1 vertices; allowed 2 or more");
    expect_refusal("l", "l of 0 vertices; allowed 2 or more");
    expect_refusal("f 1 2", "f of 2 vertices; allowed 3 or more");
    expect_refusal("p", "p of 0 vertices; allowed 1 or more");
}

TEST(IoPolylines, LinesAreCountedAtEveryKindOfEnd) {
    expect_bad_data(read_obj("v 0 0 0\r\n\r\n\nv 1 0 0\r\rl 0 1"), "memory.obj: line 6: ", "index");
}

} // namespace
} // namespace plait
