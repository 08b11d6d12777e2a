// Colliders that are meshes, from files: what a scene says of them, and what is loaded.
#pragma once

#include "common.hpp"
#include "head_mesh.hpp"

#include <plait/plait.h>

#include <string>
#include <vector>

namespace simulate {

struct MeshChoice {
    std::string place; // "scene.json:12: meshes[0]"
    std::string file;
    float scale = 1.0f; // file units to metres
    plait_collider_mesh_desc desc = plait_collider_mesh_desc_defaults();
    bool hull = false;       // it is convex, and its faces are the collider
    float tolerance = 1e-4f; // of a hull, as in plait_collider_hull_desc
    bool drawn = true;
    bool moves_with_head = true;
};

// What a mesh and a body have in common. Files are relative to `folder`.
void read_mesh(JsonReader& in, const std::string& folder, MeshChoice& mesh);
std::vector<MeshChoice> read_meshes(JsonReader& top, const std::string& folder);

struct LoadedMesh {
    MeshHandle mesh;
    MeshChoice choice;
    HeadMesh shape;
    float head_share; // of the head's turn and way that it makes
};

// Throws Failure that says where the scene names the file. `generated`: the hair is the
// mannequin's, and skin where that has a scalp is drawn as such.
LoadedMesh load_mesh(const MeshChoice& choice, bool generated);
std::vector<LoadedMesh> load_meshes(const std::vector<MeshChoice>& choices, bool generated);

// The mannequin's head, the middle of its neck, and its shoulders, which are not drawn: what is drawn
// is one skin, whose neck twists.
std::vector<LoadedMesh> mannequin_parts();

} // namespace simulate
