// Ways in which hair may keep its volume: the library's by its params, those of others by what they
// change of velocities after a step, and by forces in the next one.
#pragma once

#include "cloud.hpp"

#include <plait/plait.hpp>

#include <memory>
#include <optional>
#include <string>

namespace lab::volume {

struct Change {
    std::vector<Vec3> velocity;     // m/s, at once; empty: none
    std::vector<Vec3> acceleration; // m/s^2, during the next step; empty: none
};

// A program of the laboratory, over the C API.
class Program {
  public:
    virtual ~Program() = default;
    virtual Change act(const Cloud& cloud, double h) = 0; // h: s, the step
};

struct Method {
    std::string name;  // of a row: "petrovic"
    std::string title; // "Petrovic, Henne & Anderson 2005"
    std::string colour;
    void (*set)(plait::SimDesc&); // what it is in the library
    // Null: it is the library's. `closed_radius` as of Nodes.
    std::unique_ptr<Program> (*program)(const Cube& cube, double closed_radius);
};
const std::vector<Method>& all_methods();

} // namespace lab::volume
