// Which level each of many heads of hair gets, and how many of its strands are shown: as good a picture as
// a budget buys, or as cheap a one as a tolerance allows. On the host, and the same for the same arguments.
//
// Source: the greedy walk along convex hulls is Fox 1966 (discrete marginal analysis), used for levels of
// detail since Funkhouser & Sequin 1993. Errors, prices and the two ladders are ours.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace plait {

struct LevelChoice {
    uint32_t level = 0, shown = 0;
    bool operator==(const LevelChoice&) const = default;
};

// A head of hair in one frame.
struct DirectedHair {
    static constexpr size_t most_levels = 6, most_shown = 10;

    std::array<uint32_t, most_levels> guides{}; // of each level, the finest first
    std::array<double, most_levels> share{};    // error over swing
    uint32_t first_level = 0, level_count = 0;  // those that may be taken: [first, count)
    std::array<uint32_t, most_shown>
        shown{}; // strands after which those shown may end, rising; last all
    uint32_t shown_count = 0;
    uint32_t vertices = 0; // of a strand
    uint32_t substeps = 1;
    bool meets_bodies = false;
    double swing = 0;            // m, rms
    double pixels_per_metre = 0; // 0: unseen
    double importance = 1;
    double width = 0; // m, of all its hairs side by side

    LevelChoice now;
    double since = 0;  // s since that was taken; infinite: it never was
    double unseen = 0; // s for which nobody has seen it
};

struct DirectorGoal {
    double budget = 0;    // ms; 0: none
    double tolerance = 2; // px
    double hair = 1;      // px, the width at which a hair is drawn
    double hold = 0.5;    // s that a choice stands at least
};

struct DirectorReport {
    uint32_t changed = 0;
    double predicted = 0; // ms
    double worst = 0;     // px, the greatest error of what is seen, without importance
};

// Whether enough of it is shown to cover the head.
bool covers(const DirectedHair& hair, const DirectorGoal& goal);

class Director {
  public:
    explicit Director(std::pmr::memory_resource* memory)
        : climbers_(memory), heap_(memory), changes_(memory) {}

    // What the hair took that was chosen last, dt s ago.
    void took(double ms, double dt);
    // Writes a choice for each. Memory is kept from call to call.
    DirectorReport choose(std::span<const DirectedHair> hair, const DirectorGoal& goal,
                          std::span<LevelChoice> out);

    double price() const { return price_; } // ms of a unit of work

  private:
    struct Rung {
        double work, error; // error squared, px^2, with importance
        uint32_t value;     // level or shown strands
    };
    // Rungs of rising work and falling gain for it: the lower convex hull of those that were added.
    struct Ladder {
        std::array<Rung, DirectedHair::most_shown> rungs;
        uint32_t count = 0, at = 0;
        double kept = 0; // the work of what is taken now

        void add(Rung rung);
        bool ends() const { return at + 1 >= count; }
        const Rung& here() const { return rungs[at]; }
        const Rung& next() const { return rungs[at + 1]; }
        bool keeps() const; // the next step leads to no more than there is now
        double slope() const;
    };
    struct Climber {
        Ladder levels, shown;

        double work() const { return levels.here().work + shown.here().work; }
        double kept() const { return levels.kept + shown.kept; }
        double error() const { return levels.here().error + shown.here().error; }
        bool done(double tolerance) const;
        Ladder& best(); // the ladder whose next step gains more
    };
    struct Change {
        uint32_t index;
        double work, gain; // what it adds; error squared that it saves
        bool wakes;
    };

    void fit_fixed(double ms, double dt);
    static Climber climber_of(const DirectedHair& hair, const DirectorGoal& goal);
    void climb(const DirectorGoal& goal);
    void list_changes(std::span<const DirectedHair> hair, const DirectorGoal& goal, bool over);

    std::pmr::vector<Climber> climbers_;
    std::pmr::vector<uint32_t> heap_; // of climbers
    std::pmr::vector<Change> changes_;
    double price_ = 0.5;           // two cores that share the work evenly
    double fixed_ = 0;             // ms, whatever the work
    double work_ = 0;              // of what was chosen last
    std::array<double, 5> took_{}; // ms; the last that were measured
    uint32_t measured_ = 0;
    struct Means { // over some seconds, of work and of ms, and of their squares and product
        double weight, work, ms, work2, product;
    } means_{};
};

} // namespace plait
