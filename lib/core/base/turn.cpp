#include "core/base/turn.hpp"

namespace plait {

// Not in the header: what it instantiates for opposite directions takes a compiler ten seconds.
Eigen::Quaterniond turn(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    return Eigen::Quaterniond::FromTwoVectors(from, to);
}

} // namespace plait
