// Meshes: what comes in, what is mended, what is refused.
#include "mesh_shapes.hpp"
#include "support.hpp"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory_resource>
#include <random>

namespace {

plait_mesh_desc desc_of(const ShapeMesh& shape) {
    auto desc = plait_mesh_desc_defaults();
    desc.positions = {shape.positions.data(), shape.positions.size(), 0};
    desc.triangles = {shape.triangles.data(), shape.triangles.size(), 0};
    return desc;
}

plait::Mesh make_mesh(const ShapeMesh& shape) {
    return plait::Mesh(desc_of(shape));
}

// Code and sentence of a refusal; OK and "" if it is taken.
std::pair<plait_result, std::string>
refusal(const ShapeMesh& shape, plait_repair_policy policy = PLAIT_REPAIR_POLICY_REPAIR) {
    const auto desc = desc_of(shape);
    auto options = plait_import_options_defaults();
    options.policy = policy;
    plait_mesh* mesh = nullptr;
    const plait_result code = plait_mesh_create(&desc, &options, &mesh);
    if (code == PLAIT_OK) {
        plait_mesh_destroy(mesh);
        return {code, ""};
    }
    EXPECT_EQ(mesh, nullptr);
    return {code, plait_last_error()};
}

void expect_bad_data(const ShapeMesh& shape, const std::string& part,
                     plait_repair_policy policy = PLAIT_REPAIR_POLICY_REPAIR) {
    const auto [code, text] = refusal(shape, policy);
    EXPECT_EQ(code, PLAIT_BAD_DATA) << part;
    EXPECT_NE(text.find(part), std::string::npos) << text;
}

// Every corner of every triangle a vertex of its own.
ShapeMesh torn(const ShapeMesh& shape) {
    ShapeMesh all;
    for (const auto& t : shape.triangles) {
        for (const uint32_t corner : t)
            all.positions.push_back(shape.positions[corner]);
        const auto n = static_cast<uint32_t>(all.positions.size());
        all.triangles.push_back({n - 3, n - 2, n - 1});
    }
    return all;
}

std::vector<std::array<uint32_t, 3>> triangles_of(const plait::Mesh& mesh) {
    const auto flat = mesh.read<uint32_t>(PLAIT_MESH_FIELD_TRIANGLES);
    std::vector<std::array<uint32_t, 3>> list(flat.size() / 3);
    std::memcpy(list.data(), flat.data(), flat.size() * sizeof(uint32_t));
    return list;
}

TEST(Mesh, ClosedShapesAreAsTheyWereGiven) {
    const ShapeMesh box = box_mesh(0.1, 0.2, 0.3);
    const auto mesh = make_mesh(box);
    const auto info = mesh.describe();
    EXPECT_EQ(info.vertices, 8u);
    EXPECT_EQ(info.triangles, 12u);
    EXPECT_EQ(info.open_edges + info.unsided_edges + info.repairs_total, 0u) << info.first_repair;
    EXPECT_EQ(info.components, 1u);
    EXPECT_NEAR(info.volume, 8 * 0.1 * 0.2 * 0.3, 1e-8);
    EXPECT_NEAR(info.area, 8 * (0.02 + 0.03 + 0.06), 1e-7);
    EXPECT_FLOAT_EQ(info.bounds_min[2], -0.3f);
    EXPECT_FLOAT_EQ(info.bounds_max[1], 0.2f);
    EXPECT_EQ(triangles_of(mesh), box.triangles);
    const auto positions = mesh.read<float>(PLAIT_MESH_FIELD_POSITIONS);
    EXPECT_EQ(std::memcmp(positions.data(), box.positions.data(), sizeof(float) * 24), 0);
}

TEST(Mesh, VolumesOfCurvedShapes) {
    const double torus = 0.5 * full_turn * full_turn * 0.1 * 0.03 * 0.03;
    EXPECT_NEAR(make_mesh(torus_mesh(0.1, 0.03, 48, 96)).describe().volume / torus, 1, 5e-3);
    EXPECT_NEAR(make_mesh(bent_tube_mesh(0.1, 0.03, 48, 96)).describe().volume / torus, 0.5, 5e-3);
    const double ball = 2.0 / 3 * full_turn * 0.1 * 0.12 * 0.11;
    EXPECT_NEAR(make_mesh(ellipsoid_mesh(0.1, 0.12, 0.11, 64, 48)).describe().volume / ball, 1,
                5e-3);
    for (const ShapeMesh& shape : {torus_mesh(0.1, 0.03, 8, 12), bent_tube_mesh(0.1, 0.03, 8, 12),
                                   ellipsoid_mesh(0.1, 0.1, 0.1, 12, 8)}) {
        const auto info = make_mesh(shape).describe();
        EXPECT_EQ(info.open_edges + info.unsided_edges + info.repairs_total, 0u)
            << info.first_repair;
    }
}

TEST(Mesh, SeamsAreWelded) {
    const ShapeMesh shape = torus_mesh(0.1, 0.03, 12, 24);
    ShapeMesh seams = torn(shape);
    for (size_t i = 0; i < seams.positions.size(); i += 3)
        seams.positions[i][0] += 5e-8f; // within 1e-6 of .28 m
    const auto info = make_mesh(seams).describe();
    EXPECT_EQ(info.vertices, shape.positions.size());
    EXPECT_EQ(info.open_edges, 0u);
    EXPECT_EQ(info.repairs[PLAIT_MESH_REPAIR_WELDED_VERTEX],
              seams.positions.size() - shape.positions.size());
    EXPECT_EQ(info.repairs_total, info.repairs[PLAIT_MESH_REPAIR_WELDED_VERTEX]);
    for (size_t i = 0; i < seams.positions.size(); i += 3)
        seams.positions[i][0] += 2e-6f; // beyond it
    EXPECT_GT(make_mesh(seams).describe().open_edges, 0u);
    expect_bad_data(torn(shape), "vertex 3: within 1e-6 of the mesh's size",
                    PLAIT_REPAIR_POLICY_REFUSE);
}

TEST(Mesh, TrianglesThatAreNoneAreDropped) {
    ShapeMesh shape = box_mesh(1, 1, 1);
    const auto right = shape.triangles;
    shape.triangles.insert(shape.triangles.begin() + 3, {4, 4, 5}); // two corners
    shape.triangles.push_back(right[6]);                            // twice
    shape.triangles.push_back({right[7][0], right[7][2], right[7][1]});
    const uint32_t middle = shape.add(0, -1, -1); // on the edge from 0 to 1
    shape.triangles.push_back({0, middle, 1});
    const auto mesh = make_mesh(shape);
    const auto info = mesh.describe();
    EXPECT_EQ(triangles_of(mesh), right);
    EXPECT_EQ(info.vertices, 8u);
    EXPECT_EQ(info.repairs[PLAIT_MESH_REPAIR_DEGENERATE_TRIANGLE], 2u);
    EXPECT_EQ(info.repairs[PLAIT_MESH_REPAIR_DUPLICATE_TRIANGLE], 2u);
    EXPECT_EQ(info.repairs_total, 4u);
    EXPECT_STREQ(info.first_repair, "triangle 3: has no area, dropped");
    expect_bad_data(shape, "triangle 3: has no area", PLAIT_REPAIR_POLICY_REFUSE);
}

TEST(Mesh, SidesAreMadeToAgree) {
    const ShapeMesh right = ellipsoid_mesh(0.1, 0.2, 0.1, 12, 8);
    ShapeMesh shape = right;
    for (const size_t t : {3u, 17u, 50u, 51u})
        std::swap(shape.triangles[t][1], shape.triangles[t][2]);
    const auto few = make_mesh(shape);
    EXPECT_EQ(triangles_of(few), right.triangles);
    EXPECT_EQ(few.describe().repairs[PLAIT_MESH_REPAIR_FLIPPED_TRIANGLE], 4u);
    shape.turn_over();
    const auto most = make_mesh(shape);
    EXPECT_EQ(most.describe().repairs[PLAIT_MESH_REPAIR_FLIPPED_TRIANGLE],
              right.triangles.size() - 4);
    EXPECT_GT(most.describe().volume, 0);
    EXPECT_EQ(triangles_of(most), right.triangles);
}

TEST(Mesh, AHollowStaysOne) {
    ShapeMesh shape = box_mesh(1, 1, 1), hollow = box_mesh(0.5, 0.5, 0.5);
    hollow.turn_over();
    shape.add_mesh(hollow);
    const auto info = make_mesh(shape).describe();
    EXPECT_EQ(info.components, 2u);
    EXPECT_EQ(info.repairs_total, 0u);
    EXPECT_NEAR(info.volume, 7, 1e-6);
}

TEST(Mesh, OpenAndManySidedEdgesAreCounted) {
    const auto sheet = make_mesh(sheet_mesh(1)).describe();
    EXPECT_EQ(sheet.open_edges, 4u);
    EXPECT_EQ(sheet.volume, 0);
    EXPECT_NEAR(sheet.area, 4, 1e-6);
    ShapeMesh fin = box_mesh(1, 1, 1);
    fin.triangles.push_back({0, 1, fin.add(0, -2, -2)});
    const auto info = make_mesh(fin).describe();
    EXPECT_EQ(info.unsided_edges, 1u);
    EXPECT_EQ(info.open_edges, 2u);
}

// A strip that is glued with half a turn.
TEST(Mesh, WhatHasOneSideIsSaidToHave) {
    ShapeMesh strip;
    constexpr uint32_t number = 12;
    for (uint32_t i = 0; i < number; ++i) {
        const double a = full_turn * i / number;
        for (const double w : {-0.2, 0.2})
            strip.add((1 + w * std::cos(a / 2)) * std::cos(a), w * std::sin(a / 2),
                      (1 + w * std::cos(a / 2)) * std::sin(a));
    }
    for (uint32_t i = 0; i + 1 < number; ++i)
        strip.add_quad(2 * i, 2 * i + 1, 2 * i + 3, 2 * i + 2);
    strip.add_quad(2 * number - 2, 2 * number - 1, 0, 1);
    const auto info = make_mesh(strip).describe();
    EXPECT_EQ(info.unsided_edges, 1u);
    EXPECT_EQ(info.open_edges, 2 * number);
}

TEST(Mesh, BadArraysAreRefused) {
    ShapeMesh shape = box_mesh(1, 1, 1);
    shape.triangles[4][1] = 8;
    expect_bad_data(shape, "triangle 4: index is 8, there are 8 vertices");
    shape = box_mesh(1, 1, 1);
    shape.positions[5][2] = NAN;
    expect_bad_data(shape, "vertex 5: coordinate is nan, range is [-1e6, 1e6] m");
    shape.positions[5][2] = 2e6f;
    expect_bad_data(shape, "vertex 5: coordinate is 2e+06, range is [-1e6, 1e6] m");
    shape = box_mesh(1, 1, 1);
    shape.add(NAN, 0, 0); // of no triangle
    EXPECT_EQ(refusal(shape).first, PLAIT_OK);
    expect_bad_data(ShapeMesh{}, "none of 0 triangles is left");
    ShapeMesh point;
    point.triangles.push_back({point.add(1, 1, 1), point.add(1, 1, 1), point.add(1, 1, 1)});
    expect_bad_data(point, "none of 1 triangles is left");
}

TEST(Mesh, ScalesAndReadsStrides) {
    const ShapeMesh box = box_mesh(10, 20, 30);
    struct Vertex {
        std::array<float, 3> position, normal;
    };
    std::vector<Vertex> padded;
    for (const auto& p : box.positions)
        padded.push_back({p, {9, 9, 9}});
    auto desc = desc_of(box);
    desc.positions = {padded.data(), padded.size(), sizeof(Vertex)};
    auto options = plait_import_options_defaults();
    options.scale = 0.01f;
    EXPECT_NEAR(plait::Mesh(desc, options).describe().volume, 8 * 0.1 * 0.2 * 0.3, 1e-8);
}

// Whatever numbers come, they are taken or refused, and what is taken holds what is promised.
TEST(Mesh, RandomArrays) {
    std::mt19937 random(7);
    const auto below = [&](uint32_t end) { return static_cast<uint32_t>(random() % end); };
    size_t taken = 0;
    for (int run = 0; run < 3000; ++run) {
        ShapeMesh shape;
        const uint32_t vertices = 1 + below(12), coarse = 1 + below(4);
        for (uint32_t i = 0; i < vertices; ++i)
            shape.add(below(coarse + 1), below(coarse + 1), below(coarse + 1) * 1e-7);
        for (uint32_t i = below(20); i > 0; --i)
            shape.triangles.push_back({below(vertices), below(vertices), below(vertices)});
        if (below(4) == 0) // any bits at all
            for (float& c : shape.positions[below(vertices)]) {
                const auto bits = static_cast<uint32_t>(random());
                std::memcpy(&c, &bits, sizeof c);
            }
        if (below(8) == 0 && !shape.triangles.empty())
            shape.triangles[below(static_cast<uint32_t>(shape.triangles.size()))][below(3)] =
                static_cast<uint32_t>(random());
        const auto [code, text] = refusal(shape);
        EXPECT_TRUE(code == PLAIT_OK || (code == PLAIT_BAD_DATA && !text.empty())) << text;
        if (code != PLAIT_OK)
            continue;
        ++taken;
        const auto mesh = make_mesh(shape);
        const auto info = mesh.describe();
        EXPECT_TRUE(std::isfinite(info.volume) && info.area > 0);
        for (const auto& t : triangles_of(mesh))
            EXPECT_TRUE(std::ranges::max(t) < info.vertices && t[0] != t[1] && t[1] != t[2] &&
                        t[2] != t[0]);
        if (refusal(shape, PLAIT_REPAIR_POLICY_REFUSE).first == PLAIT_OK)
            EXPECT_EQ(info.repairs_total, 0u);
        else
            EXPECT_GT(info.repairs_total, 0u);
    }
    EXPECT_GT(taken, 500u);
}

// ---- files ----------------------------------------------------------------------------------

class MeshFiles : public testing::Test {
  protected:
    MeshFiles()
        : folder(std::filesystem::temp_directory_path() /
                 ("plait_" +
                  std::string(testing::UnitTest::GetInstance()->current_test_info()->name()))) {
        std::filesystem::create_directories(folder);
    }
    ~MeshFiles() override { std::filesystem::remove_all(folder); }

