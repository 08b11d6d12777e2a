// The extension of a path, by which its format is chosen.
#pragma once

#include "base/path.hpp"

#include <algorithm>
#include <string>

namespace plait {

// In lower case.
inline std::string extension_of(const std::string& path) {
    std::string extension = utf8_path(native_path(path).extension());
    std::transform(extension.begin(), extension.end(), extension.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    return extension;
}

} // namespace plait
