#include "lane_inputs.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace plait::cases {
namespace {

using Quat = std::array<double, 4>; // (x, y, z, w)

Quat product(const Quat& a, const Quat& b) {
    return {a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
            a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
            a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
            a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]};
}

Quat small_turn(Random& random, double most) {
    const auto axis = random.direction();
    const double half = random.uniform(0.2, 0.5) * most;
    return {axis[0] * std::sin(half), axis[1] * std::sin(half), axis[2] * std::sin(half),
            std::cos(half)};
}

template <typename Values> void append(std::vector<float>& to, const Values& values) {
    for (const double value : values)
        to.push_back(static_cast<float>(value));
}

Point random_step(Random& random, double most) {
    const Point d = random.direction();
    const double size = random.uniform(0, most);
    return {size * d[0], size * d[1], size * d[2]};
}

Point sum(const Point& a, const Point& b, double scale = 1) {
    return {a[0] + scale * b[0], a[1] + scale * b[1], a[2] + scale * b[2]};
}

Point direction_of(const Point& p) {
    return sum({0, 0, 0}, p, 1 / std::hypot(p[0], p[1], p[2]));
}

Point cross(const Point& a, const Point& b) {
    return direction_of(
        {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]});
}

std::array<double, 4> with_radius(const Point& p, double radius) {
    return {p[0], p[1], p[2], radius};
}

// A hair of 5e-6 kg/m whose bending and weight are of one size, per segment.
void add_material(LaneHair& lanes, Random& random, bool segment, bool root) {
    constexpr double density = 5e-6, bend = 4e-8, stretch = 4e-3;
    const double length = segment ? segment_length : 0;
    const double scale = random.uniform(0.8, 1.2);
    const double joint = segment ? (root ? 2 : 1) * 4 * scale * bend / length : 0;
    const double twist = random.uniform(-0.4, 0.4), cross = random.uniform(0.2, 1);
    append(lanes.material, std::array<double, PLAIT_LANE_MATERIAL_COMPONENTS>{
                               length, segment ? scale * stretch / length : 0, joint,
                               scale * density * segment_length, twist * joint, cross * joint});
}

// Of a strand of `stride` rows that are all there.
float* scales_of(std::vector<float>& material, size_t strand, size_t stride) {
    return &material[((strand + 1) * stride - 1) * PLAIT_LANE_MATERIAL_COMPONENTS];
}

// Each strand feels what it lies on by a scale of its own, which makes friction what it would be by 1:
// inputs are chosen by what keeps clear of decisions then. So is drag.
float friction_for(std::vector<float>& material, size_t strand, size_t stride, float friction) {
    float* scales = scales_of(material, strand, stride);
    scales[PLAIT_LANE_DRAG] = 1;
    scales[PLAIT_LANE_FRICTION] = std::exp2(static_cast<float>(strand % 3) - 1);
    return friction / scales[PLAIT_LANE_FRICTION];
}

void add_strand(LaneHair& lanes, Random& random, Random& forces, uint32_t count, uint32_t stride,
                const float* pose, const float* root_rest) {
    const Quat pose_q = {pose[0], pose[1], pose[2], pose[3]};
    const Point pose_t = {pose[4], pose[5], pose[6]};
    const Point root = sum(rotate(pose_q, {root_rest[0], root_rest[1], root_rest[2]}), pose_t);
    Point x = {0, 0, 0};
    Quat q = pose_q;
    for (uint32_t i = 0; i < stride; ++i) {
        const bool segment = i + 1 < count, padding = i >= count;
        const Quat rest = i == 0 ? random.rotation() : small_turn(random, 0.4);
        append(lanes.rest, padding ? Quat{0, 0, 0, 1} : rest);
        add_material(lanes, random, segment, i == 0);
        q = product(product(q, rest), small_turn(random, 0.2));
        append(lanes.q, q);
        append(lanes.q_before, product(q, small_turn(random, 0.05)));
        const Point shift = random_step(random, 1e-3);
        append(lanes.x, i == 0 ? sum(root, shift) : x);
        append(lanes.x_before, i == 0 ? root : sum(x, shift));
        append(lanes.v, random_step(random, 0.3));
        append(lanes.v_before, random_step(random, 0.3));
        append(lanes.normal_force, std::array<double, 1>{forces.uniform(5e-6, 2e-5)});
        x = sum(x, rotate(q, {1, 0, 0}), segment_length);
    }
}

Point place_of(const LaneHair& lanes, size_t vertex) {
    const size_t stride = lanes.hair.size.stride;
    const float* root = &lanes.x[3 * (vertex / stride) * stride];
    const float* x = &lanes.x[3 * vertex];
    return {root[0] + x[0], root[1] + x[1], root[2] + x[2]};
}

