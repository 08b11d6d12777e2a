// What several commands choose.
#pragma once

#include "common.hpp"

#include <string>
#include <vector>

namespace lab {

// What of a table is measured, and where it is kept so that a run goes on from there.
struct Choice {
    std::vector<std::string> models, scenes; // empty: all
    std::string out = "out/lab";
    bool fresh = false;
};

// Whether a list names it, or none is given.
bool wanted(const std::vector<std::string>& list, const std::string& name);
// The same of a scene's file, by its name without folder and ending.
bool wanted_scene(const std::vector<std::string>& list, const std::string& file);
// Throws Failure, with the nearest name, if one that `option` lists is not among `known`.
void check_known(const char* option, const std::vector<std::string>& list,
                 const std::vector<std::string>& known);
void check_scenes(const std::vector<std::string>& list, const std::vector<std::string>& files);

} // namespace lab
