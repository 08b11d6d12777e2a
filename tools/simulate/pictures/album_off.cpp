// Stands in for album.cpp in a build without pictures.
#include "album.hpp"

namespace simulate {

struct Album::State {};

std::string Album::why_not() {
    return "this plait-simulate was built without pictures: it needs Embree, cairo and Eigen "
           "(Debian: libembree-dev libcairo2-dev libeigen3-dev), then configure again";
}

Album::Album(const Scene&, const Figure&, std::vector<Variant>) {}
Album::~Album() = default;
bool Album::wants(uint32_t) const {
    return false;
}
void Album::take(const Shot&) {}
bool Album::wants_beside(uint32_t) const {
    return false;
}
void Album::take_beside(size_t, const Shot&) {}
std::vector<std::string> Album::finish() {
    return {};
}

} // namespace simulate
