// A body that bends: a collider whose bones move by the animation of its glTF file, and carry the hair.
#pragma once

#include "animation.hpp"
#include "meshes.hpp"

#include <string>
#include <vector>

namespace simulate {

// What carries roots: one bone all of them, or each the triangle of the body that it is nearest to.
enum class Carrier { Bone, Skin };

struct BodyChoice {
    MeshChoice mesh;
    AnimationChoice animation = 0u;
    std::string bone = "head"; // which the hair goes with, and what else moves with the head
    Carrier roots = Carrier::Bone;
    std::string animation_place, bone_place; // "scene.json:3: body.bone"
};

// The object `value` of the key `body`. Files are relative to `folder`.
BodyChoice read_body(const JsonReader& top, const Json& value, const std::string& folder);

class Body {
  public:
    // Throws Failure that says where the scene has what is wrong. `generated`: as in load_meshes().
    Body(const BodyChoice& choice, bool generated);

    const LoadedMesh& mesh() const { return mesh_; }
    Carrier roots() const { return roots_; }
    // "walk of character.gltf"
    const std::string& motion() const { return motion_; }
    // Where the vertices are, m, and where the hair's bone has been taken from rest.
    std::vector<std::array<float, 3>> positions(float time) const;
    plait_pose head(float time) const;

  private:
    Eigen::Affine3f skinning(size_t bone, float time) const;

    struct Bone {
        size_t node;
        Eigen::Affine3f inverse_bind; // m
    };
    LoadedMesh mesh_;
    Carrier roots_;
    Animation animation_;
    std::vector<Bone> bones_;
    size_t head_ = 0;
    std::string motion_;
};

} // namespace simulate