// A tapered capsule whose side is `gap` (m) off the start of a vertex, down the way that forces
// drive it, and moves a little.
void add_capsule(LaneHair& lanes, Random& random, size_t vertex, double gap, float friction,
                 double taper = 0.005, double moves = 0.03, double wider = 0) {
    const Point down = sum(direction_of({20, -40, 30}), random_step(random, 0.2));
    const Point across = cross(down, random.direction());
    const double radius = random.uniform(0.03, 0.04) + wider;
    const Point middle = sum(place_of(lanes, vertex), down, radius + gap);
    const Point to = sum(middle, random_step(random, moves));
    for (const Point& at : {middle, to})
        for (const double side : {-1.0, 1.0})
            append(lanes.capsules,
                   with_radius(sum(at, across, 0.04 * side), radius - taper * side));
    append(lanes.capsules, small_turn(random, 0.3));
    append(lanes.capsules, Quat{double(friction), double{PLAIT_KIND_CAPSULE}, 0, 0});
}

// The same with a box, whose face, or an edge of it, is as far off.
void add_box(LaneHair& lanes, Random& random, size_t vertex, double gap, float friction) {
    const Point down = sum(direction_of({20, -40, 30}), random_step(random, 0.2));
    const Quat orientation = random.rotation();
    const Point half = {random.uniform(0.02, 0.05), random.uniform(0.02, 0.05),
                        random.uniform(0.02, 0.05)};
    const double rounding = random.below(2) == 0 ? 0 : 0.01;
    double reach = rounding; // of the box along `down`
    for (size_t axis = 0; axis < 3; ++axis) {
        Point unit = {0, 0, 0};
        unit[axis] = 1;
        const Point edge = rotate(orientation, unit);
        reach += half[axis] * std::abs(edge[0] * down[0] + edge[1] * down[1] + edge[2] * down[2]);
    }
    const Point middle = sum(place_of(lanes, vertex), down, 0.7 * reach + gap);
    append(lanes.capsules, with_radius(middle, rounding));
    append(lanes.capsules, orientation);
    append(lanes.capsules, with_radius(sum(middle, random_step(random, 0.03)), rounding));
    append(lanes.capsules, with_radius(half, 0));
    append(lanes.capsules, small_turn(random, 0.3));
    append(lanes.capsules, Quat{double(friction), double{PLAIT_KIND_BOX}, 0, 0});
}

// The same with a prism on a triangle, whose faces, or an edge of them, are as far off.
void add_hull(LaneHair& lanes, Random& random, size_t vertex, double gap, float friction) {
    const Point down = sum(direction_of({20, -40, 30}), random_step(random, 0.2));
    const Quat orientation = random.rotation();
    const double margin = random.below(2) == 0 ? 0 : 0.01;
    const double across = random.uniform(0.02, 0.035), along = random.uniform(0.02, 0.05);
    const double side = std::sqrt(0.75);
    const std::array<double, 4> faces[] = {{0, 1, 0, across},
                                           {side, -0.5, 0, across},
                                           {-side, -0.5, 0, across},
                                           {0, 0, 1, along},
                                           {0, 0, -1, along}};
    const Point half = {2 * side * across, 2 * across, along}; // of a box around it
    const Point middle = sum(place_of(lanes, vertex), down, 1.1 * across + margin + gap);
    append(lanes.faces, Quat{0.5, 0.5, 0.5, 0.5}); // of none: see pack() in colliders.hpp
    const auto begins = static_cast<double>(lanes.faces.size() / 4);
    append(lanes.capsules, with_radius(middle, margin));
    append(lanes.capsules, orientation);
    append(lanes.capsules, with_radius(sum(middle, random_step(random, 0.03)), margin));
    append(lanes.capsules, with_radius(half, 0));
    append(lanes.capsules, small_turn(random, 0.3));
    append(lanes.capsules, Quat{double(friction), double{PLAIT_KIND_HULL}, begins, 5});
    for (const auto& face : faces)
        append(lanes.faces, face);
}

// A plane `gap` below the vertex that lies lowest, the way that forces drive it.
void add_plane(LaneHair& lanes, Random& random, double gap, float friction) {
    const Point down = sum(direction_of({20, -40, 30}), random_step(random, 0.2));
    const Point normal = direction_of(sum({0, 0, 0}, down, -1));
    const auto height = [&](const Point& p) {
        return p[0] * normal[0] + p[1] * normal[1] + p[2] * normal[2];
    };
    Point lowest = place_of(lanes, 1);
    for (size_t s = 0; s < lanes.hair.size.strands; ++s)
        for (uint32_t i = 1; i < lanes.hair.vertex_count[s]; ++i)
            if (const Point p = place_of(lanes, s * lanes.hair.size.stride + i);
                height(p) < height(lowest))
                lowest = p;
    const Point point = sum(lowest, normal, -gap);
    append(lanes.capsules, with_radius(point, 0));
    append(lanes.capsules, with_radius(normal, 0));
    append(lanes.capsules, with_radius(sum(point, random_step(random, 0.03)), 0));
    append(lanes.capsules, with_radius(normal, 0));
    append(lanes.capsules, small_turn(random, 0.1));
    append(lanes.capsules, Quat{double(friction), double{PLAIT_KIND_PLANE}, 0, 0});
}

