// The capsules inscribed in the mannequin, half a millimetre below its surface.
#include "generator.hpp"

namespace plait_generator {
namespace {

// In the order: vault, occiput, face, neck.
constexpr Capsule middle[] = {
    {{0, 0.050f, -0.028f}, {0, 0.050f, 0.012f}, 0.0690f, 0.0726f, true},
    {{0, 0.012f, -0.045f}, {0, 0.010f, 0.010f}, 0.0639f, 0.0733f, true},
    {{0, -0.020f, 0.030f}, {0, -0.068f, 0.044f}, 0.0604f, 0.0360f, true},
    {{0, -0.060f, -0.018f}, {0, -0.200f, -0.036f}, 0.0408f, 0.0536f, false},
};

// Base of the skull, jaw, trapezius, shoulder, chest.
constexpr Capsule right[] = {
    {{0.022f, -0.030f, -0.030f}, {0.022f, 0.005f, -0.040f}, 0.0319f, 0.0447f, true},
    {{0.035f, -0.045f, 0.012f}, {0.008f, -0.088f, 0.060f}, 0.0329f, 0.0200f, true},
    {{0.030f, -0.195f, -0.045f}, {0.125f, -0.238f, -0.048f}, 0.0503f, 0.0424f, false},
    {{0.050f, -0.265f, -0.045f}, {0.137f, -0.268f, -0.045f}, 0.0762f, 0.0449f, false},
    {{0, -0.315f, -0.040f}, {0.065f, -0.335f, -0.042f}, 0.0919f, 0.0795f, false},
};

} // namespace

std::vector<Capsule> head_colliders() {
    std::vector<Capsule> all(std::begin(middle), std::end(middle));
    for (const Capsule& capsule : right) {
        Capsule left = capsule;
        left.a[0] = -left.a[0];
        left.b[0] = -left.b[0];
        all.push_back(capsule);
        all.push_back(left);
    }
    return all;
}

} // namespace plait_generator
