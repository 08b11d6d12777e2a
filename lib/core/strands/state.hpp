// The buffers every model shares, and what a model sees of the sim while it builds a schedule.
#pragma once

#include "backend/device.hpp"
#include "core/base/layout.hpp"

#include <array>
#include <memory_resource>
#include <span>
#include <vector>

namespace plait {

struct Groom;

struct State {
    // Constant after creation.
    Buffer rest;         // float4 [guides*V]
    Buffer vertex_count; // uint [strands]
    Buffer rest_length;  // float [guides*V], edge i -> i+1
    // Moving.
    Buffer position;       // float4 [guides*V], or [strands*V] where follows are placed in it
    Buffer position_prev;  // float4 [guides*V]
    Buffer position_prev2; // float4 [guides*V]; only where the model keeps two steps
    Buffer pose;           // float4 [2*guides], of the last substep
    // From without.
    Buffer acceleration; // float4 [guides*V], m/s^2; only with the feature of this name
    // Only where vertices are pinned, see pins.hpp. float4 [guides*V]: target and stiffness, as in stages.def.
    Buffer pin;              // as the caller wants it at the end of the next call
    Buffer pin_at;           // at the end of the call before
    Buffer pin_from, pin_to; // at begin and end of the last fixed step
    // Only where hair is wet, see wetness.hpp. float [guides]
    Buffer wetness;       // now
    Buffer wetness_given; // as the caller wrote it
    Buffer wetness_held;  // that material is scaled by

    std::array<const Buffer*, 15> all() const {
        return {&rest,           &vertex_count, &rest_length,  &position,      &position_prev,
                &position_prev2, &pose,         &acceleration, &pin,           &pin_at,
                &pin_from,       &pin_to,       &wetness,      &wetness_given, &wetness_held};
    }
};

// What of it a sim needs.
struct StateNeeds {
    uint32_t position_rows;
    uint32_t pinned; // vertices from the root on, of inverse mass 0; that of others is 1
    bool two_steps;
    std::span<const uint32_t> follow_counts; // vertices of strands of their own; else empty
};

// Creates and fills the state with `groom` at rest, its roots at the identity.
Result<State> create_state(Device& device, const Groom& groom, const Layout& layout,
                           const StateNeeds& needs, std::pmr::memory_resource* memory);

// The groom's vertices as rows of V, padding a copy of the tip; the first `pinned` of a strand have
// inverse mass 0, others 1. `positions`: xyz of all strands, one after the other.
std::pmr::vector<std::array<float, 4>> pad_rows(std::span<const float> positions,
                                                std::span<const uint32_t> vertex_counts,
                                                uint32_t row, uint32_t pinned,
                                                std::pmr::memory_resource* memory);

// float4 [guides*V] of zeros. Waits.
Status make_rows(Device& device, const Layout& layout, Buffer& to, const char* name,
                 std::pmr::memory_resource* memory);

} // namespace plait