double dot(const Point& a, const Point& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// m, of `p` outside of a room that is to grow: a capsule, a box or a prism on a triangle around `middle`,
// `size` along one axis and half of it across.
double outside_of_room(float kind, const Quat& turn, const Point& middle, double size,
                       const Point& p) {
    const Point off = sum(p, middle, -1);
    Point own{};
    for (size_t axis = 0; axis < 3; ++axis) {
        Point unit = {0, 0, 0};
        unit[axis] = 1;
        own[axis] = dot(off, rotate(turn, unit));
    }
    const double side = std::sqrt(0.75), across = size / 2;
    if (kind == PLAIT_KIND_HULL)
        return std::max({own[1] - across, side * own[0] - own[1] / 2 - across,
                         -side * own[0] - own[1] / 2 - across, std::abs(own[2]) - size});
    const bool capsule = kind == PLAIT_KIND_CAPSULE;
    const Point beyond = {std::max(std::abs(own[0]) - (capsule ? 0 : across), 0.0),
                          std::max(std::abs(own[1]) - (capsule ? 0 : across), 0.0),
                          std::max(std::abs(own[2]) - size, 0.0)};
    return std::hypot(beyond[0], beyond[1], beyond[2]);
}

// A room around all hair, rounded so far that the vertex farthest out begins `depth` (m) outside, and that
// moves and turns a little; above the hair's middle, as forces drive hair down.
void add_room(LaneHair& lanes, Random& random, float kind, double depth, float friction) {
    constexpr double size = 0.3, moves = 0.004, turns = 0.02;
    const Quat orientation = random.rotation();
    Point middle = {0, 0, 0};
    std::vector<Point> places;
    for (size_t s = 0; s < lanes.hair.size.strands; ++s)
        for (uint32_t i = 0; i < lanes.hair.vertex_count[s]; ++i)
            places.push_back(place_of(lanes, s * lanes.hair.size.stride + i));
    for (const Point& place : places)
        middle = sum(middle, place, 1.0 / static_cast<double>(places.size()));
    middle = sum(middle, direction_of({-20, 40, -30}), 0.1);
    double grows = 0;
    for (const Point& place : places)
        grows = std::max(grows, outside_of_room(kind, orientation, middle, size, place));
    const double radius = grows - depth, side = std::sqrt(0.75), across = size / 2;
    const Point to = sum(middle, random_step(random, moves));
    const double kind_of_row = double{kind} + double{PLAIT_KIND_INWARD};
    if (kind == PLAIT_KIND_CAPSULE) {
        const Point axis = rotate(orientation, {0, 0, size});
        for (const Point& at : {middle, to})
            for (const double end : {-1.0, 1.0})
                append(lanes.capsules, with_radius(sum(at, axis, end), radius));
    } else {
        const bool hull = kind == PLAIT_KIND_HULL;
        append(lanes.capsules, with_radius(middle, radius));
        append(lanes.capsules, orientation);
        append(lanes.capsules, with_radius(to, radius));
        append(lanes.capsules,
               with_radius({hull ? 2 * side * across : across, hull ? size : across, size}, 0));
    }
    append(lanes.capsules, small_turn(random, turns));
    if (kind != PLAIT_KIND_HULL) {
        append(lanes.capsules, Quat{double(friction), kind_of_row, 0, 0});
        return;
    }
    append(lanes.faces, Quat{0.5, 0.5, 0.5, 0.5}); // of none, as in add_hull
    append(lanes.capsules,
           Quat{double(friction), kind_of_row, static_cast<double>(lanes.faces.size() / 4), 5});
    for (const auto& face :
         {Quat{0, 1, 0, across}, Quat{side, -0.5, 0, across}, Quat{-side, -0.5, 0, across},
          Quat{0, 0, 1, size}, Quat{0, 0, -1, size}})
        append(lanes.faces, face);
}

std::vector<float> without_w(const std::vector<float>& float4s) {
    std::vector<float> values;
    for (size_t i = 0; i < float4s.size(); ++i)
        if (i % 4 != 3)
            values.push_back(float4s[i]);
    return values;
}

// Where its faces are, from each hull's row on.
std::vector<float> with_faces(std::vector<float> rows, const std::vector<float>& faces) {
    constexpr size_t row = size_t{4} * PLAIT_COLLIDER_STRIDE;
    const size_t end = rows.size();
    for (size_t at = 0; at < end; at += row)
        if (std::fmod(rows[at + row - 3], PLAIT_KIND_INWARD) == PLAIT_KIND_HULL)
            rows[at + row - 2] += static_cast<float>((end - at) / 4);
    rows.insert(rows.end(), faces.begin(), faces.end());
    return rows;
}

// All strands inside: what a kernel meets that reads the capsules of the substep before.
std::vector<float> capsules_of_two_substeps(const std::vector<float>& capsules) {
    std::vector<float> both;
    for (size_t i = 0; i < capsules.size(); i += size_t{4} * PLAIT_COLLIDER_STRIDE) {
        for (int sphere = 0; sphere < 4; ++sphere)
            append(both, with_radius({0, 0, 0}, 9));
        append(both, Quat{0, 0, 0, 1});
        append(both, Quat{0, 0, 0, 0});
    }
    both.insert(both.end(), capsules.begin(), capsules.end());
    return both;
}

} // namespace

