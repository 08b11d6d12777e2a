// Which points lie inside a triangle mesh, and how deep.
#pragma once

#include "render.hpp"

#include <memory>

namespace render {

class Solid {
  public:
    // Triangles whose normals point outwards, or all inwards. Parts may overlap and holes may be
    // open. Throws std::runtime_error when Embree cannot start.
    explicit Solid(const std::vector<std::array<uint32_t, 3>>& triangles);
    ~Solid();
    Solid(const Solid&) = delete;
    Solid& operator=(const Solid&) = delete;

    // Where its vertices are from now on, m; as many as the triangles name, and each time so many.
    void set_vertices(const std::vector<Eigen::Vector3f>& vertices);

    // The distance to the nearest triangle, m, of a point whose winding number is 1/2 or more in
    // size; 0 outside.
    float depth(const Eigen::Vector3f& point) const;

    // How often the mesh winds around `point`: 1 inside a closed one, 0 outside; a share of these
    // where it is open. Source: Jacobson, Kavan & Sorkine-Hornung 2013, eq. 5 and 6.
    double winding_number(const Eigen::Vector3f& point) const;

  private:
    bool contains(const Eigen::Vector3f& point) const;

    struct State;
    std::unique_ptr<State> state_;
};

} // namespace render
