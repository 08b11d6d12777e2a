// Roots that are bound to the triangles of a mesh, on the device: where its vertices go, they go.
#pragma once

#include "core/base/layout.hpp"
#include "core/base/schedule.hpp"
#include "core/mesh/mesh.hpp"
#include "core/strands/state.hpp"

#include <array>
#include <span>

namespace plait {

class RootBinding {
  public:
    // To the triangles of `mesh` that are nearest to `rest`, float4 [guides][row], of each the root.
    // `places`: [guides], or empty.
    static Result<RootBinding> create(Device& device, const Mesh& mesh, const Layout& layout,
                                      std::span<const float> rest,
                                      std::span<plait_root_place> places,
                                      std::pmr::memory_resource* memory);

    uint32_t vertices() const { return vertices_; } // of the mesh; 0: roots are free
    uint32_t far() const { return far_; }           // roots more than a centimetre from it
    uint32_t turned() const { return turned_; }     // of these, strands whose tip is nearer by half
    float farthest() const { return farthest_; }    // m
    uint32_t farthest_root() const { return farthest_root_; }
    // INVALID_ARGUMENT: not as many as the mesh has.
    Status check_count(size_t positions) const;
    // The same, and that they do not mirror what the roots are on.
    Status check(std::span<const MeshPoint> positions) const;
    // Uploads where the vertices are, in metres, of which `scale` are one of the groom's, and appends
    // what makes the strands' poses of them.
    Status append(Device& device, Schedule& schedule, const Layout& layout, const State& state,
                  std::span<const MeshPoint> positions, float scale, const Buffer& poses) const;
    // The same for places on the device, `words` floats from one to the next.
    struct Taken {
        const Buffer& floats;
        uint32_t words;
        float scale;
    };
    Status take(Device& device, Schedule& schedule, const Layout& layout, const State& state,
                const Taken& taken, const Buffer& poses);
    // Appends the same for what is uploaded, to be built.
    void append(Schedule& schedule, const Layout& layout, const State& state,
                const Buffer& poses) const;
    uint64_t device_bytes() const {
        return corner_.bytes() + rest_.bytes() + at_.bytes() + next_.bytes();
    }

  private:
    uint32_t vertices_ = 0, far_ = 0, turned_ = 0, farthest_root_ = 0;
    float farthest_ = 0;
    std::pmr::memory_resource* memory_ = nullptr;
    // Four vertices under roots that are far from one plane, and where they are at rest; all alike: none are.
    std::array<uint32_t, 4> solid_{};
    std::array<MeshPoint, 4> solid_rest_{};
    Buffer corner_; // uint [3*guides]
    Buffer rest_;   // float4 [vertices]
    Buffer at_;     // float4 [vertices]
    Buffer next_;   // float4 [vertices], from the first time on that places are taken
};

} // namespace plait
