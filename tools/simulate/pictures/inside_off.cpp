// Stands in for inside.cpp in a build without Embree.
#include "inside.hpp"

namespace simulate {

struct Inside::State {};

Inside::Inside(const Scene&, const Figure&) {}
Inside::~Inside() = default;
bool Inside::wants(uint32_t) const {
    return false;
}
void Inside::take(const Shot&) {}
InsideReport Inside::finish() {
    return {};
}

} // namespace simulate
