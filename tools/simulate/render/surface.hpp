// Cairo's surfaces, owned, and pictures put on them.
#pragma once

#include "image.hpp"

#include <cairo.h>

#include <memory>

namespace render {

struct SurfaceRelease {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
struct ContextRelease {
    void operator()(cairo_t* context) const { cairo_destroy(context); }
};
using Surface = std::unique_ptr<cairo_surface_t, SurfaceRelease>;
using Context = std::unique_ptr<cairo_t, ContextRelease>;

Surface to_surface(const Image& image);
Image to_image(const Surface& surface);
void write_png(const Surface& surface, const std::string& path);

} // namespace render
