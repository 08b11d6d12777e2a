#include "geometry.hpp"

namespace render {

namespace {

constexpr float tip_taper = 0.15f;  // radius of the tip / radius of the middle
constexpr float root_taper = 0.45f; // of the root, so that hair does not begin as a row of pegs
constexpr float root_share = 0.06f; // of the strand, over which it grows from that

// The drawn radius over that of the middle; `along` 0 at the root, 1 at the tip.
float taper(float along) {
    const float root = std::min(1.0f, along / root_share), tip = along * along * along;
    return (root_taper + (1.0f - root_taper) * root) * (1.0f + (tip_taper - 1.0f) * tip);
}

// A buffer that Embree reads from our vector; Eigen::Vector4f and the like are plain floats.
template <typename T>
void share(RTCGeometry geometry, RTCBufferType type, RTCFormat format, const std::vector<T>& data) {
    rtcSetSharedGeometryBuffer(geometry, type, 0, format, data.data(), 0, sizeof(T), data.size());
}

unsigned attach(RTCScene scene, RTCGeometry geometry) {
    rtcCommitGeometry(geometry);
    const unsigned id = rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    return id;
}

std::vector<Eigen::Vector3f> smooth_normals(const std::vector<Eigen::Vector3f>& points,
                                            const std::vector<std::array<uint32_t, 3>>& triangles) {
    std::vector<Eigen::Vector3f> normals(points.size(), Eigen::Vector3f::Zero());
    for (const auto& [a, b, c] : triangles) {
        const Eigen::Vector3f area = (points[b] - points[a]).cross(points[c] - points[a]);
        for (const uint32_t vertex : {a, b, c})
            normals[vertex] += area;
    }
    for (Eigen::Vector3f& normal : normals)
        normal.normalize();
    return normals;
}

} // namespace

Geometry::Geometry(RTCDevice device, const Hair& hair, const Mesh& mesh)
    : scene_(rtcNewScene(device)) {
    add_hair(device, hair);
    add_mesh(device, mesh);
    rtcCommitScene(scene_);
}

Geometry::~Geometry() {
    rtcReleaseScene(scene_);
}

// A Catmull-Rom curve through the vertices; its first and last control points are mirrored ends.
void Geometry::add_strand(const float* row, uint32_t vertices, uint32_t strand, float radius) {
    const auto point = [&](uint32_t v) {
        const float along = static_cast<float>(v) / static_cast<float>(vertices - 1);
        const float* const at = row + size_t{4} * v;
        return Eigen::Vector4f(at[0], at[1], at[2], radius * taper(along));
    };
    const auto mirrored = [](const Eigen::Vector4f& end, const Eigen::Vector4f& next) {
        Eigen::Vector4f control = 2.0f * end - next;
        control.w() = end.w();
        return control;
    };
    const uint32_t first = static_cast<uint32_t>(curve_points_.size());
    curve_points_.push_back(mirrored(point(0), point(1)));
    for (uint32_t v = 0; v < vertices; ++v)
        curve_points_.push_back(point(v));
    curve_points_.push_back(mirrored(point(vertices - 1), point(vertices - 2)));
    const float share = 1.0f / static_cast<float>(vertices - 1);
    for (uint32_t segment = 0; segment + 1 < vertices; ++segment) {
        curve_first_.push_back(first + segment);
        curve_strand_.push_back(strand);
        curve_along_.push_back({share * static_cast<float>(segment), share});
    }
}

void Geometry::add_hair(RTCDevice device, const Hair& hair) {
    const float width = hair.width > 0.0f ? hair.width : default_width(hair.vertex_count.size());
    for (uint32_t strand = 0; strand < hair.vertex_count.size(); ++strand)
        if (hair.vertex_count[strand] >= 2)
            add_strand(&hair.positions[size_t{4} * hair.row * strand], hair.vertex_count[strand],
                       strand, 0.5f * width);
    if (curve_first_.empty())
        return;
    hair_ = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_FLAT_CATMULL_ROM_CURVE);
    share(hair_, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, curve_points_);
    share(hair_, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT, curve_first_);
    rtcSetGeometryTessellationRate(hair_, 3.0f);
    rtcSetGeometryOccludedFilterFunction(hair_, count_hair);
    hair_id_ = attach(scene_, hair_);
}

void Geometry::add_mesh(RTCDevice device, const Mesh& mesh) {
    if (mesh.triangles.empty())
        return;
    mesh_points_ = mesh.vertices;
    mesh_triangles_ = mesh.triangles;
    mesh_scalp_ = mesh.scalp;
    mesh_normals_ = smooth_normals(mesh_points_, mesh_triangles_);
    mesh_points_.reserve(mesh_points_.size() + 1); // Embree reads 16 bytes at the last vertex
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    share(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, mesh_points_);
    share(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, mesh_triangles_);
    attach(scene_, geometry);
}

Surfel Geometry::hair_hit(const RTCRayHit& query) const {
    alignas(16) float p[4], dp[4];
    rtcInterpolate1(hair_, query.hit.primID, query.hit.u, 0.0f, RTC_BUFFER_TYPE_VERTEX, 0, p, dp,
                    nullptr, 4);
    const Eigen::Vector3f centre(p[0], p[1], p[2]),
        view(query.ray.dir_x, query.ray.dir_y, query.ray.dir_z);
    Surfel surfel;
    surfel.material = Material::hair;
    surfel.tangent = Eigen::Vector3f(dp[0], dp[1], dp[2]).normalized();
    surfel.normal = (surfel.tangent.dot(view) * surfel.tangent - view).normalized();
    surfel.position = centre;
    surfel.radius = p[3];
    const auto& [start, share] = curve_along_[query.hit.primID];
    surfel.along = start + share * query.hit.u;
    surfel.strand = curve_strand_[query.hit.primID];
    return surfel;
}

Surfel Geometry::skin_hit(const RTCRayHit& query) const {
    const auto& [a, b, c] = mesh_triangles_[query.hit.primID];
    const float u = query.hit.u, v = query.hit.v;
    const Eigen::Vector3f view(query.ray.dir_x, query.ray.dir_y, query.ray.dir_z);
    Surfel surfel;
    surfel.material = Material::skin;
    surfel.position = (1.0f - u - v) * mesh_points_[a] + u * mesh_points_[b] + v * mesh_points_[c];
    surfel.normal =
        ((1.0f - u - v) * mesh_normals_[a] + u * mesh_normals_[b] + v * mesh_normals_[c])
            .normalized();
    if (!mesh_scalp_.empty())
        surfel.scalp = (1.0f - u - v) * mesh_scalp_[a] + u * mesh_scalp_[b] + v * mesh_scalp_[c];
    if (surfel.normal.dot(view) > 0.0f)
        surfel.normal = -surfel.normal;
    return surfel;
}

Surfel Geometry::trace(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const {
    const RTCRayHit query = nearest_hit(scene_, origin, direction);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return {};
    return query.hit.geomID == hair_id_ ? hair_hit(query) : skin_hit(query);
}

} // namespace render
