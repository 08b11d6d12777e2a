#include "inside.hpp"

#include "embree.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace render {

namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

// Along no edge of a mesh that somebody modelled.
const Vector3f direction = Vector3f(0.3717f, 0.7861f, -0.4939f).normalized();

// Where two rays do not agree so many are asked, and where their mean is no nearer to 0 or 1 than
// that to a half, all triangles.
constexpr int ray_count = 64;
constexpr double unsure = 0.2;

// Evenly over the sphere, the i-th of `ray_count`: a spiral that turns by the golden angle.
Vector3f ray_direction(int i) {
    constexpr float golden_angle = 2.39996323f;
    const float up = 1.0f - (2.0f * static_cast<float>(i) + 1.0f) / ray_count;
    const float out = std::sqrt(1.0f - up * up), turn = golden_angle * static_cast<float>(i);
    return {out * std::cos(turn), up, out * std::sin(turn)};
}

// Of crossings from inside to outside, less those from outside to inside: Embree hands back a
// pointer to `base`.
struct Crossings {
    QueryContext base;
    int sum = 0;
};

// The filter: every hit is counted and let through.
void count_crossing(const RTCFilterFunctionNArguments* hit) {
    auto* crossings = reinterpret_cast<Crossings*>(hit->context);
    if (hit->valid[0] != -1)
        return;
    const Vector3f normal(RTCHitN_Ng_x(hit->hit, hit->N, 0), RTCHitN_Ng_y(hit->hit, hit->N, 0),
                          RTCHitN_Ng_z(hit->hit, hit->N, 0));
    const Vector3f along(RTCRayN_dir_x(hit->ray, hit->N, 0), RTCRayN_dir_y(hit->ray, hit->N, 0),
                         RTCRayN_dir_z(hit->ray, hit->N, 0));
    crossings->sum += normal.dot(along) > 0.0f ? 1 : -1;
    hit->valid[0] = 0;
}

int crossings_along(RTCScene scene, const Vector3f& origin, const Vector3f& along) {
    Crossings crossings;
    RTCRay ray = make_ray(origin, along, 0.0f, std::numeric_limits<float>::infinity());
    filter_along(scene, ray, crossings.base);
    return crossings.sum;
}

float distance_to_segment(const Vector3f& p, const Vector3f& a, const Vector3f& b) {
    const Vector3f way = b - a;
    const float length = way.squaredNorm();
    const float share = length > 0.0f ? std::clamp((p - a).dot(way) / length, 0.0f, 1.0f) : 0.0f;
    return (p - a - share * way).norm();
}

// To its plane where the foot lies in the triangle, else to the nearest edge.
float distance_to_triangle(const Vector3f& p, const Vector3f& a, const Vector3f& b,
                           const Vector3f& c) {
    const Vector3f normal = (b - a).cross(c - a);
    const auto within = [&](const Vector3f& from, const Vector3f& to) {
        return normal.cross(to - from).dot(p - from) >= 0.0f;
    };
    if (normal.squaredNorm() > 0.0f && within(a, b) && within(b, c) && within(c, a))
        return std::abs(normal.normalized().dot(p - a));
    return std::min(
        {distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
}

} // namespace

struct Solid::State {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    Eigen::AlignedBox3f box;
    // Embree reads these in place while the scene lives.
    std::vector<std::array<uint32_t, 3>> triangles;
    std::vector<Vector3f> vertices;

    ~State();
    void build();
    float distance(const Vector3f& point) const;
};

Solid::State::~State() {
    if (scene)
        rtcReleaseScene(scene);
    rtcReleaseDevice(device);
}

void Solid::State::build() {
    if (scene)
        rtcReleaseScene(scene);
    scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               vertices.data(), 0, sizeof(Vector3f), vertices.size());
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               triangles.data(), 0, sizeof(triangles[0]), triangles.size());
    rtcSetGeometryOccludedFilterFunction(geometry, count_crossing);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
}

float Solid::State::distance(const Vector3f& point) const {
    struct Search {
        const State* state;
        float least;
    } search{this, std::numeric_limits<float>::infinity()};
    RTCPointQuery query{};
    query.x = point.x(), query.y = point.y(), query.z = point.z();
    query.radius = search.least;
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(
        scene, &query, &context,
        [](RTCPointQueryFunctionArguments* found) {
            auto* const nearest = static_cast<Search*>(found->userPtr);
            const auto& [a, b, c] = nearest->state->triangles[found->primID];
            const auto& at = nearest->state->vertices;
            const float distance = distance_to_triangle(
                {found->query->x, found->query->y, found->query->z}, at[a], at[b], at[c]);
            if (distance >= nearest->least)
                return false;
            found->query->radius = nearest->least = distance;
            return true; // the radius has become less
        },
        &search);
    return search.least;
}

Solid::Solid(const std::vector<std::array<uint32_t, 3>>& triangles)
    : state_(std::make_unique<State>()) {
    state_->device = rtcNewDevice("threads=1"); // one point after the other
    if (!state_->device)
        throw std::runtime_error("Embree cannot start");
    state_->triangles = triangles;
}

Solid::~Solid() = default;

void Solid::set_vertices(const std::vector<Vector3f>& vertices) {
    state_->vertices = vertices;
    state_->vertices.reserve(vertices.size() + 1); // Embree reads 16 bytes at the last vertex
    state_->box.setEmpty();
    for (const Vector3f& vertex : vertices)
        state_->box.extend(vertex);
    state_->build();
}

double Solid::winding_number(const Vector3f& point) const {
    double angle = 0.0; // solid
    for (const auto& triangle : state_->triangles) {
        Vector3d to[3];
        for (size_t k = 0; k < 3; ++k)
            to[k] = (state_->vertices[triangle[k]] - point).cast<double>();
        const double a = to[0].norm(), b = to[1].norm(), c = to[2].norm();
        angle += 2.0 * std::atan2(to[0].dot(to[1].cross(to[2])), a * b * c + to[0].dot(to[1]) * c +
                                                                     to[1].dot(to[2]) * a +
                                                                     to[2].dot(to[0]) * b);
    }
    return angle / (4.0 * std::numbers::pi);
}

// A mesh winds around a point as often as rays from there cross it, in the mean of all directions;
// where it is closed, in every one. Two that do not agree met a hole or an edge.
bool Solid::contains(const Vector3f& point) const {
    const auto crossings = [&](const Vector3f& along) {
        return crossings_along(state_->scene, point, along);
    };
    const int forward = crossings(direction), backward = crossings(-direction);
    if (forward == backward)
        return forward != 0;
    int sum = 0;
    for (int i = 0; i < ray_count; ++i)
        sum += crossings(ray_direction(i));
    const double mean = std::abs(static_cast<double>(sum)) / ray_count;
    return std::abs(mean - 0.5) > unsure ? mean > 0.5 : std::abs(winding_number(point)) >= 0.5;
}

float Solid::depth(const Vector3f& point) const {
    return state_->box.contains(point) && contains(point) ? state_->distance(point) : 0.0f;
}

} // namespace render
