// A sim of hair on a head that moves, and how it moves.
#pragma once

#include "measures.hpp"

#include <functional>
#include <optional>

namespace lab::follows {

using MapHandle = std::unique_ptr<plait_follow_map, Destroyer<plait_follow_map_destroy>>;

GroomHandle make_hair(const FollowOptions& options);

// What is simulated of it and what follows.
struct Choice {
    uint32_t guides;
    GroomHandle groom;
    MapHandle map;                // null: nothing follows
    std::vector<uint32_t> origin; // of each of a sim's strands, in the groom
};
Choice choose(const plait_groom* groom, uint32_t guides, uint32_t strands);
// Of a map that there is; takes both.
Choice make_choice(uint32_t guides, plait_groom* chosen, plait_follow_map* map, uint32_t strands);
Choice choose_all(GroomHandle groom, uint32_t strands);

uint64_t frames_of(double seconds); // at least 4

using Motion = std::function<plait_roots(double seconds)>;
// Turned to the side, forwards and to a shoulder, in this order; rad.
plait_roots turned(double turn, double nod, double tilt);
double wave(double seconds, double hertz);
plait_roots shaking(double seconds); // with a little of all other ways to turn, all at once
plait_roots nodding(double seconds); // and turning, slower and farther

struct RunOptions {
    uint32_t substeps = 1;
    plait_sag_free sag_free = PLAIT_SAG_FREE_STIFFEN;
};

class Run {
  public:
    // `map`: of `choice`, or learnt from it.
    Run(plait_context* context, const Choice& choice, const plait_follow_map* map,
        RunOptions how = {});

    void step(uint64_t number,
              const Motion& motion); // bodies go where the head goes, and those on it turn
    void stand();                    // at once, and hair is as groomed
    void blow(float speed);          // m/s, from the side; 0: no wind
    Hair read() const;               // strands in the groom's order
    std::vector<bool> simulated() const;
    double wall() const; // s of a step, the least, which a busy machine disturbs least

  private:
    void add_colliders();

    const Choice& choice_;
    SimHandle sim_;
    std::vector<plait_collider_id> on_head_, below_;
    std::vector<double> times_;
};

} // namespace lab::follows