LaneHair make_lane_hair(const Size& size, uint32_t seed) {
    LaneHair lanes;
    lanes.hair = make_hair(size, seed);
    Random random(seed * 104729 + size.strands * 17 + size.stride), scales(seed + 5),
        forces(seed + 9);
    for (uint32_t s = 0; s < size.strands; ++s) {
        add_strand(lanes, random, forces, lanes.hair.vertex_count[s], size.stride,
                   &lanes.hair.pose[8 * s], &lanes.hair.rest[size_t{4} * s * size.stride]);
        float* own = scales_of(lanes.material, s, size.stride);
        own[PLAIT_LANE_DRAG] = static_cast<float>(scales.uniform(0.4, 1.6));
        own[PLAIT_LANE_FRICTION] = static_cast<float>(scales.uniform(0.6, 1.4));
    }
    return lanes;
}

LaneHair make_lane_hair_in_contact(const Size& size, uint32_t seed, float friction) {
    LaneHair lanes = make_lane_hair(size, seed);
    Random random(seed + 1);
    for (size_t s = 0; s < size.strands; ++s) {
        const size_t vertex = s * size.stride + lanes.hair.vertex_count[s] / 2;
        add_capsule(lanes, random, vertex, s % 3 == 2 ? -0.015 : 0.004,
                    friction_for(lanes.material, s, size.stride, s % 2 ? 0.3f : friction));
        if (s % 4 == 1) // deep around the root, too
            add_capsule(lanes, random, s * size.stride + 1, -0.025,
                        friction_for(lanes.material, s, size.stride, friction));
    }
    return lanes;
}

// All but at rest, so that what is pressed to a surface stays so.
LaneHair make_lane_hair_calm(const Size& size, uint32_t seed) {
    LaneHair lanes = make_lane_hair(size, seed);
    for (std::vector<float>* values : {&lanes.v, &lanes.v_before})
        for (float& v : *values)
            v *= 0.1f;
    return lanes;
}

LaneHair make_lane_hair_pressed(const Size& size, uint32_t seed, float friction) {
    LaneHair lanes = make_lane_hair(size, seed);
    Random random(seed + 1);
    for (size_t s = 0; s < size.strands; ++s)
        add_capsule(lanes, random, s * size.stride + lanes.hair.vertex_count[s] / 2,
                    s % 3 == 2 ? -0.00015 : 0.0001,
                    friction_for(lanes.material, s, size.stride, s % 2 ? 0.3f : friction), 0, 0.008,
                    0.08);
    return lanes;
}

LaneHair make_lane_hair_on_surfaces(const Size& size, uint32_t seed, float friction, uint32_t far) {
    LaneHair lanes = make_lane_hair(size, seed);
    Random random(seed + 4);
    for (uint32_t i = 0; i < far; ++i) { // out of reach
        const size_t first = lanes.capsules.size();
        add_box(lanes, random, 1, 9, friction);
        lanes.capsules[first + size_t{4} * PLAIT_COLLIDER_STRIDE - 3] =
            i % 2 ? PLAIT_KIND_BOX : PLAIT_KIND_CAPSULE;
    }
    add_plane(lanes, random, -0.003, friction);
    for (size_t s = 0; s < size.strands; ++s) {
        const size_t vertex = s * size.stride + lanes.hair.vertex_count[s] / 2;
        const double gap = s % 3 == 2 ? -0.01 : 0.004;
        if (s % 4 == 3)
            add_capsule(lanes, random, vertex, gap,
                        friction_for(lanes.material, s, size.stride, 0.3f));
        else
            add_box(lanes, random, vertex, gap,
                    friction_for(lanes.material, s, size.stride, s % 2 ? 0.3f : friction));
    }
    return lanes;
}

