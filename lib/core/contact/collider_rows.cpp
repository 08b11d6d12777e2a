// Colliders as rows on the device: where each is in every substep of a fixed step, and the faces of hulls.
#include "core/contact/colliders.hpp"

#include "base/format.hpp"

#include <plait/params.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

namespace plait {
namespace {

constexpr size_t collider_floats = size_t{4} * PLAIT_COLLIDER_STRIDE;

// m: a vertex in a sharp edge of a box from inside belongs to one face and the other in turn, and never rests.
constexpr float least_rounding = 2e-3f;

void round_edges(Colliders::Slot& slot) {
    const float least = *std::min_element(slot.half_extents, slot.half_extents + 3);
    const float more = std::clamp(least_rounding - slot.rounding, 0.0f, least / 4);
    std::for_each(slot.half_extents, slot.half_extents + 3, [&](float& x) { x -= more; });
    slot.rounding += more;
}

// Its shape, `size` times as large.
Colliders::Slot resized(Colliders::Slot slot, float size) {
    if (slot.kind == PLAIT_COLLIDER_KIND_BOX && Colliders::is_inward(slot))
        round_edges(slot);
    for (float* vector : {slot.a, slot.b, slot.half_extents})
        std::for_each(vector, vector + 3, [&](float& x) { x *= size; });
    for (float* length : {&slot.radius_a, &slot.radius_b, &slot.rounding})
        *length *= size;
    return slot;
}

void pack_capsule(const Colliders::Slot& slot, const plait_pose& pose, float* out) {
    transform(pose, slot.a, out);
    out[3] = slot.radius_a;
    transform(pose, slot.b, out + 4);
    out[7] = slot.radius_b;
}

void pack_plane(const Colliders::Slot& slot, const plait_pose& pose, float* out) {
    transform(pose, slot.a, out);
    const double x = double(slot.normal[0]), y = double(slot.normal[1]), z = double(slot.normal[2]);
    const double length = std::hypot(x, y, z);
    const float unit[3] = {static_cast<float>(x / length), static_cast<float>(y / length),
                           static_cast<float>(z / length)};
    plait_pose turned = pose;
    std::fill_n(turned.t, 3, 0.0f);
    transform(turned, unit, out + 4);
    out[3] = out[7] = 0;
}

// Its orientation lies where a capsule has its other end at the substep's begin.
void pack_box(const Colliders::Slot& slot, const plait_pose& begin, const plait_pose& end,
              float* out) {
    float* const now = out + size_t{4} * PLAIT_COLLIDER_END;
    transform(begin, slot.a, out);
    transform(end, slot.a, now);
    out[3] = now[3] = slot.rounding;
    plait_pose own = identity_pose;
    std::copy_n(slot.orientation, 4, own.q);
    rotation_product(end, own, out + 4);
    std::copy_n(slot.half_extents, 3, now + 4);
    now[7] = 0;
}

// All of it is in the box; faces are behind the rows.
void pack_hull(const Colliders::Slot& slot, const plait_pose& begin, const plait_pose& end,
               float* out) {
    pack_box(slot, begin, end, out);
    float* const half_extents = out + size_t{4} * (PLAIT_COLLIDER_END + 1);
    for (size_t k = 0; k < 3; ++k)
        half_extents[k] += slot.rounding;
    if (Colliders::is_inward(slot)) // its faces come in
        out[3] = out[size_t{4} * PLAIT_COLLIDER_END + 3] = -slot.rounding;
}

// A box of no size about its origin, and which part of the step the substep is.
void pack_mesh(const Colliders::Slot& slot, const plait_pose& begin, const plait_pose& end,
               std::array<float, 2> shares, float* out) {
    pack_box(slot, begin, end, out);
    out[3] = shares[0];
    out[size_t{4} * PLAIT_COLLIDER_END + 3] = shares[1];
}

// The path from `begin` to `end`; returns where the next collider goes.
float* pack(const Colliders::Slot& slot, const plait_pose& begin, const plait_pose& end,
            std::array<float, 2> shares, float* out) {
    float* const now = out + size_t{4} * PLAIT_COLLIDER_END;
    switch (static_cast<plait_collider_kind>(slot.kind)) {
    case PLAIT_COLLIDER_KIND_PLANE:
        pack_plane(slot, begin, out);
        pack_plane(slot, end, now);
        break;
    case PLAIT_COLLIDER_KIND_BOX:
        pack_box(slot, begin, end, out);
        break;
    case PLAIT_COLLIDER_KIND_HULL:
        pack_hull(slot, begin, end, out);
        break;
    case PLAIT_COLLIDER_KIND_MESH:
        pack_mesh(slot, begin, end, shares, out);
        break;
    default:
        pack_capsule(slot, begin, out);
        pack_capsule(slot, end, now);
    }
    turn(begin, end, out + size_t{4} * PLAIT_COLLIDER_TURN);
    float* const last = out + size_t{4} * PLAIT_COLLIDER_FRICTION;
    std::fill_n(last, 4, 0.0f);
    last[0] = slot.friction;
    last[1] =
        static_cast<float>(slot.kind) + (Colliders::is_inward(slot) ? PLAIT_KIND_INWARD : 0.0f);
    return out + collider_floats;
}

// Which rows come first in a substep.
int order_of(const Colliders::Slot& slot) {
    return Colliders::is_mesh(slot) + Colliders::bends(slot);
}

} // namespace

size_t Colliders::rows(size_t count) const {
    return count * std::accumulate(substeps_.begin(), substeps_.end(), size_t{0});
}

// Room for the paths of `count` colliders on the device and for faces of hulls; doubles, so that adding
// many is cheap. Rows say as floats how far from them faces are.
Status Colliders::reserve(Device& device, size_t count, size_t faces) {
    constexpr size_t farthest = size_t{1} << 24;
    const size_t need = rows(count) * PLAIT_COLLIDER_STRIDE + faces;
    if (faces > 0 && need > farthest)
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("%zu colliders in all substeps of a step take %zu rows; with hulls %zu "
                            "are the most",
                            count, rows(count), (farthest - faces) / PLAIT_COLLIDER_STRIDE)};
    if (buffer_.count() >= need)
        return {};
    const size_t room = std::max(need, buffer_.count() * 2);
    packed_.reserve(room * 4);
    PLAIT_TRY(device.create(buffer_, PLAIT_ELEMENT_FLOAT4, room, "collider"));
    uploaded_ = false;
    return {};
}

