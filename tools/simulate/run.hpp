// One figure moved through one motion on one device, frame by frame.
#pragma once

#include "crowd.hpp"
#include "neighbours.hpp"
#include "pictures/inside.hpp"
#include "profile/timeline.hpp"
#include "scene/figure.hpp"
#include "scene/motion.hpp"
#include "shot.hpp"
#include "watcher.hpp"

#include <plait/plait_profile.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace simulate {

class Restart;

// What a run measured. Stretch and non-finite counts are the worst over its frames.
struct Measurements {
    uint32_t frames = 0; // done
    std::vector<double> frame_ms;
    std::vector<plait_stage_time> stages; // of all frames
    plait_device_info device{};
    plait_sim_measures last{};
    plait_sim_info info{};
    float max_stretch = 0.0f;
    float mean_stretch = 0.0f; // of the last frame
    uint64_t nonfinite = 0;
    // Rms speed of a vertex relative to that of the nearest strand, m/s: what a step between hairs
    // brakes. None where levels change: not all strands are placed.
    std::optional<double> neighbour_speed;
    uint32_t stretched_frames = 0; // with a segment off by more than a tenth
    struct {
        uint32_t frame, strand, segment; // of max_stretch; segment 0 begins at the root
    } worst{};
    InsideReport inside;
    uint64_t hash = 0;
    Timeline timeline;            // empty unless scene.profile or scene.trace ask for it
    std::vector<CrowdHead> crowd; // within a budget
    double median_ms() const { return percentile_ms(0.5); }
    double percentile_ms(double share) const; // so many frames take no longer
};

// Guides alone, whom the others follow, or all as if none did.
enum class Simulated { guides, all };

class Simulation {
  public:
    Simulation(const Scene& scene, const Figure& figure, Simulated which = Simulated::guides)
        : Simulation(scene, figure, which, nullptr) {}

    // Ends early, with what there is, when interrupted. A body that moves the head does so in place of
    // `motion`. Throws Failure.
    Measurements run(const Motion& motion, const std::vector<Watcher>& watchers,
                     const std::string& label);

    // Keeps what it has come to, and begins where `restart` says, which outlives the run. Throws Failure where that would
    // come to something else.
    void restart_by(Restart& restart);
    uint32_t row() const { return row_; }
    const std::vector<uint32_t>& vertex_count() const { return vertex_count_; }
    plait_sim_measures measure() const;
    plait_sim_info describe() const;
    // What the library has warned of since the last call.
    std::vector<std::string> take_warnings() { return std::exchange(said_, {}); }

  private:
    // `nearest`: of a crowd, whose context and levels this head has, too; null: its own.
    Simulation(const Scene& scene, const Figure& figure, Simulated which,
               const Simulation* nearest);
    SimHandle make_sim();
    LevelsHandle make_levels() const;
    bool changes_level() const { return which_ == Simulated::guides && scene_.changes_level(); }
    void add_crowd();
    void step();
    void wait();
    void begin_level() const;
    void switch_level(uint32_t frame);
    // Whether follows are bound where all strands hang before the motion.
    static bool binds(const Scene& scene, const Figure& figure);

    bool follows() const { return which_ == Simulated::guides && figure_.follows; }
    std::vector<uint32_t> of_simulated(const std::vector<uint32_t>& of_strands) const;
    void add_colliders();
    void add_meshes();
    void add_pins();
    void add_wetness();
    bool keeps_timeline() const { return scene_.profile || !scene_.trace.empty(); }
    // Does `work`, and enters it under `call`, which has yet no times.
    template <typename Work> void timed(Timeline& timeline, HostCall call, const Work& work) const;
    plait_pose head_at(const Motion& motion, float time) const;
    void bind_roots();
    void pose_roots(const plait_pose& head, float time);
    void pose_colliders(const plait_pose& head, float time);
    void settle(const plait_pose& start);
    template <typename Work> double timed_ms(const Work& work) const;
    double step_ms(Timeline& timeline, uint32_t frame, const plait_pose& head);
    void take_launches(Timeline& timeline, uint32_t frame);
    void forget_launches();
    void measure(Measurements& measurements, uint32_t frame);
    void find_worst(Measurements& measurements, uint32_t frame);
    void show(uint32_t frame, const plait_pose& head, const std::vector<Watcher>& watchers);
    void show_level(Shot& shot) const;
    // Of all frames since the last reset.
    std::vector<plait_stage_time> stage_times(bool reset);
    void warn_of_rigid(const CrowdHead& nearest);
    void keep(const Measurements& measurements);
    void take_up(Measurements& measurements);
    void add_stages_before(std::vector<plait_stage_time>& times) const;
    plait_device_info describe_device() const;
    std::vector<float> read_positions() const;
    void finish(Measurements& measurements);

    const Scene& scene_;
    const Figure& figure_;
    const Simulated which_;
    std::vector<std::string> said_;
    std::shared_ptr<plait_context> context_;
    std::shared_ptr<plait_levels> levels_; // null but where they change
    size_t next_switch_ = 0;
    SimHandle sim_;
    struct Moving {
        plait_collider_id collider;
        float share; // of the head's way
    };
    std::vector<Moving> moving_;
    std::vector<plait_collider_id> hands_; // as figure.hands
    std::optional<plait_collider_id> body_;
    std::vector<float> positions_;
    std::vector<float> rest_; // as positions_, before the first step
    std::unique_ptr<Neighbours> neighbours_;
    std::vector<uint32_t> vertex_count_;
    uint32_t row_ = 0;
    Restart* restart_ = nullptr;
    std::vector<plait_stage_time> stages_before_;      // the run was taken up
    std::vector<std::unique_ptr<Simulation>> farther_; // heads of a crowd
    std::unique_ptr<Crowd> crowd_;                     // with this head; null: no budget
};

} // namespace simulate
