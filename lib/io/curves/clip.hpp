// Files of curves that move: one shape, and a sample of its positions each frame.
#pragma once

#include "io/file.hpp"

#include <cstdint>
#include <memory>
#include <memory_resource>
#include <span>
#include <string>

namespace plait {

// Axes and units of what is written.
struct ClipRules {
    plait_axes axes = PLAIT_AXES_Y_UP;
    double metres_per_unit = 1;
    double frames_per_second = 24; // of formats whose times are in frames
    bool moves = true;             // false: one sample, of no time
    bool velocities = false;       // one to each frame
    std::pmr::memory_resource* memory = std::pmr::get_default_resource();
};

// In the file's unit and axes, but for the diameters' number: one, or one for each curve or point; or none.
struct ClipShape {
    std::span<const uint32_t> vertex_counts; // [curves]
    std::span<const float> widths;
    std::span<const float> uv; // 2 [curves] or none
};

// The diameter of point `point` of all, of curve `curve`.
inline float width_of(const ClipShape& shape, size_t curve, size_t point) {
    const size_t count = shape.widths.size();
    return shape.widths[count == 1 ? 0 : count == shape.vertex_counts.size() ? curve : point];
}
// Appends one for each point, as Blender takes them, unless there are none.
template <typename Floats> void append_widths(const ClipShape& shape, Floats& out) {
    for (size_t c = 0, point = 0; c < shape.vertex_counts.size() && !shape.widths.empty(); ++c)
        for (uint32_t v = 0; v < shape.vertex_counts[c]; ++v)
            out.push_back(width_of(shape, c, point++));
}

// Calls: begin, then frames with rising times, in step with them their velocities, then commit.
// Destroyed before it has committed: nothing is left. IO.
class ClipWriter {
  public:
    virtual ~ClipWriter() = default;
    virtual Status begin(const ClipShape& shape) = 0;
    // `positions` and `velocities`: 3 floats for each point.
    virtual Status add_frame(double time, std::span<const float> positions) = 0;
    virtual Status add_velocities(std::span<const float> velocities) = 0;
    virtual Status commit() = 0;
};

// By extension. UNSUPPORTED: a format without clips.
Result<std::unique_ptr<ClipWriter>> make_clip_writer(const std::string& path,
                                                     const ClipRules& rules);

} // namespace plait
