#include "levels.hpp"

#include "follows/head.hpp"

#include "common/progress.hpp"

#include <plait/plait_levels.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace lab::levels {

namespace {

using namespace follows;

constexpr double settling = 2;   // s, in which hair comes to hang
constexpr double gust_end = 1.2; // s
constexpr float gust = 4;        // m/s
constexpr uint32_t fine = 4;     // substeps of the truth
// It sags, and levels are bound where it hangs then.
constexpr plait_sag_free sagging = PLAIT_SAG_FREE_OFF;

plait_roots standing(double) {
    return plait_roots_defaults();
}
constexpr Motion motions[motion_count] = {shaking, nodding, standing};

// Heads turn about the origin.
Quat turn_of(const plait_roots& roots) {
    return Quat(Eigen::Map<const Eigen::Quaternionf>(roots.head.q).cast<double>());
}

// How far hair goes from its mean in the head's frame.
class Swing {
  public:
    explicit Swing(const Hair& hair) : sum_(hair.x.size(), Vec3::Zero()) {}
    void add(const Hair& hair, const plait_roots& roots) {
        const Quat back = turn_of(roots).conjugate();
        for (size_t s = 0; s < hair.strands(); ++s)
            for (uint32_t i = 0; i < hair.counts[s]; ++i) {
                const Vec3 at = back * hair.strand(s)[i].cast<double>();
                sum_[s * hair.row + i] += at;
                squares_ += at.squaredNorm();
                ++points_;
            }
        ++frames_;
    }
    double squares() const { // m^2, of all points and frames
        double means = 0;
        for (const Vec3& sum : sum_)
            means += sum.squaredNorm() / frames_;
        return squares_ - means;
    }
    double points() const { return points_; }

  private:
    std::vector<Vec3> sum_;
    double squares_ = 0, points_ = 0, frames_ = 0;
};

// Of a level against the truth, in one motion and in all.
class Errors {
  public:
    explicit Errors(const Hair& hair) : strands_(hair.strands()) {}
    template <typename Place> void add(const Hair& truth, const Place& place) {
        for (size_t s = 0; s < truth.strands(); ++s) {
            double sum = 0;
            for (uint32_t i = 0; i < truth.counts[s]; ++i)
                sum += (place(s, i) - truth.strand(s)[i].template cast<double>()).squaredNorm();
            squares_ += sum;
            strands_[s] += sum / truth.counts[s];
        }
    }
    double take_squares() { return std::exchange(squares_, 0); } // of the motion that is over
    // m, rms in `frames` frames.
    double median(double frames) {
        const auto middle = strands_.begin() + static_cast<std::ptrdiff_t>(strands_.size() / 2);
        std::nth_element(strands_.begin(), middle, strands_.end());
        return std::sqrt(*middle / frames);
    }

  private:
    double squares_ = 0;
    std::vector<double> strands_; // m^2, mean over a strand, summed over frames
};

struct Entry {
    follows::Choice choice;
    std::unique_ptr<Run> run; // null: hair goes with the head as it hangs
    Errors errors;
    LevelRow row;
};

// All strands at rest, until they hang.
Hair settle(Run& run) {
    run.stand();
    run.blow(0);
    for (uint64_t frame = 1; frame <= frames_of(settling) && !interrupted(); ++frame)
        run.step(frame, standing);
    return run.read();
}

LevelsHandle make_levels(const plait_groom* groom, const Hair& hung) {
    plait_levels_desc desc = plait_levels_desc_defaults();
    desc.groom = groom;
    desc.hung = {hung.x.data(), hung.x.size(), sizeof hung.x[0]};
    plait_levels* levels = nullptr;
    check(plait_levels_create(&desc, &levels));
    return LevelsHandle(levels);
}

std::vector<plait_level> list(const plait_levels* levels) {
    size_t count = 0;
    check(plait_levels_list(levels, nullptr, &count));
    std::vector<plait_level> all(count, plait_level_defaults());
    check(plait_levels_list(levels, all.data(), &count));
    return all;
}

follows::Choice take(const plait_levels* levels, size_t level, uint32_t guides, uint32_t strands) {
    plait_groom* chosen = nullptr;
    plait_follow_map* map = nullptr;
    check(plait_levels_take(levels, level, &chosen, &map));
    return make_choice(guides, chosen, map, strands);
}

// One style: the truth and all levels, frame by frame, so that a busy machine is busy for all of them.
class Style {
  public:
    Style(plait_context* context, const std::string& name, uint32_t strands)
        : whole_(choose_all(make_hair({.style = name, .strands = strands}), strands)),
          truth_(context, whole_, nullptr, {fine, sagging}), hung_(settle(truth_)) {
        const LevelsHandle levels = make_levels(whole_.groom.get(), hung_);
        const auto listed = list(levels.get());
        for (size_t k = 0; k < listed.size(); ++k) {
            Entry entry{{}, nullptr, Errors(hung_), {}};
            entry.row.style = name;
            entry.row.guides = listed[k].guides;
            entry.row.listed = listed[k].share;
            if (listed[k].guides > 0)
                entry.choice = take(levels.get(), k, listed[k].guides, strands);
            entries_.push_back(std::move(entry));
        }
        for (Entry& entry : entries_) // whose places no longer change
            if (entry.row.guides > 0)
                entry.run = std::make_unique<Run>(context, entry.choice, entry.choice.map.get(),
                                                  RunOptions{1, sagging});
    }

