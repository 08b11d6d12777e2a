#include "choice.hpp"
#include "common/json_reader.hpp"

#include <algorithm>
#include <filesystem>

namespace lab {

namespace {

std::string name_of(const std::string& file) {
    return std::filesystem::path(file).stem().string();
}

} // namespace

bool wanted(const std::vector<std::string>& list, const std::string& name) {
    return list.empty() || std::find(list.begin(), list.end(), name) != list.end();
}

bool wanted_scene(const std::vector<std::string>& list, const std::string& file) {
    return wanted(list, name_of(file));
}

void check_known(const char* option, const std::vector<std::string>& list,
                 const std::vector<std::string>& known) {
    for (const std::string& name : list)
        if (known.empty())
            throw Failure(std::string(option) + ": \"" + name + "\" is none; there are none");
        else if (std::find(known.begin(), known.end(), name) == known.end())
            throw Failure(std::string(option) + ": \"" + name + "\" is none; the nearest is \"" +
                          std::string(nearest(name, known)) + "\"");
}

void check_scenes(const std::vector<std::string>& list, const std::vector<std::string>& files) {
    std::vector<std::string> known;
    for (const std::string& file : files)
        known.push_back(name_of(file));
    check_known("--scenes", list, known);
}

} // namespace lab
