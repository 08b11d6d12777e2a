#include "render.hpp"
#include "geometry.hpp"
#include "random.hpp"
#include "shade.hpp"

#include <algorithm>
#include <atomic>
#include <future>
#include <stdexcept>
#include <thread>

namespace render {

using Eigen::Vector3f;

namespace {

constexpr int tile = 32; // pixels

// Rays through the picture, in camera axes.
struct Lens {
    Vector3f eye, corner, step_x, step_y; // corner: direction of the picture's top left

    Lens(const Camera& camera, const Frame& frame) : eye(camera.eye) {
        const Vector3f forward = (camera.target - camera.eye).normalized();
        const Vector3f right = forward.cross(camera.up).normalized(), up = right.cross(forward);
        const float half =
            std::tan(0.5f * camera.field_of_view * static_cast<float>(EIGEN_PI) / 180.0f);
        const float aspect = static_cast<float>(frame.width) / static_cast<float>(frame.height);
        step_x = 2.0f * half * aspect / static_cast<float>(frame.width) * right;
        step_y = -2.0f * half / static_cast<float>(frame.height) * up;
        corner = forward - half * aspect * right + half * up;
    }

    Vector3f direction(float x, float y) const {
        return (corner + x * step_x + y * step_y).normalized();
    }
};

// Everything a tile needs.
struct Job {
    const Geometry& geometry;
    Look look; // lights in the world
    const Frame& frame;
    Lens lens;
    int grid; // samples per pixel = grid^2
    Image& image;
};

// Lights hang on the camera, so that the hair is legible from every side.
Look lit_from(const Camera& camera, Look look) {
    const Vector3f back = (camera.eye - camera.target).normalized();
    const Vector3f right = camera.up.cross(back).normalized();
    Eigen::Matrix3f axes;
    axes << right, back.cross(right), back;
    for (Light* light : {&look.key, &look.rim})
        light->towards = axes * light->towards;
    return look;
}

uint8_t to_srgb(float linear) {
    const float x = std::clamp(linear, 0.0f, 1.0f);
    const float encoded = x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1.0f / 2.4f) - 0.055f;
    return static_cast<uint8_t>(std::lround(255.0f * encoded));
}

// Linear to 0.6, then a shoulder that reaches white at infinity.
float tone(float x) {
    return x < 0.6f ? x : 1.0f - 0.4f * std::exp(-(x - 0.6f) / 0.4f);
}

Vector3f background(const Look& look, float x, float y) {
    const float dx = x - 0.5f, dy = y - 0.5f;
    const Vector3f colour =
        look.background_top + y * (look.background_bottom - look.background_top);
    return colour * (1.0f - 0.35f * (dx * dx + dy * dy));
}

// Component `axis` of a pixel's sample: Roberts' R4 sequence fills the unit cube evenly, turned by
// a random amount per pixel so that neighbours do not repeat one pattern.
float spread(uint32_t pixel, int sample, uint32_t axis) {
    constexpr std::array<float, 4> step{0.856674884f, 0.733891857f, 0.628706721f, 0.538597259f};
    const float x = uniform(pixel, axis) + static_cast<float>(sample) * step[axis];
    return x - std::floor(x);
}

Vector3f sample_pixel(const Job& job, int x, int y, int sample) {
    const uint32_t pixel = static_cast<uint32_t>(y) * job.frame.width + x;
    const auto draw = [&](uint32_t stream) { return spread(pixel, sample, stream); };
    const float cell = 1.0f / static_cast<float>(job.grid);
    const auto column = sample % job.grid, line = sample / job.grid;
    const float px = static_cast<float>(x) +
                     (static_cast<float>(column) + uniform(pixel, 2u * sample + 101u)) * cell;
    const float py = static_cast<float>(y) +
                     (static_cast<float>(line) + uniform(pixel, 2u * sample + 102u)) * cell;
    const Vector3f direction = job.lens.direction(px, py);
    const Surfel surfel = job.geometry.trace(job.lens.eye, direction);
    if (surfel.material == Material::nothing)
        return background(job.look, px / static_cast<float>(job.frame.width),
                          py / static_cast<float>(job.frame.height));
    return shade(job.geometry, surfel, -direction, job.look, {draw(0), draw(1), draw(2), draw(3)})
        .unaryExpr(&tone);
}

// Tone mapping comes before averaging, so that one bright glint does not leave a jagged edge.
void draw_pixel(const Job& job, int x, int y) {
    Vector3f sum = Vector3f::Zero();
    const int samples = job.grid * job.grid;
    for (int sample = 0; sample < samples; ++sample)
        sum += sample_pixel(job, x, y, sample);
    for (int channel = 0; channel < 3; ++channel)
        job.image.pixel(x, y)[channel] = to_srgb(sum[channel] / static_cast<float>(samples));
}

void draw_tile(const Job& job, int index) {
    const int columns = (job.frame.width + tile - 1) / tile;
    const int left = index % columns * tile, top = index / columns * tile;
    for (int y = top; y < std::min(top + tile, job.frame.height); ++y)
        for (int x = left; x < std::min(left + tile, job.frame.width); ++x)
            draw_pixel(job, x, y);
}

void draw_tiles(const Job& job) {
    const int columns = (job.frame.width + tile - 1) / tile;
    const int tiles = columns * ((job.frame.height + tile - 1) / tile);
    std::atomic<int> next{0};
    const auto work = [&] {
        for (int index = next++; index < tiles; index = next++)
            draw_tile(job, index);
    };
    const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
    std::vector<std::future<void>> helpers; // waited for at the end, however it comes
    for (unsigned i = 1; i < (job.frame.threads ? job.frame.threads : cores); ++i)
        helpers.push_back(std::async(std::launch::async, work));
    work();
}

} // namespace

float default_width(size_t strands) {
    const float share = 1e4f / static_cast<float>(std::max<size_t>(strands, 1));
    return std::clamp(6.5e-4f * std::sqrt(share), 1.5e-4f, 3e-3f);
}

struct Renderer::Device {
    RTCDevice handle = rtcNewDevice(nullptr);
    ~Device() { rtcReleaseDevice(handle); }
};

Renderer::Renderer() : device_(std::make_unique<Device>()) {
    if (!device_->handle)
        throw std::runtime_error("Embree does not start on this machine");
}

Renderer::~Renderer() = default;

Image Renderer::draw(const Hair& hair, const Mesh& mesh, const Camera& camera, const Look& look,
                     const Frame& frame) {
    const Geometry geometry(device_->handle, hair, mesh);
    Image image(frame.width, frame.height);
    const int grid =
        std::max(1, static_cast<int>(std::ceil(std::sqrt(static_cast<float>(frame.samples)))));
    draw_tiles({geometry, lit_from(camera, look), frame, Lens(camera, frame), grid, image});
    return image;
}

} // namespace render
