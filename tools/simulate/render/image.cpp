#include "image.hpp"
#include "surface.hpp"

#include <filesystem>
#include <stdexcept>

namespace render {

namespace {

// Cairo keeps RGB24 as native-endian 0x00RRGGBB, rows padded to its own stride.
uint32_t pack(const uint8_t* rgb) {
    return static_cast<uint32_t>(rgb[0]) << 16 | static_cast<uint32_t>(rgb[1]) << 8 | rgb[2];
}

uint32_t* row_of(cairo_surface_t* surface, int y) {
    unsigned char* data = cairo_image_surface_get_data(surface);
    return reinterpret_cast<uint32_t*>(data + static_cast<ptrdiff_t>(y) *
                                                  cairo_image_surface_get_stride(surface));
}

void check(cairo_status_t status, const std::string& path) {
    if (status != CAIRO_STATUS_SUCCESS)
        throw std::runtime_error(path + ": " + cairo_status_to_string(status));
}

} // namespace

Surface to_surface(const Image& image) {
    Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, image.width, image.height));
    check(cairo_surface_status(surface.get()), "picture");
    for (int y = 0; y < image.height; ++y) {
        uint32_t* row = row_of(surface.get(), y);
        for (int x = 0; x < image.width; ++x)
            row[x] = pack(image.pixel(x, y));
    }
    cairo_surface_mark_dirty(surface.get());
    return surface;
}

// Beside its place, then renamed: a picture is whole or not there.
void write_png(const Surface& surface, const std::string& path) {
    const std::string partial = path + ".part";
    const cairo_status_t status = cairo_surface_write_to_png(surface.get(), partial.c_str());
    std::error_code error;
    if (status == CAIRO_STATUS_SUCCESS)
        std::filesystem::rename(partial, path, error);
    else
        std::filesystem::remove(partial, error);
    check(status, path);
    if (error)
        throw std::runtime_error(path + ": " + error.message());
}

void write_png(const Image& image, const std::string& path) {
    write_png(to_surface(image), path);
}

Image to_image(const Surface& surface) {
    cairo_surface_flush(surface.get());
    Image image(cairo_image_surface_get_width(surface.get()),
                cairo_image_surface_get_height(surface.get()));
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int channel = 0; channel < 3; ++channel)
                image.pixel(x, y)[channel] =
                    static_cast<uint8_t>(row_of(surface.get(), y)[x] >> (16 - 8 * channel));
    return image;
}

Image read_png(const std::string& path) {
    Surface surface(cairo_image_surface_create_from_png(path.c_str()));
    check(cairo_surface_status(surface.get()), path);
    return to_image(surface);
}

} // namespace render
