// A baseline's kernel as one text: plait_stage_source takes one, and resolves only the headers in
// plait's cl/, so what a baseline includes from its own folder is pasted in here.
#pragma once

#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>

namespace lab {

// The name in `#include "name"`, if a line is one.
inline std::optional<std::string> included(const std::string& line) {
    constexpr char head[] = "#include \"";
    const size_t end = line.find('"', sizeof head - 1);
    if (!line.starts_with(head) || end == line.npos)
        return {};
    return line.substr(sizeof head - 1, end - (sizeof head - 1));
}

// @throws std::runtime_error if folder/name cannot be read.
inline std::string baseline_source(const std::string& folder, const std::string& name) {
    std::ifstream file(folder + "/" + name);
    if (!file)
        throw std::runtime_error(folder + "/" + name + ": cannot be read");
    std::ostringstream text;
    for (std::string line; std::getline(file, line);) {
        const auto include = included(line);
        if (include && std::ifstream(folder + "/" + *include))
            text << baseline_source(folder, *include);
        else
            text << line << '\n';
    }
    return text.str();
}

} // namespace lab
