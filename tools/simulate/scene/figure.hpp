// Everything at rest: the groom, the head under it, and what the hair collides with.
#pragma once

#include "body.hpp"
#include "hand.hpp"
#include "head_mesh.hpp"
#include "meshes.hpp"
#include "scene.hpp"

#include <Eigen/Geometry>

#include <memory>
#include <utility>

namespace simulate {

struct Figure {
    GroomHandle groom;
    plait_groom_info info;
    std::string notes;  // on the groom's file, in sentences; ""
    GroomHandle guides; // where some of its strands are simulated and the others follow; else null
    FollowMapHandle follows;
    HeadMesh head; // may be empty
    std::vector<Collider> colliders;
    std::vector<LoadedMesh> meshes;  // colliders, too
    std::unique_ptr<Body> body;      // a collider, too, which moves the head; or null
    std::vector<Collider> stand_ins; // for them, where strands of the model tressfx meet no mesh
    std::vector<Hand> hands;         // colliders with a motion of their own
    std::array<float, 3> pivot;
    std::optional<std::array<float, 2>> neck; // absent: the whole mesh turns
    Eigen::AlignedBox3f hair_bounds;          // at rest
    float azimuth;                            // degrees: from where the hair is seen
    float size; // of the scalp over the mannequin's, as a length: drawn hair is as much wider

    const plait_groom* simulated() const { return guides ? guides.get() : groom.get(); }
    uint32_t simulated_strands() const;
    bool draws_body() const { return body && body->mesh().choice.drawn; }
    // What belongs to strands of the groom, of those that are simulated.
    std::vector<uint32_t> of_simulated(const std::vector<uint32_t>& of_strands) const;

    // Of what makes a share of the head's turn about the pivot and of its way.
    plait_pose pose_of_share(const plait_pose& head_pose, float share) const;

    // The head's mesh when the head is at `pose`; below the neck it stays, in between it twists.
    std::vector<Eigen::Vector3f> posed_head(const plait_pose& pose) const;

    // What is drawn beside the hair, hands and such meshes included: vertices now, the rest for ever.
    std::vector<Eigen::Vector3f> posed_solids(const plait_pose& pose, float time) const;
    HeadMesh solids;
};

// Of all the figure's strands: of as many guides as the scene names, or else the groom's own ladder.
// `hung`: where all hang with `roots`, as plait_levels_desc has it; empty: as groomed.
LevelsHandle make_levels(const Scene& scene, const Figure& figure, plait_view hung = {},
                         const plait_roots* roots = nullptr);
// Guides of the scene's level, and what follows them.
std::pair<GroomHandle, FollowMapHandle> take_level(const Scene& scene, const plait_levels* levels);

// Sets the scene's scale where it is to be found out ("auto"), and its motion where a body has it.
Figure make_figure(Scene& scene);

} // namespace simulate
