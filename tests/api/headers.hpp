// The public C headers as texts. plait_opencl.h is left out, because a build without OpenCL does not
// have its functions.
#pragma once

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

inline std::string text_of_header(const std::string& name) {
    std::ifstream stream(PLAIT_SOURCE_DIR "/include/plait/" + name);
    std::stringstream text;
    text << stream.rdbuf();
    return text.str();
}

inline std::set<std::string> names_of_headers() {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(PLAIT_SOURCE_DIR "/include/plait"))
        if (entry.path().extension() == ".h" && entry.path().filename() != "plait_opencl.h")
            names.insert(entry.path().filename().string());
    return names;
}