    void run(size_t motion, uint64_t frames, Progress& progress, uint32_t& done) {
        Swing swing(hung_);
        settle(truth_);
        for (Entry& entry : entries_)
            if (entry.run)
                settle(*entry.run);
        for (uint64_t frame = 1; frame <= frames && !interrupted(); ++frame) {
            const double time = static_cast<double>(frame) / rate;
            if (motions[motion] == standing)
                blow(time);
            truth_.step(frame, motions[motion]);
            const Hair truth = truth_.read();
            const plait_roots roots = motions[motion](time);
            swing.add(truth, roots);
            for (Entry& entry : entries_)
                compare(entry, truth, roots, frame, motion);
            progress.update(++done);
        }
        const double squares = swing.squares();
        for (Entry& entry : entries_) {
            entry.row.share[motion] = std::sqrt(entry.errors.take_squares() / squares);
            entry.row.all += std::pow(entry.row.share[motion], 2) / motion_count;
        }
        squares_ += squares;
        points_ += swing.points();
        frames_ += static_cast<double>(frames);
    }

    std::vector<LevelRow> rows() {
        const double whole = entries_.front().run->wall(), swing = std::sqrt(squares_ / points_);
        std::vector<LevelRow> rows;
        for (Entry& entry : entries_) {
            entry.row.ms = entry.run ? 1e3 * entry.run->wall() : 0;
            entry.row.of_whole = 1e-3 * entry.row.ms / whole;
            entry.row.all = std::sqrt(entry.row.all);
            entry.row.median = entry.errors.median(frames_) / swing;
            rows.push_back(entry.row);
        }
        return rows;
    }

  private:
    void blow(double time) {
        const float speed = time < gust_end ? gust : 0.0f;
        truth_.blow(speed);
        for (Entry& entry : entries_)
            if (entry.run)
                entry.run->blow(speed);
    }
    void compare(Entry& entry, const Hair& truth, const plait_roots& roots, uint64_t frame,
                 size_t motion) {
        if (entry.run) {
            entry.run->step(frame, motions[motion]);
            const Hair now = entry.run->read();
            entry.errors.add(truth, [&](size_t s, uint32_t i) -> Vec3 {
                return now.strand(s)[i].cast<double>();
            });
            return;
        }
        const Quat turn = turn_of(roots);
        entry.errors.add(truth, [&](size_t s, uint32_t i) -> Vec3 {
            return turn * hung_.strand(s)[i].cast<double>();
        });
    }

    follows::Choice whole_;
    Run truth_;
    Hair hung_;
    std::vector<Entry> entries_;
    double squares_ = 0, points_ = 0, frames_ = 0;
};

} // namespace

std::vector<LevelRow> measure_levels(Contexts& contexts, const LevelsOptions& options) {
    plait_context* const context = contexts.of(*find_model("articulated"));
    const uint64_t frames = frames_of(options.seconds);
    Progress progress("levels",
                      static_cast<uint32_t>(options.styles.size() * motion_count * frames));
    uint32_t done = 0;
    std::vector<LevelRow> rows;
    for (const std::string& name : options.styles) {
        Style style(context, name, options.strands);
        for (size_t motion = 0; motion < motion_count && !interrupted(); ++motion)
            style.run(motion, frames, progress, done);
        const auto its = style.rows();
        rows.insert(rows.end(), its.begin(), its.end());
    }
    return rows;
}

} // namespace lab::levels
