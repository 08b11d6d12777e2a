#include "levels.hpp"

#include "common/progress.hpp"

#include <plait/plait_levels.h>

#include <algorithm>
#include <cmath>
#include <optional>
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

double radians(double degrees) {
    return degrees * pi / 180;
}

follows::Motion turning(double degrees, double hertz) {
    return [=](double s) { return turned(radians(degrees) * wave(s, hertz), 0, 0); };
}

// Up and down by `height` m with each step, and a little to the side with every second.
follows::Motion going(double steps, double height, double degrees) {
    return [=](double s) {
        plait_roots roots = turned(radians(degrees) * wave(s, steps / 2),
                                   0.3 * radians(degrees) * wave(s, steps), 0);
        roots.head.t[1] = static_cast<float>(height * wave(s, steps));
        roots.head.t[0] = static_cast<float>(0.5 * height * wave(s, steps / 2));
        return roots;
    };
}

// In the head's frame.
Vec3 in_head(const plait_roots& roots, const Vec3& at) {
    const Quat turn(Eigen::Map<const Eigen::Quaternionf>(roots.head.q).cast<double>());
    return turn.conjugate() * (at - Eigen::Map<const Eigen::Vector3f>(roots.head.t).cast<double>());
}
Vec3 on_head(const plait_roots& roots, const Vec3& at) {
    const Quat turn(Eigen::Map<const Eigen::Quaternionf>(roots.head.q).cast<double>());
    return turn * at + Eigen::Map<const Eigen::Vector3f>(roots.head.t).cast<double>();
}

// How far hair goes from its mean in the head's frame.
class Swing {
  public:
    explicit Swing(const Hair& hair) : sum_(hair.x.size(), Vec3::Zero()) {}
    void add(const Hair& hair, const plait_roots& roots) {
        for (size_t s = 0; s < hair.strands(); ++s)
            for (uint32_t i = 0; i < hair.counts[s]; ++i) {
                const Vec3 at = in_head(roots, hair.strand(s)[i].cast<double>());
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
    double rms() const { return std::sqrt(squares() / points()); } // m

  private:
    std::vector<Vec3> sum_;
    double squares_ = 0, points_ = 0, frames_ = 0;
};

// Of a level against the truth, in one motion and in all.
class Errors {
  public:
    explicit Errors(const Hair& hair) : strands_(hair.strands()), counted_(hair.strands()) {}
    template <typename Place> void add(const Hair& truth, const Place& place) {
        for (size_t s = 0; s < truth.strands(); ++s) {
            double sum = 0;
            for (uint32_t i = 0; i < truth.counts[s]; ++i)
                sum += (place(s, i) - truth.strand(s)[i].template cast<double>()).squaredNorm();
            squares_ += sum;
            strands_[s] += sum / truth.counts[s];
        }
    }
    // m^2, of the motion that is over. `counts`: for the median, too.
    double take_squares(bool counts) {
        for (size_t s = 0; s < strands_.size() && counts; ++s)
            counted_[s] += strands_[s];
        strands_.assign(strands_.size(), 0);
        return std::exchange(squares_, 0);
    }
    // m, rms in `frames` frames.
    double median(double frames) {
        const auto middle = counted_.begin() + static_cast<std::ptrdiff_t>(counted_.size() / 2);
        std::nth_element(counted_.begin(), middle, counted_.end());
        return std::sqrt(*middle / frames);
    }

  private:
    double squares_ = 0;
    std::vector<double> strands_, counted_; // m^2, mean over a strand, summed over frames
};

struct Entry {
    follows::Choice choice;
    std::unique_ptr<Run> run; // null: hair goes with the head as it hangs
    Errors errors;
    LevelRow row;
};

// From the groom until they hang: what came before does not count, as on which side of a shoulder hair lies.
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

    // `counts`: in the table's figures over all of its motions.
    void run(const LevelMotion& motion, bool counts, uint64_t frames, Progress& progress,
             uint32_t& done) {
        Swing swing(hung_);
        std::vector<Swing> own(entries_.size(), swing);
        settle(truth_);
        for (Entry& entry : entries_)
            if (entry.run)
                settle(*entry.run);
        for (uint64_t frame = 1; frame <= frames && !interrupted(); ++frame) {
            const double time = static_cast<double>(frame) / rate;
            if (motion.gust > 0)
                blow(time < gust_end ? motion.gust : 0);
            truth_.step(frame, motion.head);
            const Hair truth = truth_.read();
            const plait_roots roots = motion.head(time);
            swing.add(truth, roots);
            for (size_t k = 0; k < entries_.size(); ++k) {
                const std::optional<Hair> hair = compare(entries_[k], truth, roots, frame, motion);
                own[k].add(hair ? *hair : truth, roots);
            }
            progress.update(++done);
        }
        for (size_t k = 0; k < entries_.size(); ++k) {
            const double squares = entries_[k].errors.take_squares(counts);
            entries_[k].row.found.push_back(
                {std::sqrt(squares / swing.points()), swing.rms(), own[k].rms()});
        }
        if (!counts)
            return;
        squares_ += swing.squares();
        points_ += swing.points();
        frames_ += static_cast<double>(frames);
    }

    std::vector<LevelRow> rows() {
        const double whole = entries_.front().run->wall(), swing = std::sqrt(squares_ / points_);
        std::vector<LevelRow> rows;
        for (Entry& entry : entries_) {
            entry.row.ms = entry.run ? 1e3 * entry.run->wall() : 0;
            entry.row.of_whole = 1e-3 * entry.row.ms / whole;
            for (const size_t motion : shares)
                entry.row.all += std::pow(entry.row.found[motion].share(), 2);
            entry.row.all = std::sqrt(entry.row.all / std::size(shares));
            entry.row.median = entry.errors.median(frames_) / swing;
            rows.push_back(entry.row);
        }
        return rows;
    }

  private:
    void blow(float speed) {
        truth_.blow(speed);
        for (Entry& entry : entries_)
            if (entry.run)
                entry.run->blow(speed);
    }
    // Gives its hair, unless that goes with the head.
    std::optional<Hair> compare(Entry& entry, const Hair& truth, const plait_roots& roots,
                                uint64_t frame, const LevelMotion& motion) {
        if (!entry.run) {
            entry.errors.add(truth, [&](size_t s, uint32_t i) {
                return on_head(roots, hung_.strand(s)[i].cast<double>());
            });
            return std::nullopt;
        }
        entry.run->step(frame, motion.head);
        Hair now = entry.run->read();
        entry.errors.add(
            truth, [&](size_t s, uint32_t i) -> Vec3 { return now.strand(s)[i].cast<double>(); });
        return now;
    }

    follows::Choice whole_;
    Run truth_;
    Hair hung_;
    std::vector<Entry> entries_;
    double squares_ = 0, points_ = 0, frames_ = 0;
};

} // namespace