    std::string write(const std::string& name, const std::string& bytes) {
        const auto path = folder / name;
        std::ofstream(path, std::ios::binary) << bytes;
        return path.string();
    }
    std::filesystem::path folder;
};

bool reads_meshes() {
    plait_mesh* mesh = nullptr;
    (void)plait_mesh_load("nowhere.obj", nullptr, &mesh);
    return std::string(plait_last_error()).find("assimp") == std::string::npos;
}

std::string obj_of(const ShapeMesh& shape) {
    std::string text;
    for (const auto& p : shape.positions)
        text += "v " + std::to_string(p[0]) + " " + std::to_string(p[1]) + " " +
                std::to_string(p[2]) + "\n";
    for (const auto& t : shape.triangles)
        text += "f " + std::to_string(t[0] + 1) + " " + std::to_string(t[1] + 1) + " " +
                std::to_string(t[2] + 1) + "\n";
    return text;
}

template <typename T> void append(std::string& bytes, const T& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// The buffer of a glTF file: positions, then indices.
std::string gltf_buffer(const ShapeMesh& shape) {
    std::string bytes;
    for (const auto& p : shape.positions)
        append(bytes, p);
    for (const auto& t : shape.triangles)
        append(bytes, t);
    return bytes;
}

// A mesh of a node that is moved by (1, 2, 3), below one that makes it half as large. `uri`: of the
// buffer, with its comma, or nothing.
std::string gltf_of(const ShapeMesh& shape, const std::string& uri) {
    const size_t vertices = shape.positions.size(), indices = 3 * shape.triangles.size();
    const auto text = [](size_t n) { return std::to_string(n); };
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[)"
           R"({"scale":[0.5,0.5,0.5],"children":[1]},{"translation":[1,2,3],"mesh":0}],)"
           R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"mode":4}]}],)"
           R"("buffers":[{)" +
           uri + R"("byteLength":)" + text(12 * vertices + 4 * indices) +
           R"(}],"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":)" + text(12 * vertices) +
           R"(},{"buffer":0,"byteOffset":)" + text(12 * vertices) + R"(,"byteLength":)" +
           text(4 * indices) + R"(}],"accessors":[{"bufferView":0,"componentType":5126,"count":)" +
           text(vertices) +
           R"(,"type":"VEC3","min":[-1,-1,-1],"max":[1,1,1]},)"
           R"({"bufferView":1,"componentType":5125,"count":)" +
           text(indices) + R"(,"type":"SCALAR"}]})";
}

