#include "common.hpp"

namespace lab {

// Not in the header: what it instantiates for opposite directions takes the compiler seconds.
Quat turn_between(const Vec3& from, const Vec3& to) {
    return Quat::FromTwoVectors(from, to);
}

} // namespace lab
