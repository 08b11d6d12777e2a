#include "core/tressfx/wind_cone.hpp"

#include "core/base/turn.hpp"

namespace plait {

// TressFX 3.1 blends four winds per strand: the x axis turned by the angle about +y, -y, +z, -z,
// then by the turn that takes the x axis to the wind's direction, times its speed. The published
// angle is 40 degrees and the speed pulsates with the frame number; ours is steady.
void wind_cone(const float wind[3], float angle, float corner[16]) {
    const Eigen::Vector3d direction(wind[0], wind[1], wind[2]);
    const Eigen::Matrix3d towards = turn(Eigen::Vector3d::UnitX(), direction).matrix();
    const Eigen::Vector3d axes[4] = {Eigen::Vector3d::UnitY(), -Eigen::Vector3d::UnitY(),
                                     Eigen::Vector3d::UnitZ(), -Eigen::Vector3d::UnitZ()};
    for (size_t i = 0; i < 4; ++i) {
        const Eigen::Matrix3d lean = Eigen::AngleAxisd(angle, axes[i]).matrix();
        const Eigen::Vector3d turned = towards * lean.col(0) * direction.norm();
        Eigen::Map<Eigen::Vector3f>(corner + 4 * i) = turned.cast<float>();
        corner[4 * i + 3] = 0;
    }
}

} // namespace plait
