#include "obj.hpp"
#include "whole_file.hpp"

#include <cstdio>

namespace plait_groom_tool {
namespace {

std::string obj_text(const plait_generator::HeadMesh& mesh) {
    std::string text = "# plait-groom head: metres, y up, facing +z\n";
    char line[128];
    const auto add = [&](const char* pattern, const float* v) {
        std::snprintf(line, sizeof line, pattern, double{v[0]}, double{v[1]}, double{v[2]});
        text += line;
    };
    for (size_t i = 0; i < mesh.positions.size(); i += 3)
        add("v %.4f %.4f %.4f\n", &mesh.positions[i]);
    for (size_t i = 0; i < mesh.normals.size(); i += 3)
        add("vn %.2f %.2f %.2f\n", &mesh.normals[i]);
    for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
        const uint32_t a = mesh.triangles[t] + 1, b = mesh.triangles[t + 1] + 1,
                       c = mesh.triangles[t + 2] + 1;
        std::snprintf(line, sizeof line, "f %u//%u %u//%u %u//%u\n", a, a, b, b, c, c);
        text += line;
    }
    return text;
}

} // namespace

std::string write_obj(const plait_generator::HeadMesh& mesh, const std::string& path) {
    return write_whole(obj_text(mesh), path);
}

} // namespace plait_groom_tool
