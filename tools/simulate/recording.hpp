// The hair as it moves, in a file for renderers.
#pragma once

#include "scene/figure.hpp"
#include "shot.hpp"

#include <plait/plait_recorder.h>

namespace simulate {

class Recording {
  public:
    // By its extension: .abc or .usda.
    static bool is_for(const std::string& path);

    // Throws Failure, as do the others.
    Recording(const std::string& path, const Scene& scene, const Figure& figure);
    void add(const Shot& shot);
    void close(); // without a frame: no file

  private:
    struct Destroy {
        void operator()(plait_recorder* recorder) const { plait_recorder_destroy(recorder); }
    };
    std::unique_ptr<plait_recorder, Destroy> recorder_;
    uint32_t rate_;
    std::vector<float> packed_; // xyz, without what is behind tips
    bool any_ = false;
};

} // namespace simulate
