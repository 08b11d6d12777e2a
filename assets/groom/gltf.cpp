#include "gltf.hpp"
#include "whole_file.hpp"

#include <algorithm>
#include <cstdio>

namespace plait_groom_tool {
namespace {

using plait_generator::Character;
using plait_generator::Joint;

std::string base64(const std::string& bytes) {
    constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t word = 0;
        for (size_t k = 0; k < 3; ++k)
            word = word << 8 | (i + k < bytes.size() ? static_cast<uint8_t>(bytes[i + k]) : 0u);
        for (size_t k = 0; k < 4; ++k)
            text += i + k <= bytes.size() ? digits[word >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

std::string number(float value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", double{value});
    return text;
}

// One more of a list.
void append(std::string& list, const std::string& item) {
    if (!list.empty())
        list += ',';
    list += item;
}

// [1,2,3]
std::string list(const float* first, size_t count) {
    std::string items;
    for (size_t i = 0; i < count; ++i)
        append(items, number(first[i]));
    std::string text = "[";
    text += items;
    return text + "]";
}

// The one buffer, its views and the accessors to them, each of all of its view.
class Buffer {
  public:
    // Little-endian, as plait's formats are. `target`: 0 or what GL binds it to.
    template <typename T>
    size_t add(const std::vector<T>& values, size_t width, const char* type, int component,
               int target = 0, const std::string& range = "") {
        const std::string comma = count_ > 0 ? ",\n    " : "";
        views_ += comma + "{\"buffer\":0,\"byteOffset\":" + std::to_string(bytes_.size()) +
                  ",\"byteLength\":" + std::to_string(values.size() * sizeof(T)) +
                  (target ? ",\"target\":" + std::to_string(target) : "") + "}";
        accessors_ += comma + "{\"bufferView\":" + std::to_string(count_) +
                      ",\"componentType\":" + std::to_string(component) +
                      ",\"count\":" + std::to_string(values.size() / width) + ",\"type\":\"" +
                      type + "\"" + range + "}";
        bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
        bytes_.resize((bytes_.size() + 3) / 4 * 4, 0);
        return count_++;
    }

    std::string text() const {
        return "  \"accessors\": [\n    " + accessors_ + "\n  ],\n  \"bufferViews\": [\n    " +
               views_ + "\n  ],\n  \"buffers\": [{\"byteLength\":" + std::to_string(bytes_.size()) +
               ",\"uri\":\"data:application/octet-stream;base64," + base64(bytes_) + "\"}]\n";
    }

  private:
    std::string bytes_, views_, accessors_;
    size_t count_ = 0;
};

constexpr int ubyte = 5121, ushort = 5123, real = 5126; // component types
constexpr int vertices = 34962, indices = 34963;        // targets

std::string range_of(const std::vector<float>& values, size_t width) {
    std::vector<float> least(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(width)),
        most = least;
    for (size_t i = 0; i < values.size(); ++i) {
        least[i % width] = std::min(least[i % width], values[i]);
        most[i % width] = std::max(most[i % width], values[i]);
    }
    return ",\"min\":" + list(least.data(), width) + ",\"max\":" + list(most.data(), width);
}

// Columns of the translation from a joint to the origin.
std::vector<float> inverse_binds(const std::vector<Joint>& joints) {
    std::vector<float> all;
    for (const Joint& joint : joints)
        for (const float value : {1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 1.0f,
                                  0.0f, -joint.at[0], -joint.at[1], -joint.at[2], 1.0f})
            all.push_back(value);
    return all;
}

// Node 0 has the mesh; joint j is node j + 1.
std::string nodes_of(const std::vector<Joint>& joints) {
    std::string text = "    {\"name\":\"body\",\"mesh\":0,\"skin\":0}";
    for (size_t j = 0; j < joints.size(); ++j) {
        float local[3];
        std::string children;
        for (size_t axis = 0; axis < 3; ++axis)
            local[axis] =
                joints[j].at[axis] - (joints[j].parent < 0
                                          ? 0.0f
                                          : joints[static_cast<size_t>(joints[j].parent)].at[axis]);
        for (size_t other = 0; other < joints.size(); ++other)
            if (joints[other].parent == static_cast<int>(j))
                append(children, std::to_string(other + 1));
        text += std::string(",\n    {\"name\":\"") + joints[j].name +
                "\",\"translation\":" + list(local, 3) +
                (children.empty() ? "" : ",\"children\":[" + children + "]") + "}";
    }
    return text;
}

std::string animation_of(const Character& character, Buffer& buffer) {
    std::string samplers, channels;
    size_t count = 0;
    const size_t time =
        buffer.add(character.time, 1, "SCALAR", real, 0, range_of(character.time, 1));
    const auto add = [&](size_t joint, const char* path, size_t output) {
        const std::string comma = count > 0 ? ",\n      " : "";
        samplers += comma + "{\"input\":" + std::to_string(time) +
                    ",\"output\":" + std::to_string(output) + "}";
        channels += comma + "{\"sampler\":" + std::to_string(count++) +
                    ",\"target\":{\"node\":" + std::to_string(joint + 1) + ",\"path\":\"" + path +
                    "\"}}";
    };
    add(0, "translation", buffer.add(character.chest_at, 3, "VEC3", real));
    const size_t size = 4 * character.time.size();
    for (size_t joint = 0; joint < character.joints.size(); ++joint) {
        const auto first = character.turns.begin() + static_cast<std::ptrdiff_t>(joint * size);
        const std::vector<float> turns(first, first + static_cast<std::ptrdiff_t>(size));
        add(joint, "rotation", buffer.add(turns, 4, "VEC4", real));
    }
    return "  \"animations\": [{\n    \"name\":\"walk\",\n    \"samplers\":[\n      " + samplers +
           "],\n    \"channels\":[\n      " + channels + "]\n  }],\n";
}

std::string gltf_text(const Character& character) {
    const auto& mesh = character.mesh;
    Buffer buffer;
    const auto text = [](size_t n) { return std::to_string(n); };
    const std::vector<uint16_t> corners(mesh.triangles.begin(), mesh.triangles.end());
    const size_t position =
        buffer.add(mesh.positions, 3, "VEC3", real, vertices, range_of(mesh.positions, 3));
    const size_t normal = buffer.add(mesh.normals, 3, "VEC3", real, vertices);
    const size_t bones = buffer.add(character.bones, 4, "VEC4", ubyte, vertices);
    const size_t weights = buffer.add(character.weights, 4, "VEC4", real, vertices);
    const size_t corner = buffer.add(corners, 1, "SCALAR", ushort, indices);
    const size_t binds = buffer.add(inverse_binds(character.joints), 16, "MAT4", real);
    const std::string animation = animation_of(character, buffer); // before the buffer is written
    std::string joints;
    for (size_t j = 0; j < character.joints.size(); ++j)
        append(joints, text(j + 1));
    return "{\n  \"asset\": {\"version\":\"2.0\",\"generator\":\"plait-groom character: metres, y "
           "up, "
           "facing +z\"},\n  \"scene\": 0,\n  \"scenes\": [{\"nodes\":[0,1]}],\n  \"nodes\": [\n" +
           nodes_of(character.joints) +
           "\n  ],\n  \"meshes\": [{\"primitives\":[{\"attributes\":{\"POSITION\":" +
           text(position) + ",\"NORMAL\":" + text(normal) + ",\"JOINTS_0\":" + text(bones) +
           ",\"WEIGHTS_0\":" + text(weights) + "},\"indices\":" + text(corner) +
           "}]}],\n  \"skins\": [{\"skeleton\":1,\"joints\":[" + joints +
           "],\"inverseBindMatrices\":" + text(binds) + "}],\n" + animation + buffer.text() + "}\n";
}

} // namespace

std::string write_gltf(const Character& character, const std::string& path) {
    return write_whole(gltf_text(character), path);
}

} // namespace plait_groom_tool
