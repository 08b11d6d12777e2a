// What a scene did: every strand at every frame.
#pragma once

#include "methods/models.hpp"
#include "scene/scene.hpp"

#include <functional>

namespace lab {

struct Frame {
    double time; // s since the recording began
    Pose root;
    std::vector<std::vector<Vec3>> x, v; // by strand and vertex, m and m/s
};

struct Recording {
    std::vector<std::vector<Vec3>> rest; // at the roots' first pose
    std::vector<Frame> frames;           // the first is the state the recording began with
    uint64_t nonfinite = 0;              // vertices, most in any frame
    double teleport_change = 0; // farthest a vertex moved, in the roots' frame, by a call, m
    bool interrupted = false;
};

// What the method makes of the scene. Stiffnesses of single strands come on top, see Stage.
plait::SimDesc describe(const Scene& scene, const Method& method);
Method method_of(const Scene& scene); // as the scene says

// Settles, then records. `watch` is told the share that is done. Throws Failure.
Recording record(Contexts& contexts, const Scene& scene, const Method& method,
                 const std::function<void(double)>& watch = {});

// A sim of `copies` of the scene's strands, and the poses that move it.
class Stage {
  public:
    Stage(plait_context* context, const Scene& scene, const Method& method, uint32_t copies = 1);

    // To `time` in one fixed step, from the step before. Returns how far a teleport moved anything.
    double step_to(double time);
    void settle(bool begin); // at the scene's settling drag and gravity; or no longer
    void wait();
    void read(Frame& frame) const;
    plait_sim* sim() const { return sim_.get(); }
    uint64_t vertices() const;
    const std::vector<std::vector<Vec3>>& rest() const { return rest_; }

  private:
    void pin_tips(const TipPin& pin);
    void start_at(const Pose& pose);
    void pose_colliders(double time);
    double teleport(const Pose& to);
    void set_params(double drag, const Vec3& gravity);
    std::vector<std::vector<Vec3>> read_field(plait_field field) const;

    const Scene& scene_;
    plait::SimDesc desc_;
    GroomHandle groom_;
    SimHandle sim_;
    std::vector<plait_collider_id> colliders_;
    std::vector<std::vector<Vec3>> rest_;
    uint32_t copies_;
    uint32_t row_ = 0; // vertices per strand in the fields
    Pose pose_;
    double time_ = 0;
};

} // namespace lab