LaneHair make_lane_hair_on_hulls(const Size& size, uint32_t seed, float friction) {
    LaneHair lanes = make_lane_hair(size, seed);
    Random random(seed + 6);
    for (size_t s = 0; s < size.strands; ++s)
        add_hull(lanes, random, s * size.stride + lanes.hair.vertex_count[s] / 2,
                 s % 3 == 2 ? -0.01 : 0.004,
                 friction_for(lanes.material, s, size.stride, s % 2 ? 0.3f : friction));
    return lanes;
}

LaneHair make_lane_hair_in_room(const Size& size, uint32_t seed, float kind, float friction) {
    LaneHair lanes = make_lane_hair(size, seed);
    Random random(seed + 8);
    add_room(lanes, random, kind, 0.003, friction);
    return lanes;
}

std::vector<uint32_t> other_order(uint32_t strands, uint32_t count) {
    std::vector<uint32_t> list(count);
    for (uint32_t i = 0; i < count; ++i)
        list[i] = strands - 1 - i;
    if (count > 2)
        std::swap(list[0], list[count / 2]);
    return list;
}

Setup reordered(Setup setup, std::initializer_list<size_t> buffers) {
    const std::vector<uint32_t> list = other_order(setup.items, setup.items);
    const auto reorder = [&](Array& rows) {
        const size_t width = rows.floats.size() / setup.items;
        const std::vector<float> plain = rows.floats;
        for (size_t lane = 0; lane < setup.items; ++lane)
            std::copy_n(&plain[lane * width], width, &rows.floats[list[lane] * width]);
    };
    setup.name += ", reordered";
    setup.buffers[0] = uints(list);
    for (const size_t buffer : buffers)
        reorder(setup.buffers[buffer]);
    return setup;
}

LaneHair make_lane_hair_spun(const Size& size, uint32_t seed) {
    LaneHair lanes = make_lane_hair(size, seed);
    Random random(seed + 2);
    double most = 0;
    for (size_t k = 0; k < lanes.q.size(); k += 4) {
        if (k % (size_t{4} * size.stride) == 0)
            most = random.uniform(0.1, 0.3);
        const Quat q = {lanes.q[k], lanes.q[k + 1], lanes.q[k + 2], lanes.q[k + 3]};
        const Quat before = product(q, small_turn(random, most));
        std::copy(before.begin(), before.end(), lanes.q_before.begin() + static_cast<long>(k));
    }
    for (float& v : lanes.v)
        v *= 5;
    return lanes;
}

LaneHair make_lane_hair_wrung(const Size& size, uint32_t seed) {
    LaneHair lanes = make_lane_hair(size, seed);
    Random random(seed + 3);
    for (size_t k = 0; k < lanes.q.size(); k += 4) {
        const double half = random.uniform(-0.5, 0.5);
        for (std::vector<float>* q : {&lanes.q, &lanes.q_before}) {
            const auto at = q->begin() + static_cast<long>(k);
            const Quat turned =
                product({at[0], at[1], at[2], at[3]}, {std::sin(half), 0, 0, std::cos(half)});
            std::copy(turned.begin(), turned.end(), at);
        }
    }
    for (float& v : lanes.v_before)
        v *= 4;
    for (size_t k = 0; k < lanes.material.size(); k += PLAIT_LANE_MATERIAL_COMPONENTS)
        lanes.material[k + PLAIT_LANE_TWIST] = -0.8f * lanes.material[k + PLAIT_LANE_BEND];
    return lanes;
}

plait_lane_params lane_params(const Size& size, uint32_t iterations, uint32_t bdf2) {
    plait_lane_params params = {
        size.stride, 1, size.stride, 1.0f / 30, iterations, bdf2, 4, {20, -40, 30}, {9, 8, -7}, 0,
        0,           0, 0,           0,         0,          0,    0};
    params.contact_rate = 3e5f; // what starts inside is pushed out by millimetres
    params.contact_slip = 0.03f;
    params.accelerates = 1;
    return params;
}

plait_lane_params lane_params_afloat(const Size& size, uint32_t iterations) {
    plait_lane_params params = lane_params(size, iterations, 1);
    for (float& g : params.gravity)
        g *= 0.1f;
    return params;
}

