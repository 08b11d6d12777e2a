#include "io_support.hpp"

namespace plait {
namespace {

#ifdef PLAIT_WITHOUT_ASSIMP

TEST(IoPolylines, AreUnsupportedWithoutAssimp) {
    for (const char* path : {"a.obj", "a.gltf", "a.glb"}) {
        auto strands = read_strands(path);
        ASSERT_FALSE(strands.ok());
        EXPECT_EQ(strands.error().code, PLAIT_UNSUPPORTED);
        EXPECT_NE(strands.error().message.find("assimp"), std::string::npos);
    }
}

#else

Result<StrandSet> read_obj(const std::string& text, float scale = 1.0f) {
    return read_polylines(std::as_bytes(std::span(text)), "obj", {.scale = scale});
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

TEST(IoPolylines, FacesOfObjAreLeftOut) {
    auto strands = read_obj(POINTS + "f 1 2 4\nl 4 5\n");
    ASSERT_OK(strands);
    EXPECT_EQ(strands->vertex_counts, Counts{2});
}

TEST(IoPolylines, FileWithoutPolylines) {
    expect_bad_data(read_obj(POINTS + "f 1 2 4\n"), "memory.obj", "has no polylines");
}

TEST(IoPolylines, TextThatIsNoModel) {
    TemporaryDirectory directory;
    for (const char* name : {"a.gltf", "a.glb"}) {
        put_file(directory.file(name), "this is no model");
        expect_bad_data(read_strands(directory.file(name)), name, "");
    }
}

// A line strip and a pair of separate lines, the second placed 10 to the right by its node.
const char GLTF[] = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
"nodes": [{"mesh": 0}, {"mesh": 1, "translation": [10, 0, 0]}],
"meshes": [{"primitives": [{"mode": 3, "attributes": {"POSITION": 0}}]},
           {"primitives": [{"mode": 1, "attributes": {"POSITION": 1}}]}],
"accessors": [
 {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0,0,0], "max": [0,2,0]},
 {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0,0,0], "max": [0,3,0]}],
"bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36},
                {"buffer": 0, "byteOffset": 0, "byteLength": 48}],
"buffers": [{"uri": "lines.bin", "byteLength": 48}]})";

TEST(IoPolylines, LinesOfGltfWithItsBufferAndNodes) {
    TemporaryDirectory directory;
    ByteWriter buffer(std::pmr::get_default_resource());
    for (float y : {0.0f, 1.0f, 2.0f, 3.0f})
        for (float value : {0.0f, y, 0.0f})
            buffer.f32(value);
    put_file(directory.file("lines.bin"), std::move(buffer).take());
    put_file(directory.file("lines.gltf"), GLTF);
    auto strands = read_strands(directory.file("lines.gltf"));
    ASSERT_OK(strands);
    EXPECT_EQ(strands->vertex_counts, (Counts{3, 2, 2}));
    EXPECT_EQ(strands->positions,
              (Floats{0, 0, 0, 0, 1, 0, 0, 2, 0, 10, 0, 0, 10, 1, 0, 10, 2, 0, 10, 3, 0}));
}

#endif

} // namespace
} // namespace plait
