// Strand against strand: which segments may meet in a fixed step.
#pragma once

#include "core/base/params.hpp"
#include "core/base/part.hpp"
#include "core/base/schedule.hpp"
#include "core/strands/state.hpp"

namespace plait {

struct PairBuffers {
    Buffer cell_count;   // uint [cells]
    Buffer cell_end;     // uint [cells]
    Buffer cell_moves;   // uint [blocks of cells], bits of floats, m
    Buffer cell_segment; // uint [guides*V]
    Buffer cell_line;    // float [PLAIT_PAIR_COMPONENTS*(guides*V + PLAIT_PAIR_PADDING)]
    Buffer segment;      // uint [PLAIT_PAIR_COUNT*guides*V]
    Buffer offset;       // float [PLAIT_PAIR_COUNT*guides*V], m
    Buffer dropped;      // uint [1]

    uint64_t bytes() const {
        return cell_count.bytes() + cell_end.bytes() + cell_moves.bytes() + cell_segment.bytes() +
               cell_line.bytes() + segment.bytes() + offset.bytes() + dropped.bytes();
    }
};

class Pairs {
  public:
    // Of contact_pair_scan. Work-items of a group take turns on a CPU; but of one alone, which would take all
    // cells, llvmpipe ends the loops before they are done.
    static uint32_t group_width(const plait_device_info& device);

    // Without buffers where `params` have no contact. `longest_segment`: m, at rest.
    static Result<Pairs> create(Device& device, const Params& params, const Layout& layout,
                                float longest_segment);

    // Whether these are what `params` want.
    bool fits(const Params& params) const {
        return params.strand_contact.on == (buffers() != nullptr);
    }
    const PairBuffers* buffers() const { return buffers_.segment ? &buffers_ : nullptr; }

    // Appends the search. `substeps`: of the fixed step, in one of which strands move by position -
    // position_prev.
    struct Step {
        Layout layout; // of strands that are stepped
        const State& state;
        const Params& params;
        uint32_t substeps;
        const plait_device_info& device;
    };
    void append(Schedule& schedule, const Step& step) const;
    // Appends the planes of other strands, where all are at the begin of a substep; after all bodies.
    void fill(Schedule& schedule, const Part& part, const State& state, float friction,
              Doors& doors) const;

  private:
    PairBuffers buffers_;
    float longest_segment_ = 0;
};

} // namespace plait