Setup lane_setup(const Size& size, const LaneHair& lanes, const plait_lane_params& params,
                 bool bends) {
    Setup setup;
    setup.name = name_of(size) + (params.bdf2 ? ", BDF2" : "");
    setup.items = size.strands;
    setup.width = size.stride;
    setup.buffers = {null_array(), float4s(lanes.hair.rest), float4s(lanes.hair.pose),
                     lane_floats(lanes.material, PLAIT_LANE_MATERIAL_COMPONENTS)};
    if (bends)
        setup.buffers.push_back(lane_floats(lanes.rest, 4));
    setup.buffers.push_back(
        lanes.capsules.empty()
            ? null_array()
            : float4s(with_faces(capsules_of_two_substeps(lanes.capsules), lanes.faces)));
    // none in contact, whose capsules lie where gravity drives the hair
    const auto& g = params.gravity;
    const double strongest = lanes.capsules.empty() ? 0.5 * std::hypot(g[0], g[1], g[2]) : 0;
    setup.buffers.push_back(lane_floats(without_w(accelerations(lanes.hair.size, strongest)), 3));
    // there, though not read, so that turning them on is a fair disturbance
    setup.buffers.push_back(lane_floats(std::vector<float>(lanes.q.size(), 0), 4));
    setup.buffers.push_back(
        lane_floats(std::vector<float>(lanes.q.size() / 4 * PLAIT_LANE_PLANE_COMPONENTS, 0),
                    PLAIT_LANE_PLANE_COMPONENTS));
    setup.buffers.push_back(lane_floats(lanes.x, 3));
    setup.buffers.push_back(lane_floats(lanes.v, 3));
    if (bends) {
        setup.buffers.push_back(lane_floats(lanes.q, 4));
        setup.buffers.push_back(lane_floats(lanes.q_before, 4));
    }
    // kept even where BDF2 is off, so that turning it on is a fair disturbance
    setup.buffers.push_back(lane_floats(lanes.x_before, 3));
    setup.buffers.push_back(lane_floats(lanes.v_before, 3));
    if (bends) {
        setup.buffers.push_back(lane_floats(lanes.normal_force, 1));
        setup.buffers.push_back(
            lane_floats(std::vector<float>(lanes.q.size() / 4 * PLAIT_LANE_HOLLOW_COMPONENTS, 0),
                        PLAIT_LANE_HOLLOW_COMPONENTS));
    }
    plait_lane_params with_capsules = params;
    with_capsules.collider_count = with_capsules.collider_first =
        static_cast<uint32_t>(lanes.capsules.size() / (4 * PLAIT_COLLIDER_STRIDE));
    if (with_capsules.collider_count > 0)
        setup.name += ", " + std::to_string(with_capsules.collider_count) + " colliders";
    return setup.with(with_capsules);
}

Setup pinned(Setup setup, const LaneHair& lanes, bool bends) {
    auto params = setup.params_as<plait_lane_params>();
    params.pins = 1;
    std::vector<float>& pins = setup.buffers[bends ? 7 : 6].floats;
    Random random(params.vertex_stride);
    const auto pin = [&](size_t strand, size_t vertex) {
        const size_t row = strand * setup.width + vertex;
        const float mass = lanes.material[PLAIT_LANE_MATERIAL_COMPONENTS * row + PLAIT_LANE_MASS];
        for (int i = 0; i < 3; ++i)
            pins[4 * row + i] =
                lanes.x[3 * row + i] + static_cast<float>(random.uniform(-0.01, 0.01));
        const auto stiffness = static_cast<float>(random.uniform(0.5, 10)) * mass;
        pins[4 * row + 3] = (strand % 2 ? 10 : 1) * stiffness / (params.h * params.h);
    };
    for (size_t strand = 0; strand < setup.items; ++strand) {
        const size_t tip = lanes.hair.vertex_count[strand] - 1;
        pin(strand, tip);
        if (tip > 4)
            pin(strand, tip / 2);
    }
    setup.name += ", pinned";
    return setup.with(params);
}

Setup in_longer_rows(Setup setup, plait_stage stage, uint32_t more) {
    static constexpr std::string_view of_all_strands[] = {
        "rest", "acceleration", "pin_from", "pin_to", "position", "position_prev", "tangent"};
    const plait_stage_info& info = *plait_stage_describe(stage);
    plait_lane_tile_params params;
    std::memcpy(&params, setup.params.data(), sizeof params);
    for (size_t i = 0; i < setup.buffers.size(); ++i) {
        size_t per_vertex = 4;
        if (std::string_view(info.args[i].name) == "mesh_clearance")
            per_vertex = setup.params_as<plait_lane_params>().collider_count;
        else if (std::string_view(info.args[i].name) == "mesh_side")
            per_vertex = 4 * size_t{setup.params_as<plait_lane_params>().collider_count};
        else if (std::ranges::find(of_all_strands, info.args[i].name) == std::end(of_all_strands))
            continue;
        const size_t width = per_vertex * params.vertex_stride;
        const std::vector<float> plain = std::move(setup.buffers[i].floats);
        std::vector<float>& rows = setup.buffers[i].floats = {};
        for (size_t at = 0; at < plain.size(); at += width) {
            rows.insert(rows.end(), plain.begin() + static_cast<long>(at),
                        plain.begin() + static_cast<long>(at + width));
            rows.insert(rows.end(), per_vertex * more, 0.75f); // that no lane has
        }
    }
    params.row_stride += more;
    std::memcpy(setup.params.data(), &params, sizeof params);
    setup.name += ", in rows of " + std::to_string(params.row_stride);
    return setup;
}

