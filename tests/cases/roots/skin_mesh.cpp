#include "roots/skin_inputs.hpp"

#include <cmath>

namespace plait::cases {
namespace {

constexpr uint32_t triangles = 30;

struct Posed {
    std::vector<float> rest, at; // float4
};

void append(std::vector<float>& to, const Point& p) {
    for (const double c : p)
        to.push_back(static_cast<float>(c));
    to.push_back(0);
}

// Triangles of some centimetres; each is stretched, sheared, turned, and moved by up to a metre. Their
// stretch is uneven, so that no other rotation is as close.
Posed posed(Random& random) {
    Posed mesh;
    for (uint32_t i = 0; i < triangles; ++i) {
        Point middle, moved;
        for (size_t k = 0; k < 3; ++k) {
            middle[k] = random.uniform(-0.3, 0.3);
            moved[k] = random.uniform(-1, 1);
        }
        const auto lies = random.rotation(), turn = random.rotation();
        for (int corner = 0; corner < 3; ++corner) {
            const double angle = 2.1 * corner, size = random.uniform(0.03, 0.1);
            const double x = size * std::cos(angle), y = size * std::sin(angle);
            const Point then = rotate(lies, {x, y, 0});
            const Point now = rotate(turn, rotate(lies, {1.3 * x + 0.2 * y, 0.8 * y, 0}));
            append(mesh.rest, {middle[0] + then[0], middle[1] + then[1], middle[2] + then[2]});
            append(mesh.at, {moved[0] + now[0], moved[1] + now[1], moved[2] + now[2]});
        }
    }
    return mesh;
}

Setup make(const Size& size) {
    Random random(size.strands);
    Hair hair = make_hair(size, 12);
    for (float& x : hair.rest) // so far that the triangles' stretch of a root shows
        x = static_cast<float>(random.uniform(-0.3, 0.3));
    const Posed mesh = posed(random);
    std::vector<uint32_t> corners;
    for (uint32_t strand = 0; strand < size.strands; ++strand) {
        const uint32_t triangle = random.below(triangles), first = random.below(3);
        for (uint32_t k = 0; k < 3; ++k) // any corner may be the first
            corners.push_back(3 * triangle + (first + k) % 3);
    }
    Setup setup;
    setup.name = name_of(size);
    setup.items = size.strands;
    setup.buffers = {uints(corners), float4s(mesh.rest), float4s(mesh.at), float4s(hair.rest),
                     unwritten_float4s(size_t{2} * size.strands)};
    return setup.with(plait_layout_params{size.stride});
}

} // namespace

Case skin_mesh_case() {
    Case result = {PLAIT_STAGE_skin_mesh, {}, {}, {"rest.w"}, {{"pose", compare_poses}}};
    for (const Size& size : sizes())
        result.setups.push_back(make(size));
    return result;
}

} // namespace plait::cases
