#include "grid/solid_inputs.hpp"

#include <cmath>

namespace plait::cases {

void add_solid_row(std::vector<float>& rows, Random& random, std::array<double, 2> shares) {
    const auto place = [&](double share) {
        append_floats(rows, {random.uniform(-0.03, 0.03), random.uniform(-0.03, 0.03),
                             random.uniform(-0.03, 0.03), share});
    };
    const auto orientation = random.rotation();
    const auto axis = random.direction();
    const double half = random.uniform(0.03, 0.08);
    place(shares[0]);
    append_floats(rows, {orientation[0], orientation[1], orientation[2], orientation[3]});
    place(shares[1]);
    append_floats(rows, {0, 0, 0, 0});
    append_floats(rows, {axis[0] * std::sin(half), axis[1] * std::sin(half),
                         axis[2] * std::sin(half), std::cos(half)});
    append_floats(rows, {0.5, double{PLAIT_KIND_MESH}, 0, 0});
}

std::vector<std::string> solid_unread() {
    return {"collider.end.b", "collider.end.b.radius", "collider.friction", "collider.kind"};
}

} // namespace plait::cases
