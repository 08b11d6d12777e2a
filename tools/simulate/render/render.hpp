// Pictures of hair: strands as curves over a triangle mesh, traced with Embree on the CPU.
//
// Light: a key light and a rim light whose shadows count the hairs in between, and a sky sampled by
// one short ray per sample. The same input gives the same picture on any number of threads.
#pragma once

#include "image.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace render {

// Strands as plait_sim_read gives them: rows of `row` vertices (x, y, z, anything), metres.
struct Hair {
    std::span<const float> positions;       // [strands][row][4]
    std::span<const uint32_t> vertex_count; // [strands], <= row
    uint32_t row = 0;
    float width = 0.0f; // of a hair at the root as drawn, m; 0: default_width(strands)
};

// Width at which so few strands still read as a full head, m: real hair is 70 um, 100,000 strong.
float default_width(size_t strands);

struct Mesh {
    std::vector<Eigen::Vector3f> vertices; // m
    std::vector<std::array<uint32_t, 3>> triangles;
    std::vector<float> scalp; // [vertices]: share of the hair's root colour in the skin's; or none
};

// A pinhole.
struct Camera {
    Eigen::Vector3f eye{0.0f, 0.0f, 1.0f};
    Eigen::Vector3f target = Eigen::Vector3f::Zero();
    Eigen::Vector3f up = Eigen::Vector3f::UnitY();
    float field_of_view = 30.0f; // vertical, degrees
};

struct Light {
    Eigen::Vector3f towards; // unit, from the scene to the light, in camera axes: right, up, back
    Eigen::Vector3f colour;  // irradiance, linear
};

// Colours are linear RGB.
struct Look {
    Eigen::Vector3f hair_root{0.046f, 0.022f, 0.011f};
    Eigen::Vector3f hair_tip{0.092f, 0.046f, 0.023f};
    float colour_variation = 0.25f; // of a strand's brightness, +-
    float highlight = 0.13f;        // angular width of the first highlight, radians
    Eigen::Vector3f skin{0.44f, 0.37f, 0.33f};
    Light key{Eigen::Vector3f(-0.55f, 0.80f, 0.55f).normalized(), {2.7f, 2.55f, 2.35f}};
    Light rim{Eigen::Vector3f(0.80f, 0.45f, -0.75f).normalized(), {1.9f, 2.1f, 2.5f}};
    Eigen::Vector3f sky{0.50f, 0.54f, 0.62f};
    Eigen::Vector3f ground{0.20f, 0.19f, 0.18f};
    Eigen::Vector3f background_top{0.62f, 0.64f, 0.67f};
    Eigen::Vector3f background_bottom{0.30f, 0.31f, 0.33f};
};

struct Frame {
    int width = 480;
    int height = 480;
    int samples = 9;      // per pixel, rounded up to a square
    unsigned threads = 0; // 0: one per core
};

// Keeps an Embree device between frames. Throws std::runtime_error when Embree cannot start.
class Renderer {
  public:
    Renderer();
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    Image draw(const Hair& hair, const Mesh& mesh, const Camera& camera, const Look& look,
               const Frame& frame);

  private:
    struct Device;
    std::unique_ptr<Device> device_;
};

} // namespace render
