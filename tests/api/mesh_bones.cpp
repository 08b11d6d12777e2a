// Bones of meshes: what comes in with arrays and files, and where they put the vertices.
#include "mesh_shapes.hpp"
#include "support.hpp"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numbers>

namespace {

using Bone = std::array<float, 12>; // 3x4 row-major

constexpr Bone identity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

plait_view view_of(const std::vector<Bone>& bones) {
    return {bones.data(), bones.size(), 0};
}

// By `angle` about an axis along z through (x, y).
Bone turn(double angle, double x = 0, double y = 0) {
    const double c = std::cos(angle), s = std::sin(angle);
    Bone bone = identity;
    bone[0] = bone[5] = static_cast<float>(c);
    bone[1] = static_cast<float>(-s);
    bone[4] = static_cast<float>(s);
    bone[3] = static_cast<float>(x - c * x + s * y);
    bone[7] = static_cast<float>(y - s * x - c * y);
    return bone;
}

struct Skin {
    std::vector<std::array<uint32_t, 4>> bones;
    std::vector<std::array<float, 4>> weights;

    void add(uint32_t a, double share, uint32_t b = 0) {
        bones.push_back({a, b, 0, 0});
        weights.push_back({static_cast<float>(share), static_cast<float>(1 - share), 0, 0});
    }
};

plait_mesh_desc desc_of(const ShapeMesh& shape, const Skin& skin) {
    auto desc = plait_mesh_desc_defaults();
    desc.positions = {shape.positions.data(), shape.positions.size(), 0};
    desc.triangles = {shape.triangles.data(), shape.triangles.size(), 0};
    desc.bone_indices = {skin.bones.data(), skin.bones.size(), 0};
    desc.bone_weights = {skin.weights.data(), skin.weights.size(), 0};
    return desc;
}

// A tube along x from -1 to 1 m, of bone 1 by (1 + x)/2 and of bone 0 by the rest.
ShapeMesh tube() {
    ShapeMesh mesh = revolved_mesh(8, 16, false, [](double u, double v) {
        return std::array<double, 3>{2 * v - 1, 0.1 * std::cos(full_turn * u),
                                     0.1 * std::sin(full_turn * u)};
    });
    mesh.turn_over();
    return mesh;
}

Skin skin_along(const ShapeMesh& mesh) {
    Skin skin;
    for (const auto& p : mesh.positions)
        skin.add(1, (1 + double(p[0])) / 2, 0);
    return skin;
}

Skin rigid(const ShapeMesh& mesh, uint32_t bone = 0) {
    Skin skin;
    for (size_t i = 0; i < mesh.positions.size(); ++i)
        skin.add(bone, 1);
    return skin;
}

TEST(MeshBones, ComeWithArrays) {
    const ShapeMesh shape = tube();
    Skin skin = skin_along(shape);
    skin.bones[3][2] = 6; // of weight 0
    const plait::Mesh mesh(desc_of(shape, skin));
    EXPECT_EQ(mesh.describe().bones, 7u);
    EXPECT_EQ(mesh.describe().repairs_total, 0u) << mesh.describe().first_repair;
    const auto bones = mesh.read<uint32_t>(PLAIT_MESH_FIELD_BONE_INDICES);
    const auto weights = mesh.read<float>(PLAIT_MESH_FIELD_BONE_WEIGHTS);
    ASSERT_EQ(bones.size(), 4 * shape.positions.size());
    EXPECT_EQ(std::memcmp(bones.data(), skin.bones.data(), bones.size() * 4), 0);
    ASSERT_EQ(weights.size(), bones.size());
    for (size_t i = 0; i < weights.size(); ++i)
        EXPECT_NEAR(weights[i], skin.weights[i / 4][i % 4], 1e-6);
    const auto bone = mesh.bone(6);
    EXPECT_STREQ(bone.name, "");
    EXPECT_TRUE(std::ranges::equal(bone.inverse_bind, identity));
    EXPECT_THROW((void)mesh.bone(7), plait::Error);
    EXPECT_STREQ(plait_last_error(), "plait_mesh_read_bone: index is 7, the mesh has 7 bones");
}

TEST(MeshBones, AMeshMayHaveNone) {
    const plait::Mesh mesh(desc_of(box_mesh(1, 1, 1), {}));
    EXPECT_EQ(mesh.describe().bones, 0u);
    EXPECT_TRUE(mesh.read<float>(PLAIT_MESH_FIELD_BONE_WEIGHTS).empty());
    EXPECT_TRUE(mesh.read<uint32_t>(PLAIT_MESH_FIELD_BONE_INDICES).empty());
    const std::vector<Bone> bones{identity};
    const plait_view view = view_of(bones);
    std::vector<float> positions(24, 7);
    EXPECT_EQ(plait_mesh_pose(mesh, &view, positions.data()), PLAIT_INVALID_STATE);
    EXPECT_STREQ(plait_last_error(), "plait_mesh_pose: the mesh has no skin");
}

TEST(MeshBones, BadSkinsAreRefused) {
    const ShapeMesh shape = box_mesh(1, 1, 1);
    const auto refused = [&](const plait_mesh_desc& desc, plait_result code, const char* text) {
        plait_mesh* mesh = nullptr;
        EXPECT_EQ(plait_mesh_create(&desc, nullptr, &mesh), code) << text;
        EXPECT_NE(std::string(plait_last_error()).find(text), std::string::npos)
            << plait_last_error();
        EXPECT_EQ(mesh, nullptr);
    };
    const auto bad = [&](const char* text, const auto& change) {
        Skin skin = rigid(shape);
        change(skin);
        refused(desc_of(shape, skin), PLAIT_BAD_DATA, text);
    };
    bad("vertex 5: bone weight is -0.5, range is [0, 1]", [](Skin& skin) {
        skin.weights[5] = {1.5f, -0.5f, 0, 0}, skin.weights[5][0] = 1;
    });
    bad("vertex 5: bone weight is nan, range is [0, 1]",
        [](Skin& skin) { skin.weights[5][3] = NAN; });
    bad("vertex 2: sum of bone weights is 0.75, range is 1 +- 0.001", [](Skin& skin) {
        skin.weights[2] = {0.5f, 0.25f, 0, 0};
    });
    bad("vertex 7: bone index is 65536, range is [0, 65535]",
        [](Skin& skin) { skin.bones[7][1] = 65536; });
    Skin skin = rigid(shape);
    skin.bones.pop_back();
    skin.weights.pop_back();
    refused(desc_of(shape, skin), PLAIT_INVALID_ARGUMENT,
            "desc->bone_indices.count is 7, allowed is 0 or the 8 vertices");
    auto desc = desc_of(shape, rigid(shape));
    desc.bone_weights.count = 0;
    refused(desc, PLAIT_INVALID_ARGUMENT, "give both or neither");
}

TEST(MeshBones, VerticesOfNoTriangleAreNotRead) {
    ShapeMesh shape = box_mesh(1, 1, 1);
    Skin skin = rigid(shape);
    shape.add(5, 5, 5);
    skin.bones.push_back({70000, 0, 0, 0});
    skin.weights.push_back({NAN, 0, 0, 0});
    EXPECT_EQ(plait::Mesh(desc_of(shape, skin)).describe().bones, 1u);
}

// A seam has its vertices twice, with one skin. Lips that touch have two.
TEST(MeshBones, VerticesThatMoveApartAreNotWelded) {
    ShapeMesh shape = box_mesh(1, 1, 1);
    Skin skin = rigid(shape);
    const ShapeMesh once = shape;
    const auto twice = [&](uint32_t vertex, uint32_t bone, double share) {
        const uint32_t copy = shape.add(once.positions[vertex][0], once.positions[vertex][1],
                                        once.positions[vertex][2]);
        skin.add(0, share, bone);
        for (auto& corner : shape.triangles.back())
            corner = corner == vertex ? copy : corner;
    };
    const uint32_t last = shape.triangles.back()[2];
    twice(last, 3, 0.996);
    const auto welded = plait::Mesh(desc_of(shape, skin)).describe();
    EXPECT_EQ(welded.vertices, 8u);
    EXPECT_EQ(welded.repairs[PLAIT_MESH_REPAIR_WELDED_VERTEX], 1u);
    EXPECT_EQ(welded.open_edges, 0u);
    skin.weights.back() = {0.99f, 0.01f, 0, 0};
    const plait::Mesh mesh(desc_of(shape, skin));
    const auto apart = mesh.describe();
    EXPECT_EQ(apart.vertices, 9u);
    EXPECT_EQ(apart.repairs_total, 0u) << apart.first_repair;
    EXPECT_GT(apart.open_edges, 0u);
    EXPECT_EQ(mesh.read<uint32_t>(PLAIT_MESH_FIELD_SOURCES).back(), 8u);
    skin.bones.back() = {3, 0, 0, 0}; // the same shares in another order
    skin.weights.back() = {0.004f, 0.996f, 0, 0};
    EXPECT_EQ(plait::Mesh(desc_of(shape, skin)).describe().vertices, 8u);
}

// A blend of turns by 0 and by a about one axis turns by a/2 and shortens by cos(a/2) at half weight:
// p (1 - w + w e^ia), as complex numbers.
TEST(MeshBones, BlendLinearly) {
    const ShapeMesh shape = tube();
    const plait::Mesh mesh(desc_of(shape, skin_along(shape)));
    const double angle = 1.2;
    const std::vector<Bone> bones{identity, turn(angle)};
    const auto posed = mesh.pose(view_of(bones));
    ASSERT_EQ(posed.size(), 3 * shape.positions.size());
    for (size_t i = 0; i < shape.positions.size(); ++i) {
        const auto& p = shape.positions[i];
        const double w = (1 + double(p[0])) / 2;
        const double length =
            std::sqrt((1 - w) * (1 - w) + w * w + 2 * w * (1 - w) * std::cos(angle));
        const double by = std::atan2(w * std::sin(angle), 1 - w + w * std::cos(angle));
        const double from = std::atan2(double(p[1]), double(p[0]));
        const double r = length * std::hypot(double(p[0]), double(p[1]));
        EXPECT_NEAR(posed[3 * i], r * std::cos(from + by), 1e-6) << i;
        EXPECT_NEAR(posed[3 * i + 1], r * std::sin(from + by), 1e-6) << i;
        EXPECT_FLOAT_EQ(posed[3 * i + 2], p[2]);
    }
}

TEST(MeshBones, TheIdentityIsRestToTheBit) {
    const ShapeMesh shape = torus_mesh(0.1, 0.03, 12, 24);
    Skin skin;
    for (size_t i = 0; i < shape.positions.size(); ++i) {
        skin.bones.push_back({0, 1, 2, 3});
        const float a = static_cast<float>(1 + i % 7), b = static_cast<float>(1 + i % 3);
        const float sum = a + b + 1 + 1;
        skin.weights.push_back({a / sum, b / sum, 1 / sum, 1 / sum});
    }
    const plait::Mesh mesh(desc_of(shape, skin));
    EXPECT_EQ(mesh.pose(view_of(std::vector<Bone>(6, identity))),
              mesh.read<float>(PLAIT_MESH_FIELD_POSITIONS));
}

TEST(MeshBones, BadBonesAreRefused) {
    const ShapeMesh shape = tube();
    const plait::Mesh mesh(desc_of(shape, skin_along(shape)));
    std::vector<float> positions(3 * shape.positions.size(), 7);
    const auto refused = [&](std::vector<Bone> bones, const char* text) {
        const plait_view view = view_of(bones);
        EXPECT_EQ(plait_mesh_pose(mesh, &view, positions.data()), PLAIT_INVALID_ARGUMENT);
        EXPECT_NE(std::string(plait_last_error()).find(text), std::string::npos)
            << plait_last_error();
    };
    refused({identity}, "bones.count is 1, the mesh's skin needs 2");
    Bone bone = identity;
    bone[7] = INFINITY;
    refused({identity, bone}, "bones[1] has inf, allowed is finite");
    bone = identity;
    bone[10] = 0;
    refused({bone, identity}, "bones[0] is singular: its determinant is 0; allowed is above 0");
    bone[10] = -1;
    refused({identity, bone}, "bones[1] reflects: its determinant is -1; allowed is above 0");
    EXPECT_TRUE(std::ranges::all_of(positions, [](float c) { return c == 7; }));
    bone = identity;
    for (const size_t diagonal : {0u, 5u, 10u})
        bone[diagonal] = 1e-3f; // small, and sound
    (void)mesh.pose(view_of({identity, bone}));
}

// What is posed is what a collider takes, and hair is where the bones took the mesh.
TEST(MeshBones, MoveACollider) {
    ShapeMesh shape = box_mesh(0.5, 0.1, 0.5);
    const plait::Mesh mesh(desc_of(shape, rigid(shape)));
    const std::vector<float> hair{0, 0.3f, 0, 0, 0.25f, 0, 0, 0.2f, 0, 0, 0.15f, 0};
    auto groom = plait_groom_desc_defaults();
    groom.positions = {hair.data(), 4, 0};
    groom.vertices_per_strand = 4;
    const plait::Context context;
    plait::Sim sim(context, plait::Groom(groom));
    auto desc = plait_collider_mesh_desc_defaults();
    desc.form = PLAIT_MESH_FORM_NEAREST;
    const auto id = sim.create_collider(mesh, desc);
    Bone up = identity;
    for (int frame = 1; frame <= 30; ++frame) {
        up[7] = 0.1f * static_cast<float>(frame) / 30;
        const auto posed = mesh.pose(view_of({up}));
        sim.set_collider_positions(id, {posed.data(), posed.size() / 3, 0});
        sim.step(1.0 / 60);
    }
    const auto tip = sim.read<float>(PLAIT_FIELD_POSITION);
    EXPECT_GT(tip[13], 0.198f); // on the box, whose top has come to 0.2 m
}

// ---- files ----------------------------------------------------------------------------------

bool reads_gltf() {
    plait_mesh* mesh = nullptr;
    (void)plait_mesh_load("nowhere.obj", nullptr, &mesh);
    return std::string(plait_last_error()).find("assimp") == std::string::npos;
}

class MeshBonesFiles : public testing::Test {
  protected:
    MeshBonesFiles()
        : folder(std::filesystem::temp_directory_path() /
                 ("plait_" +
                  std::string(testing::UnitTest::GetInstance()->current_test_info()->name()))) {
        std::filesystem::create_directories(folder);
    }
    ~MeshBonesFiles() override { std::filesystem::remove_all(folder); }

