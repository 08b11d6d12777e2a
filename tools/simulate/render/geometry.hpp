// The hair and the mesh as an Embree scene, and what a ray finds in it.
#pragma once

#include "embree.hpp"
#include "render.hpp"

namespace render {

enum class Material { nothing, hair, skin };

// What the camera sees along one ray.
struct Surfel {
    Material material = Material::nothing;
    Eigen::Vector3f position;
    Eigen::Vector3f normal;  // skin: interpolated; hair: towards the camera, across the tangent
    Eigen::Vector3f tangent; // hair: unit, towards the tip
    float along = 0.0f;      // hair: 0 at the root, 1 at the tip
    float radius = 0.0f;     // hair: m
    float scalp = 0.0f;      // skin: share of the hair's root colour
    uint32_t strand = 0;
};

class Geometry {
  public:
    Geometry(RTCDevice device, const Hair& hair, const Mesh& mesh);
    ~Geometry();
    Geometry(const Geometry&) = delete;
    Geometry& operator=(const Geometry&) = delete;

    Surfel trace(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const;
    RTCScene scene() const { return scene_; }

  private:
    void add_hair(RTCDevice device, const Hair& hair);
    void add_mesh(RTCDevice device, const Mesh& mesh);
    void add_strand(const float* row, uint32_t vertices, uint32_t strand, float radius);
    Surfel hair_hit(const RTCRayHit& query) const;
    Surfel skin_hit(const RTCRayHit& query) const;

    RTCScene scene_;
    RTCGeometry hair_ = nullptr;
    unsigned hair_id_ = RTC_INVALID_GEOMETRY_ID;
    // Embree reads these in place while the scene lives.
    std::vector<Eigen::Vector4f> curve_points_; // x, y, z, radius
    std::vector<uint32_t> curve_first_;         // first of four control points [curves]
    std::vector<uint32_t> curve_strand_;
    std::vector<std::array<float, 2>> curve_along_;
    std::vector<Eigen::Vector3f> mesh_points_;
    std::vector<Eigen::Vector3f> mesh_normals_;
    std::vector<float> mesh_scalp_; // [mesh points] or none
    std::vector<std::array<uint32_t, 3>> mesh_triangles_;
};

} // namespace render