const std::vector<LevelMotion>& level_motions() {
    static const std::vector<LevelMotion> all = {
        {"shake", shaking, 0},
        {"nod", nodding, 0},
        {"gust", standing, gust},
        {"walk", going(2, 0.025, 4), 0},
        {"run", going(2.8, 0.06, 7), 0},
        {"turn 8 deg, 0.6 Hz", turning(8, 0.6), 0},
        {"turn 8 deg, 2.6 Hz", turning(8, 2.6), 0},
        {"turn 16 deg, 0.6 Hz", turning(16, 0.6), 0},
        {"turn 16 deg, 1.3 Hz", turning(16, 1.3), 0},
        {"turn 32 deg, 0.6 Hz", turning(32, 0.6), 0},
        {"turn 32 deg, 1.3 Hz", turning(32, 1.3), 0},
        {"turn 64 deg, 0.6 Hz", turning(64, 0.6), 0},
        {"nod 12 deg, 1.2 Hz", [](double s) { return turned(0, radians(12) * wave(s, 1.2), 0); },
         0},
        {"sway 10 deg, 0.8 Hz", [](double s) { return turned(0, 0, radians(10) * wave(s, 0.8)); },
         0},
        {"breeze", standing, 1.5f},
        {"storm", standing, 8}};
    return all;
}

std::vector<LevelRow> measure_levels(Contexts& contexts, const LevelsOptions& options) {
    plait_context* const context = contexts.of(*find_model("articulated"));
    const uint64_t frames = frames_of(options.seconds);
    const auto& motions = level_motions();
    const size_t count = options.transfer ? motions.size() : std::size(shares);
    Progress progress("levels", static_cast<uint32_t>(options.styles.size() * count * frames));
    uint32_t done = 0;
    std::vector<LevelRow> rows;
    for (const std::string& name : options.styles) {
        Style style(context, name, options.strands);
        for (size_t motion = 0; motion < count && !interrupted(); ++motion)
            style.run(motions[motion], motion < std::size(shares), frames, progress, done);
        if (interrupted())
            break;
        const auto its = style.rows();
        rows.insert(rows.end(), its.begin(), its.end());
    }
    return rows;
}

} // namespace lab::levels
