// The pictures of a run: a contact sheet, a comparison and a video.
#pragma once

#include "comparison.hpp"
#include "scene/figure.hpp"
#include "shot.hpp"

#include <memory>
#include <string>
#include <vector>

namespace simulate {

class Album {
  public:
    // Why there are no pictures in this build; "" if there are.
    static std::string why_not();

    // `beside`: what the run is compared with, row by row.
    Album(const Scene& scene, const Figure& figure, std::vector<Variant> beside);
    ~Album();

    // Of the run itself, and of the variants beside it.
    bool wants(uint32_t frame) const;
    void take(const Shot& shot);
    bool wants_beside(uint32_t frame) const;
    void take_beside(size_t variant, const Shot& shot);

    // Writes what there is; the names of the files.
    std::vector<std::string> finish();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace simulate
