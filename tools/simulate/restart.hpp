// A run that goes on where it was cut off. In the folder of its results lie restart.snapshot, the sim and what the run
// has counted, every so many frames, and restart.frames: the positions that pictures, film and cache are made of, and
// are made of again. A cache that is a trajectory holds the frames itself.
#pragma once

#include "cache.hpp"
#include "checksum.hpp"
#include "common/json_reader.hpp"
#include "scene/scene.hpp"
#include "watcher.hpp"

namespace simulate {

// What was kept of a run.
struct Snapshot {
    Json run;
    std::string sim; // as plait_sim_save has it
};

// Throws Failure, as do the others: the file is damaged, or none.
Snapshot read_snapshot(const std::string& path);
// It is there whole, or what was there before is.
void write_snapshot(const Snapshot& snapshot, const std::string& path);

class Restart {
  public:
    // Of a scene without restart_every and resume: nothing is kept, but what another run has kept is not written over.
    // Throws Failure where what was kept is another scene's, or would be lost.
    explicit Restart(const Scene& scene);
    bool is_on() const { return scene_.restart_every > 0; }
    bool is_done() const { return done_; } // by an earlier run: all results are there

    // From here on, or null: from the beginning.
    const Json* begin() const { return from_ ? &from_->run.at("measured") : nullptr; }
    const std::string& sim() const { return from_->sim; }
    uint32_t begin_frame() const { return from_ ? from_->run.at("frames").get<uint32_t>() : 0; }

    // Shows `watchers` the frames that were kept, then adds one that keeps those that come.
    void keep_frames(std::vector<Watcher>& watchers, const std::vector<uint32_t>& vertex_count,
                     uint32_t row);
    bool is_due(uint32_t frames) const { return is_on() && frames % scene_.restart_every == 0; }
    // After so many frames, each of which has been shown.
    void keep(uint32_t frames, const Json& measured, std::string sim);
    uint32_t kept() const { return kept_; } // frames
    void finish();                          // all results are written: no more than that is kept

  private:
    std::string path(const char* name) const { return scene_.out + "/" + name; }
    std::string frames_path() const;
    void look_at(Snapshot&& found);
    void begin_anew();
    void check_same(const Json& run) const;
    void show_again(const std::vector<Watcher>& watchers, const std::vector<uint32_t>& counts,
                    uint32_t row);
    void append(const Shot& shot);
    Shot placed(Shot shot, uint32_t frame) const;

    const Scene& scene_;
    Json inputs_; // scene_.inputs
    bool done_ = false;
    std::optional<Snapshot> from_;
    std::unique_ptr<CacheWriter> frames_;
    uint32_t frame_count_ = 0; // in it
    Checksum frame_sum_;       // of these
    Json levels_;              // where they change: frame, strands shown, and in words
    uint32_t kept_ = 0;
};

} // namespace simulate