std::string glb_of(const ShapeMesh& shape) {
    std::string json = gltf_of(shape, ""), buffer = gltf_buffer(shape), bytes;
    json.resize((json.size() + 3) / 4 * 4, ' ');
    append(bytes, uint32_t{0x46546c67});
    append(bytes, uint32_t{2});
    append(bytes, static_cast<uint32_t>(28 + json.size() + buffer.size()));
    append(bytes, static_cast<uint32_t>(json.size()));
    append(bytes, uint32_t{0x4e4f534a});
    bytes += json;
    append(bytes, static_cast<uint32_t>(buffer.size()));
    append(bytes, uint32_t{0x004e4942});
    return bytes + buffer;
}

void expect_box_of_node(const plait::Mesh& mesh) {
    const auto info = mesh.describe();
    EXPECT_EQ(info.vertices, 8u);
    EXPECT_EQ(info.triangles, 12u);
    EXPECT_EQ(info.open_edges + info.repairs_total, 0u);
    EXPECT_NEAR(info.volume, 8 * 0.5 * 0.2 * 0.3 / 8, 1e-6);
    EXPECT_NEAR(info.bounds_min[0], 0.25, 1e-6); // (1 - .5)/2
    EXPECT_NEAR(info.bounds_max[2], 1.65, 1e-6);
}

