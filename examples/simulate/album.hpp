// The pictures of a run: a contact sheet, an A/B sheet and a video.
#pragma once

#include "figure.hpp"
#include "shot.hpp"

#include <memory>
#include <string>
#include <vector>

namespace simulate {

class Album {
  public:
    // Why there are no pictures in this build; "" if there are.
    static std::string why_not();

    Album(const Scene& scene, const Figure& figure);
    ~Album();

    // The run itself, and the same without the inter-hair step.
    bool wants(uint32_t frame) const;
    void take(const Shot& shot);
    bool wants_plain(uint32_t frame) const;
    void take_plain(const Shot& shot);

    // Writes what there is; the names of the files.
    std::vector<std::string> finish();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace simulate