    std::string write(const std::string& name, const std::string& bytes) const {
        const auto path = folder / name;
        std::ofstream(path, std::ios::binary) << bytes;
        return path.string();
    }
    std::filesystem::path folder;
};

template <typename T> std::string bytes_of(const std::vector<T>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

// A leg from (1, 0, 0) to (1, 2, 0) of hip and knee, below a node that makes it twice as large and lifts
// it by 1 m. Its mesh is at a node that a skin has nothing to do with. A hat has no skin.
struct Leg {
    ShapeMesh shape;
    Skin skin;

    Leg() : shape(box_mesh(0.2, 1, 0.2)) {
        for (auto& p : shape.positions) {
            p = {p[0] + 1, p[1] + 1, p[2]};
            skin.add(0, p[1] > 1 ? 0.25 : 1, 1);
        }
    }

    std::string buffer() const {
        std::vector<uint16_t> joints;
        for (const auto& bones : skin.bones)
            joints.insert(joints.end(), bones.begin(), bones.end());
        return bytes_of(shape.positions) + bytes_of(shape.triangles) + bytes_of(joints) +
               bytes_of(skin.weights) +
               bytes_of<float>({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0,  0, 1, // columns
                                1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, -1, 0, 1});
    }

    std::string gltf(const std::string& buffer_file) const {
        const size_t n = shape.positions.size(), t = shape.triangles.size();
        const size_t at[] = {
            0, 12 * n, 12 * n + 12 * t, 20 * n + 12 * t, 36 * n + 12 * t, 36 * n + 12 * t + 128};
        std::string text =
            R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[
            {"name":"armature","translation":[0,1,0],"scale":[2,2,2],"children":[1,3,4]},
            {"name":"hip","translation":[1,0,0],"children":[2]},
            {"name":"knee","translation":[0,1,0]},
            {"name":"body","translation":[9,9,9],"mesh":0,"skin":0},
            {"name":"hat","translation":[3,0,0],"mesh":1}],
            "skins":[{"joints":[1,2],"inverseBindMatrices":4}],
            "meshes":[{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":2,"WEIGHTS_0":3},
            "indices":1}]},{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
            "buffers":[{"uri":")" +
            buffer_file + R"(","byteLength":)" + std::to_string(at[5]) + R"(}],"bufferViews":[)";
        for (int i = 0; i < 5; ++i)
            text += (i ? "," : "") + std::string(R"({"buffer":0,"byteOffset":)") +
                    std::to_string(at[i]) + R"(,"byteLength":)" +
                    std::to_string(at[i + 1] - at[i]) + "}";
        const auto accessor = [&](int view, int type, size_t count, const char* shape_of) {
            text += (view ? "," : "") + std::string(R"({"bufferView":)") + std::to_string(view) +
                    R"(,"componentType":)" + std::to_string(type) + R"(,"count":)" +
                    std::to_string(count) + R"(,"type":")" + shape_of + "\"}";
        };
        text += R"(],"accessors":[)";
        accessor(0, 5126, n, "VEC3");
        accessor(1, 5125, 3 * t, "SCALAR");
        accessor(2, 5123, n, "VEC4");
        accessor(3, 5126, n, "VEC4");
        accessor(4, 5126, 2, "MAT4");
        return text + "]}";
    }
};

TEST_F(MeshBonesFiles, Gltf) {
    if (!reads_gltf())
        GTEST_SKIP() << "built without assimp";
    const Leg leg;
    write("leg.bin", leg.buffer());
    auto options = plait_import_options_defaults();
    options.scale = 0.5f;
    const auto mesh = plait::Mesh::load(write("leg.gltf", leg.gltf("leg.bin")), options);
    const auto info = mesh.describe();
    EXPECT_EQ(info.vertices, 16u);
    EXPECT_EQ(info.bones, 3u);
    EXPECT_EQ(info.repairs_total, 0u) << info.first_repair;
    EXPECT_STREQ(mesh.bone(0).name, "hip");
    EXPECT_STREQ(mesh.bone(1).name, "knee");
    EXPECT_STREQ(mesh.bone(2).name, "hat") << "a mesh without a skin goes with its node";
    // At half the size the armature makes x to x, y to y + 1/2.
    EXPECT_NEAR(info.bounds_min[1], 0.5, 1e-6);
    EXPECT_NEAR(info.bounds_min[0], 0.8, 1e-6);
    EXPECT_NEAR(info.bounds_max[0], 4.2, 1e-6) << "the hat's";
    EXPECT_NEAR(info.bounds_max[1], 2.5, 1e-6);
    // knee: at (2, 3, 0) in the file, (1, 1.5, 0) m, its axes twice as long.
    const auto bone = mesh.bone(1);
    const float* const knee = bone.inverse_bind;
    EXPECT_NEAR(knee[0], 0.5, 1e-6);
    EXPECT_NEAR(knee[3], -0.5, 1e-6);
    EXPECT_NEAR(knee[7], -0.75, 1e-6);
    // Turned at the knee by a right angle: its pose times inverse_bind.
    const std::vector<Bone> bones{identity, turn(std::numbers::pi / 2, 1, 1.5), identity};
    const auto posed = mesh.pose(view_of(bones));
    const auto rest = mesh.read<float>(PLAIT_MESH_FIELD_POSITIONS);
    for (size_t i = 0; i < 16; ++i) {
        const float x = rest[3 * i], y = rest[3 * i + 1];
        const bool turns = y > 1.5f && x < 2;
        EXPECT_NEAR(posed[3 * i], turns ? 0.25f * x + 0.75f * (1 - (y - 1.5f)) : x, 1e-5);
        EXPECT_NEAR(posed[3 * i + 1], turns ? 0.25f * y + 0.75f * (1.5f + x - 1) : y, 1e-5);
    }
}

TEST_F(MeshBonesFiles, GltfOfVerticesWithoutBones) {
    if (!reads_gltf())
        GTEST_SKIP() << "built without assimp";
    Leg leg;
    leg.skin.weights[3] = {};
    write("leg.bin", leg.buffer());
    const std::string file = write("leg.gltf", leg.gltf("leg.bin"));
    const auto info = plait::Mesh::load(file).describe();
    EXPECT_EQ(info.repairs[PLAIT_MESH_REPAIR_REDUCED_SKIN], 1u);
    // Of vertices as assimp numbers them: 3 by version 5.2, 2 by version 5.4.
    const std::string repair = info.first_repair;
    EXPECT_NE(repair.find("mesh \"meshes[0]\", vertex "), std::string::npos) << repair;
    EXPECT_NE(repair.find(": no bone, the mesh's first taken"), std::string::npos) << repair;
    auto strict = plait_import_options_defaults();
    strict.policy = PLAIT_REPAIR_POLICY_REFUSE;
    EXPECT_THROW((void)plait::Mesh::load(file, strict), plait::Error);
}

TEST_F(MeshBonesFiles, Tfxmesh) {
    auto options = plait_import_options_defaults();
    options.scale = 0.01f;
    const auto mesh = plait::Mesh::load(PLAIT_SOURCE_DIR "/tests/data/bar.tfxmesh", options);
    const auto info = mesh.describe();
    EXPECT_EQ(info.vertices, 8u);
    EXPECT_EQ(info.triangles, 12u);
    EXPECT_EQ(info.bones, 2u);
    EXPECT_EQ(info.open_edges, 0u);
    EXPECT_EQ(info.repairs_total, 1u) << "a seam's vertex";
    EXPECT_NEAR(info.volume, 0.01, 1e-8);
    EXPECT_STREQ(mesh.bone(0).name, "left end");
    EXPECT_STREQ(mesh.bone(1).name, "right_end");
    EXPECT_TRUE(std::ranges::equal(mesh.bone(1).inverse_bind, identity));
    const auto weights = mesh.read<float>(PLAIT_MESH_FIELD_BONE_WEIGHTS);
    EXPECT_EQ(weights[4 * 3], 1) << "0.8 in the file";
    EXPECT_EQ(weights[4 * 7 + 1], 0.25f);
}

TEST_F(MeshBonesFiles, BadTfxmeshIsRefused) {
    std::ifstream stream(PLAIT_SOURCE_DIR "/tests/data/bar.tfxmesh");
    const std::string good{std::istreambuf_iterator<char>(stream), {}};
    const auto refused = [&](const std::string& from, const std::string& to, const char* text) {
        std::string bytes = good;
        const size_t at = bytes.find(from);
        ASSERT_NE(at, std::string::npos) << from;
        bytes.replace(at, from.size(), to);
        plait_mesh* mesh = nullptr;
        EXPECT_EQ(plait_mesh_load(write("bad.tfxmesh", bytes).c_str(), nullptr, &mesh),
                  PLAIT_BAD_DATA);
        EXPECT_EQ(mesh, nullptr);
        EXPECT_NE(std::string(plait_last_error()).find(text), std::string::npos)
            << plait_last_error();
    };
    refused("numOfBones 2", "numBones 2",
            "bad.tfxmesh: line 2: is \"numBones\"; allowed is numOfBones");
    refused("numOfBones 2", "numOfBones -2", "line 2: numOfBones is \"-2\"; allowed 0 to 65536");
    refused("1 right_end", "2 right_end", "line 5: begins with \"2\"; allowed is its number, 1");
    refused("0 -5 -5", "0 nan -5", "line 8: number 2 of the vertex is \"nan\"");
    refused("1 0 0 0 1 0 0 0\n5", "1 0 0 0 1 0 0\n5", "line 12: number 14 of the vertex is \"\"");
    refused("0 1 0 0 0.8 0", "0 1 0 0 1.5 0", "line 11: bone weight is 1.5; allowed 0 to 1");
    refused("0 1 0 0 0.8 0", "2 1 0 0 0.8 0", "line 11: bone is 2; allowed 0 to 1");
    refused("0 1 0 0 0.8 0", "0 1 0 0 0 0", "line 11: the bone weights sum to 0");
    refused("3 4 6 8", "3 4 6 9", "line 24: corner is \"9\"; allowed 0 to 8");
    refused("11 3 4 7\n", "", "the file ends before all is said that it counts");
    refused("numOfVertices 9", "numOfVertices 4000000000",
            "line 19: begins with \"numOfTriangles\"");
}

} // namespace