TEST_F(MeshFiles, Obj) {
    if (!reads_meshes())
        GTEST_SKIP() << "built without assimp";
    const ShapeMesh box = box_mesh(0.5, 0.25, 0.125);
    const auto mesh = plait::Mesh::load(write("box.obj", obj_of(box) + "l 1 2 3\n"));
    const auto info = mesh.describe();
    EXPECT_EQ(info.vertices, 8u);
    EXPECT_EQ(info.triangles, 12u);
    EXPECT_EQ(info.open_edges + info.repairs_total, 0u) << info.first_repair;
    EXPECT_NEAR(info.volume, 0.125, 1e-6);
    const auto quads = plait::Mesh::load(write(
        "quads.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1 4//1\n"));
    EXPECT_EQ(quads.describe().triangles, 2u);
    auto options = plait_import_options_defaults();
    options.scale = 2;
    EXPECT_NEAR(plait::Mesh::load(write("box.obj", obj_of(box)), options).describe().volume, 1,
                1e-6);
}

TEST_F(MeshFiles, Gltf) {
    if (!reads_meshes())
        GTEST_SKIP() << "built without assimp";
    const ShapeMesh box = box_mesh(0.5, 0.2, 0.3);
    expect_box_of_node(plait::Mesh::load(write("box.glb", glb_of(box))));
    write("box.bin", gltf_buffer(box));
    expect_box_of_node(plait::Mesh::load(write("box.gltf", gltf_of(box, R"("uri":"box.bin",)"))));
}

