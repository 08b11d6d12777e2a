#include "backend/reference/base/lanes.hpp"

namespace plait::reference {
namespace {

// Backward Euler continues from the present; BDF2 from (4 now - before)/3.
template <typename T> T continued(const T& now, const T& before) {
    return (4 * now - before) / 3;
}

Vec3 xyz_of(const View<const double>& pins, const Lane& lane, size_t row) {
    return {pins[lane.index(row, 0, 4)], pins[lane.index(row, 1, 4)], pins[lane.index(row, 2, 4)]};
}

} // namespace

Vec3 root_of(const View<const Vec4>& rest, const Pose& pose, size_t strand, uint32_t stride) {
    return pose.apply(xyz(rest[strand * stride]));
}

Motion::Motion(const Lane& lane, const plait_lane_params& params, const LaneState& state,
               const Vec3& new_root)
    : whole(params.h), h(params.bdf2 ? whole * 2.0 / 3.0 : whole), root(new_root),
      start(params.vertex_stride), v(params.vertex_stride, Vec3::Zero()),
      pull(params.vertex_stride, vec3(params.gravity)), from(params.vertex_stride, Vec3::Zero()),
      y(params.vertex_stride), w(params.vertex_stride, Vec3::Zero()), pin(params.vertex_stride),
      drag(params.drag * scale_of(lane, state.material, params.vertex_stride, PLAIT_LANE_DRAG)),
      friction(scale_of(lane, state.material, params.vertex_stride, PLAIT_LANE_FRICTION)),
      inertia((1 + drag * h) / (h * h)) {
    const Vec3 root_now = lane.vector(state.x, 0);
    const Vec3 root_before = params.bdf2 ? lane.vector(state.x_before, 0) : root_now;
    start[0] = root_now - root;
    y[0] = Vec3::Zero();
    if (params.bdf2)
        for (uint32_t i = 0; i < params.vertex_stride; ++i) {
            x_before.push_back(i == 0 ? Vec3(Vec3::Zero()) : lane.vector(state.x_before, i));
            v_before.push_back(i == 0 ? Vec3(Vec3::Zero()) : lane.vector(state.v_before, i));
        }
    root_velocity = (root - (params.bdf2 ? continued(root_now, root_before) : root_now)) / h;
    for (uint32_t i = 1; i < params.vertex_stride; ++i) {
        const Vec3 x = lane.vector(state.x, i);
        v[i] = lane.vector(state.v, i);
        start[i] = root_now + x - root;
        from[i] = params.bdf2 ? continued(x, x_before[i]) : x;
        const Vec3 velocity = params.bdf2 ? continued(v[i], v_before[i]) : v[i];
        if (params.accelerates)
            pull[i] += lane.vector(state.acceleration, i);
        w[i] = (velocity + h * (pull[i] + drag * vec3(params.air))) / (1 + drag * h);
        y[i] = from[i] + h * (w[i] - root_velocity);
        if (params.pins)
            pin[i] = {xyz_of(state.pin, lane, i), state.pin[lane.index(i, 3, 4)]};
    }
}

std::vector<std::optional<MeshPlane>> mesh_planes_of(const Lane& lane,
                                                     const plait_lane_params& params,
                                                     const View<const double>& planes) {
    if (!params.planes)
        return {};
    std::vector<std::optional<MeshPlane>> list(params.vertex_stride);
    const double last = planes[lane.index(0, PLAIT_LANE_PLANE_LAST, PLAIT_LANE_PLANE_COMPONENTS)];
    for (size_t i = 1; double(i) <= last && i < list.size(); ++i) {
        const auto at = [&](size_t component) {
            return planes[lane.index(i, component, PLAIT_LANE_PLANE_COMPONENTS)];
        };
        const auto vector = [&](size_t first) -> Vec3 {
            return {at(first), at(first + 1), at(first + 2)};
        };
        const MeshPlane plane{vector(PLAIT_LANE_PLANE_NORMAL), vector(PLAIT_LANE_PLANE_ANCHOR),
                              at(PLAIT_LANE_PLANE_HEIGHT),     at(PLAIT_LANE_PLANE_START),
                              at(PLAIT_LANE_PLANE_FRICTION),   {}};
        if (!plane.normal.isZero(0))
            list[i] = plane;
    }
    const auto tip = [&](size_t component) {
        return planes[lane.index(0, PLAIT_LANE_PLANE_CREASE + component,
                                 PLAIT_LANE_PLANE_COMPONENTS)];
    };
    const Vec3 normal(tip(0), tip(1), tip(2));
    if (!normal.isZero(0) && last > 0 && list[size_t(last)])
        list[size_t(last)]->crease = Hollow::Wall{normal, tip(3)};
    return list;
}

std::vector<Hollow> hollows_of(const Lane& lane, const plait_lane_params& params,
                               const View<const double>& hollows) {
    if (!params.hollows)
        return {};
    std::vector<Hollow> list(params.vertex_stride);
    for (size_t i = 1; i < list.size(); ++i) {
        const auto at = [&](size_t component) {
            return hollows[lane.index(i, component, PLAIT_LANE_HOLLOW_COMPONENTS)];
        };
        const auto vector = [&](size_t first) -> Vec3 {
            return {at(first), at(first + 1), at(first + 2)};
        };
        const double kind = at(PLAIT_LANE_HOLLOW_KIND);
        for (size_t k = 0; kind == double(PLAIT_HOLLOW_PLANES) && k < PLAIT_LANE_HOLLOW_PLANES;
             ++k) {
            const size_t first = PLAIT_LANE_HOLLOW_PLANE + k * PLAIT_LANE_HOLLOW_STRIDE;
            if (!vector(first).isZero(0))
                list[i].walls.push_back({vector(first), at(first + 3)});
        }
        if (kind == double(PLAIT_HOLLOW_ROOM)) {
            list[i].room = at(PLAIT_LANE_HOLLOW_ROOM);
            list[i].begin = vector(PLAIT_LANE_HOLLOW_ANCHOR);
        }
    }
    return list;
}

Vec3 Motion::goal(size_t vertex, double mass) const {
    const auto& [target, k] = pin[vertex];
    const double mu = mass * inertia;
    return k > 0 ? Vec3((mu * y[vertex] + k * target) / (mu + k)) : y[vertex];
}

std::vector<Vec3> Motion::velocities(const std::vector<Vec3>& x) const {
    std::vector<Vec3> solved = w;
    for (size_t i = 1; i < x.size(); ++i)
        solved[i] += (x[i] - y[i]) / h;
    return solved;
}

std::vector<Vec3> Motion::relative_start() const {
    std::vector<Vec3> relative = start;
    for (Vec3& at : relative)
        at -= start[0];
    return relative;
}

void Motion::store(const Lane& lane, const LaneState& state, const std::vector<Vec3>& x,
                   const std::vector<Vec3>& solved) const {
    if (!x_before.empty())
        lane.store(state.x_before, 0, Vec3(root + start[0]));
    lane.store(state.x, 0, root);
    lane.store(state.v, 0, Vec3(-start[0] / whole));
    for (size_t i = 1; i < x.size(); ++i) {
        if (!x_before.empty()) {
            lane.store(state.x_before, i, lane.vector(state.x, i));
            lane.store(state.v_before, i, v[i]);
        }
        lane.store(state.x, i, x[i]);
        lane.store(state.v, i, solved[i]);
    }
}

} // namespace plait::reference
