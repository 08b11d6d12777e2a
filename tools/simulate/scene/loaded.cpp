#include "loaded.hpp"

#include <cstdio>

namespace simulate {

namespace {

std::string number(float value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", static_cast<double>(value));
    return text;
}

std::string meshes_of(const Scene& scene, const Figure& figure) {
    size_t triangles = 0;
    for (const LoadedMesh& mesh : figure.meshes)
        triangles += mesh.shape.triangles.size();
    size_t count = figure.meshes.size();
    if (figure.body) {
        triangles += figure.body->mesh().shape.triangles.size();
        ++count;
    }
    return std::to_string(count) + (count == 1 ? " mesh of " : " meshes of ") +
           std::to_string(triangles) + " triangles" +
           (scene.mannequin_is_meshes() ? ", the mannequin's" : "");
}

std::string colliders_of(const Scene& scene, const Figure& figure) {
    if (figure.colliders.empty())
        return figure.meshes.empty() && !figure.body ? "no colliders" : "";
    if (!figure.stand_ins.empty())
        return std::to_string(figure.colliders.size()) + " colliders that move";
    if (scene.groom.on_ball() && !scene.colliders)
        return "a ball of " + number(figure.colliders[0].shape.capsule.radius_a) + " m";
    if (scene.colliders || scene.groom.generated)
        return std::to_string(figure.colliders.size()) + " colliders of the " +
               (scene.colliders ? "scene" : "mannequin");
    const plait_collider_desc& skull = figure.colliders[0].shape;
    std::string text = "collider: a sphere of " + number(skull.capsule.radius_a) +
                       " m fitted under the roots, about (" + number(skull.capsule.a[0]) + ", " +
                       number(skull.capsule.a[1]) + ", " + number(skull.capsule.a[2]) + ")";
    if (figure.colliders.size() > 1)
        text += ", and " + std::to_string(figure.colliders.size() - 1) + " that move";
    return text;
}

std::string size_of(const Eigen::AlignedBox3f& box) {
    const Eigen::Vector3f size = box.sizes();
    return number(size.x()) + " x " + number(size.y()) + " x " + number(size.z()) + " m";
}

// Hair cannot reach it: most often a mesh in another unit than the groom.
void warn_of_far(const LoadedMesh& mesh, const Figure& figure, std::vector<std::string>& warnings) {
    Eigen::AlignedBox3f box;
    for (const Eigen::Vector3f& vertex : mesh.shape.vertices)
        box.extend(vertex);
    const float away = box.exteriorDistance(figure.hair_bounds);
    if (away > figure.info.mean_length)
        warnings.push_back(mesh.choice.place + ": " + mesh.choice.file + " is " + size_of(box) +
                           " large and " + number(away) + " m away from the hair, which is " +
                           number(figure.info.mean_length) + " m long on average: is its scale, " +
                           number(mesh.choice.scale) + ", right?");
}

} // namespace

std::string loaded_line(const Scene& scene, const Figure& figure) {
    const plait_groom_info& info = figure.info;
    std::string vertices = std::to_string(info.max_vertices);
    if (info.min_vertices != info.max_vertices)
        vertices = std::to_string(info.min_vertices) + " to " + vertices;
    std::string text = scene.groom.name + ": " + std::to_string(info.strands) + " strands of " +
                       vertices + " vertices, " + std::to_string(info.vertices) + " in all; " +
                       size_of(figure.hair_bounds) + ", " + number(info.mean_length) +
                       " m long on average";
    if (figure.guides)
        text += ", of which " + std::to_string(figure.simulated_strands()) +
                " are simulated and the others follow";
    if (scene.groom.scale != 1.0f)
        text += ", at a scale of " + number(scene.groom.scale);
    const std::string colliders = colliders_of(scene, figure);
    if (!colliders.empty())
        text += "; " + colliders;
    return figure.meshes.empty() && !figure.body ? text : text + "; " + meshes_of(scene, figure);
}

std::vector<std::string> size_warnings(const Scene& scene, const Figure& figure) {
    std::vector<std::string> warnings;
    if (const float times = figure.info.likely_scale; times != 1 && !scene.groom.generated)
        warnings.push_back(scene.groom.name + ": strands are " + number(figure.info.mean_length) +
                           " m long on average; --scale " + number(scene.groom.scale * times) +
                           " (or --scale auto) makes that " +
                           number(figure.info.mean_length * times) + " m");
    for (const LoadedMesh& mesh : figure.meshes)
        warn_of_far(mesh, figure, warnings);
    if (figure.body)
        warn_of_far(figure.body->mesh(), figure, warnings);
    return warnings;
}

} // namespace simulate
