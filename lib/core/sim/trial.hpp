// All or nothing: what is new is made aside, taken, and given back where it does not do.
#pragma once

#include "core/strands/model.hpp"

#include <utility>

namespace plait {

// Drops what was prepared and not taken, however the call ends.
struct Discard {
    Model& model;
    ~Discard() { model.discard(); }
};

// Swaps in what is new, and out again however the call ends, also by an exception, unless it is kept:
// Trial(swap).keep_if(check()) checks with the new in place.
template <typename Swap> class Trial {
  public:
    explicit Trial(Swap swap) : swap_(swap) { swap_(); }
    ~Trial() {
        if (!kept_)
            swap_();
    }
    Trial(const Trial&) = delete;
    Trial& operator=(const Trial&) = delete;
    Status keep_if(Status status) {
        kept_ = static_cast<bool>(status);
        return status;
    }

  private:
    Swap swap_;
    bool kept_ = false;
};

} // namespace plait