void add_longer_rows(Case& result) {
    const std::vector<Setup> setups = result.setups;
    for (const Setup& setup : setups) {
        uint32_t stride;
        std::memcpy(&stride, setup.params.data(), sizeof stride);
        if (stride == 5 || stride == 9)
            result.setups.push_back(in_longer_rows(setup, result.stage, 1 + stride % 7));
    }
}

const std::vector<Size>& contact_sizes() {
    static const std::vector<Size> list = {{7, 9}, {4, 16}};
    return list;
}

void add_rods_on_surfaces(Case& result, uint32_t seed) {
    for (const Size& size : contact_sizes())
        for (const uint32_t far : {0u, 70u})
            result.setups.push_back(lane_setup(size,
                                               make_lane_hair_on_surfaces(size, seed, 100.0f, far),
                                               lane_params(size, 1, far == 0), true));
    result.flags.push_back("collider.kind");
}

// With some other seeds a vertex is about to break loose, or between two faces.
void add_rods_on_hulls(Case& result) {
    for (const Size& size : contact_sizes())
        for (const uint32_t bdf2 : {0u, 1u}) {
            const uint32_t seed = size.stride == 16 ? 103 : 119;
            result.setups.push_back(lane_setup(size, make_lane_hair_on_hulls(size, seed, 100.0f),
                                               lane_params(size, 1, bdf2), true));
            result.setups.back().name += ", on hulls";
        }
}

void add_rods_in_rooms(Case& result) {
    for (const Size& size : contact_sizes())
        for (const float kind : room_kinds)
            result.setups.push_back(lane_setup(size, make_lane_hair_in_room(size, 53, kind, 100.0f),
                                               lane_params(size, 1, kind == PLAIT_KIND_BOX), true));
}

// A plane across the way of forces, `gap` (m) below a vertex, carried along a little.
std::array<double, PLAIT_LANE_PLANE_COMPONENTS> plane_under(const LaneHair& lanes, Random& random,
                                                            size_t row, double gap, double moves,
                                                            float friction) {
    const size_t root = row / lanes.hair.size.stride * lanes.hair.size.stride;
    const Point normal = direction_of(sum({-20, 40, -30}, random_step(random, 20)));
    const Point carried = random_step(random, moves);
    Point anchor{}; // x_before has the root where the pose puts it
    for (size_t k = 0; k < 3; ++k)
        anchor[k] = double(lanes.x[3 * root + k]) - double(lanes.x_before[3 * root + k]) +
                    double(lanes.x[3 * row + k]) + carried[k];
    return {normal[0], normal[1], normal[2],        anchor[0],       anchor[1],
            anchor[2], gap,       gap + moves / 20, double(friction)};
}

Setup on_planes(Setup setup, const LaneHair& lanes, float friction, bool bends, bool pressed) {
    auto params = setup.params_as<plait_lane_params>();
    params.planes = 1;
    setup.name += pressed ? ", pressed to planes" : ", on planes";
    Random random(params.vertex_stride + 7);
    std::vector<float>& planes = setup.buffers[bends ? 8 : 7].floats;
    for (size_t s = 0; s < setup.items; ++s) {
        size_t last = 0;
        for (size_t i = 2; i < lanes.hair.vertex_count[s]; i += 3) {
            const size_t row = s * setup.width + i;
            const auto plane = plane_under(
                lanes, random, row,
                pressed ? (s % 3 == 2 ? -1.5e-4 : 1e-4) : (s % 3 == 2 ? -0.015 : 0.004),
                pressed ? 0.002 : 0.02,
                friction_for(setup.buffers[3].floats, s, setup.width, s % 2 ? friction : 0.3f));
            std::ranges::transform(plane, &planes[PLAIT_LANE_PLANE_COMPONENTS * row],
                                   [](double value) { return static_cast<float>(value); });
            last = i;
        }
        const auto row = planes.begin() +
                         static_cast<std::ptrdiff_t>(PLAIT_LANE_PLANE_COMPONENTS * s * setup.width);
        row[PLAIT_LANE_PLANE_LAST] = static_cast<float>(last);
        if (last + 1 == lanes.hair.vertex_count[s]) { // a tip, with a wall across a crease
            const Point normal = direction_of(sum({30, 20, -30}, random_step(random, 20)));
            for (size_t k = 0; k < 3; ++k)
                row[static_cast<std::ptrdiff_t>(PLAIT_LANE_PLANE_CREASE + k)] =
                    static_cast<float>(normal[k]);
            row[PLAIT_LANE_PLANE_CREASE + 3] = static_cast<float>(random.uniform(0.0, 0.004));
        }
        // what is left in rows that nobody reads: a plane far above
        std::fill(row + static_cast<std::ptrdiff_t>(PLAIT_LANE_PLANE_COMPONENTS * (last + 1)),
                  row + static_cast<std::ptrdiff_t>(PLAIT_LANE_PLANE_COMPONENTS * setup.width),
                  -0.5f);
    }
    return setup.with(params);
}