TEST_F(MeshFiles, BadFilesAreRefused) {
    plait_mesh* mesh = nullptr;
    const auto load = [&](const std::string& path, const char* part) {
        const plait_result code = plait_mesh_load(path.c_str(), nullptr, &mesh);
        EXPECT_EQ(mesh, nullptr);
        EXPECT_NE(std::string(plait_last_error()).find(part), std::string::npos)
            << plait_last_error();
        return code;
    };
    EXPECT_EQ(load("head.stl", "known are .obj, .gltf, .glb, .tfxmesh"), PLAIT_UNSUPPORTED);
    if (!reads_meshes()) {
        EXPECT_EQ(load("head.obj", "-DPLAIT_ASSIMP=ON"), PLAIT_UNSUPPORTED);
        return;
    }
    EXPECT_EQ(load("nowhere.obj", "nowhere.obj"), PLAIT_NOT_FOUND);
    EXPECT_EQ(load("nowhere.glb", "nowhere.glb"), PLAIT_NOT_FOUND);
    EXPECT_EQ(load(write("a.obj", "v 0 0 0\nf 1 2 3\n"), "a.obj: line 2"), PLAIT_BAD_DATA);
    EXPECT_EQ(load(write("l.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n"), "l.obj: has no faces"),
              PLAIT_BAD_DATA);
    EXPECT_EQ(load(write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"),
                   "flat.obj: none of 1 triangles is left"),
              PLAIT_BAD_DATA);
    EXPECT_EQ(load(write("a.gltf", "{}"), "a.gltf"), PLAIT_BAD_DATA);
    EXPECT_EQ(load(write("a.glb", "glTF"), "a.glb"), PLAIT_BAD_DATA);
    const ShapeMesh box = box_mesh(0.5, 0.2, 0.3);
    EXPECT_EQ(load(write("cut.glb", glb_of(box).substr(0, 300)), "cut.glb"), PLAIT_BAD_DATA);
}

} // namespace