plait_pose Colliders::on_path(const Slot& slot, double share) const {
    return bends_ ? on_parabola(slot.before, slot.from, slot.to, share)
                  : interpolate(slot.from, slot.to, share);
}

Status Colliders::upload(Device& device) {
    if (uploaded_ || count_ == 0)
        return {};
    packed_.resize(rows(count_) * collider_floats + 4 * face_count_);
    float* out = packed_.data();
    const auto pack_all = [&](double first, double last) { // shares of the step
        for (const int order : {0, 1, 2})
            for (const Slot& slot : slots_)
                if (slot.alive && order_of(slot) == order)
                    out = pack(resized(slot, size(slot)), on_path(slot, first), on_path(slot, last),
                               {static_cast<float>(first), static_cast<float>(last)}, out);
    };
    for (const uint32_t substeps : substeps_)
        for (uint32_t i = 0; i < substeps; ++i) // as the roots go
            pack_all(double(i) / substeps, double(i + 1) / substeps);
    pack_faces(packed_, rows(count_));
    PLAIT_TRY(device.upload(buffer_, 0, packed_.size() / 4, packed_.data()));
    uploaded_ = true;
    return {};
}

// Meshes that bend are as at the step's end.
Status Colliders::show(Device& device) {
    if (count_ == 0)
        return {};
    packed_.resize(count_ * collider_floats + 4 * face_count_);
    float* out = packed_.data();
    for (const int order : {0, 1, 2})
        for (const Slot& slot : slots_)
            if (slot.alive && order_of(slot) == order)
                out = pack(resized(slot, size(slot)), slot.at, slot.at, {0, 1}, out);
    pack_faces(packed_, count_);
    const size_t need = packed_.size() / 4;
    if (shown_.count() < need) {
        packed_shown_.clear();
        PLAIT_TRY(device.create(shown_, PLAIT_ELEMENT_FLOAT4, std::max(need, 2 * shown_.count()),
                                "collider_shown"));
    }
    const auto same = [](float a, float b) {
        return std::bit_cast<uint32_t>(a) == std::bit_cast<uint32_t>(b);
    };
    if (std::ranges::equal(packed_, packed_shown_, same))
        return {};
    packed_shown_.clear(); // an upload that fails may have left anything
    PLAIT_TRY(device.upload(shown_, 0, need, packed_.data()));
    packed_shown_ = packed_;
    return {};
}

// Behind all rows, which are told where their own lie.
void Colliders::pack_faces(std::span<float> packed, size_t rows) const {
    float* out = packed.data() + rows * collider_floats;
    const size_t per_substep = count_;
    size_t row = 0; // of the first substep
    for (const int order : {0, 1, 2})
        for (size_t i = 0; i < slots_.size(); ++i) {
            if (!slots_[i].alive || order_of(slots_[i]) != order)
                continue;
            for (size_t at = row; at < rows && is_hull(slots_[i]); at += per_substep) {
                float* const first = packed.data() + at * collider_floats;
                float* const last = first + size_t{4} * PLAIT_COLLIDER_FRICTION;
                last[2] = static_cast<float>((out - first) / 4);
                last[3] = static_cast<float>(faces_[i].size());
            }
            for (HullFace face : faces_[i]) {
                face[3] *= size(slots_[i]);
                out = std::ranges::copy(face, out).out;
            }
            ++row;
        }
}

} // namespace plait