// Sheets: where there is a plane more of them around it, across the way of forces in a hollow; else room.
Setup in_hollows(Setup setup, const LaneHair& lanes) {
    auto params = setup.params_as<plait_lane_params>();
    params.hollows = 1;
    setup.name += ", in hollows";
    Random random(params.vertex_stride + 8);
    std::vector<float>& hollows = setup.buffers.back().floats;
    const std::vector<float>& planes = setup.buffers[8].floats;
    for (size_t s = 0; s < setup.items; ++s)
        for (size_t i = 1; i < lanes.hair.vertex_count[s]; ++i) {
            const size_t row = s * setup.width + i;
            const float* plane = &planes[PLAIT_LANE_PLANE_COMPONENTS * row];
            std::vector<double> values;
            if (i % 3 == 2 && i % 2 == 0) {
                values = {double(PLAIT_HOLLOW_PLANES)};
                for (int k = 0; k < PLAIT_LANE_HOLLOW_PLANES; ++k) {
                    const Point normal = direction_of(sum({-20, 40, -30}, random_step(random, 40)));
                    const double some = size_t(k) == i / 6 % 6 ? 0 : 1;
                    values.insert(
                        values.end(),
                        {some * normal[0], some * normal[1], some * normal[2],
                         double(plane[PLAIT_LANE_PLANE_HEIGHT]) + random.uniform(-0.004, 0.008)});
                }
            } else if (i % 3 == 1) {
                const Point off = random_step(random, 0.004);
                const size_t root = s * setup.width;
                values = {double(PLAIT_HOLLOW_ROOM)};
                for (size_t k = 0; k < 3; ++k)
                    values.push_back(double(lanes.x[3 * root + k]) -
                                     double(lanes.x_before[3 * root + k]) +
                                     double(lanes.x[3 * row + k]) + off[k]);
                values.push_back(random.uniform(0.003, 0.01));
            }
            std::ranges::transform(values, &hollows[PLAIT_LANE_HOLLOW_COMPONENTS * row],
                                   [](double value) { return static_cast<float>(value); });
        }
    return setup.with(params);
}

void add_rods_on_planes(Case& result) {
    for (const Size& size : contact_sizes())
        for (const uint32_t bdf2 : {0u, 1u}) {
            const LaneHair lanes = make_lane_hair(size, 33);
            result.setups.push_back(on_planes(
                lane_setup(size, lanes, lane_params(size, 1, bdf2), true), lanes, 100.0f, true));
            result.setups.push_back(in_hollows(result.setups.back(), lanes));
            const LaneHair calm = make_lane_hair_calm(size, 44);
            result.setups.push_back(on_planes(
                lane_setup(size, calm, lane_params(size, 1, bdf2), true), calm, 1.0f, true, true));
        }
}

// The planes are those of other strands.
Setup among_strands(Setup setup) {
    auto params = setup.params_as<plait_lane_params>();
    params.planes = 2;
    setup.name += " of strands";
    return setup.with(params);
}

void add_rods_among_strands(Case& result) {
    for (const Size& size : contact_sizes()) {
        const auto params = lane_params(size, 1, 0);
        const LaneHair lanes = make_lane_hair(size, 32), calm = make_lane_hair_calm(size, 44);
        result.setups.push_back(
            among_strands(on_planes(lane_setup(size, lanes, params, true), lanes, 100.0f, true)));
        result.setups.push_back(
            among_strands(on_planes(lane_setup(size, calm, params, true), calm, 1.0f, true, true)));
    }
}

void add_pinned(Case& result, bool bends) {
    const auto add = [&](const Size& size, const LaneHair& lanes, uint32_t bdf2) {
        result.setups.push_back(
            pinned(lane_setup(size, lanes, lane_params(size, 1, bdf2), bends), lanes, bends));
    };
    for (const Size& size : sizes())
        for (const uint32_t bdf2 : {0u, 1u})
            add(size, make_lane_hair(size, 32), bdf2);
    for (const Size& size : contact_sizes())
        add(size, make_lane_hair_spun(size, 32), 1);
}

} // namespace plait::cases
