// What plait-simulate says about a run: a table for people, JSON for programs.
#pragma once

#include "comparison.hpp"
#include "profile/profile.hpp"

#include <optional>

namespace simulate {

struct Compared {
    Variant variant;
    Measurements run;
};

struct Report {
    const Scene& scene;
    const Figure& figure;
    Measurements main;
    std::optional<Profile> profile;    // where it was asked for
    std::vector<Compared> beside;      // what it is compared with
    std::vector<std::string> warnings; // printed before the run, or when it started
    bool interrupted = false;
    std::vector<std::string> files;
};

// The keys are listed in docs/simulate.md.
Json to_json(const Report& report);

void print_report(const Report& report);

} // namespace simulate
