// Paths are UTF-8 in the C API and in messages. Windows would read them in the user's code page.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace plait {

inline std::filesystem::path native_path(std::string_view path) {
#ifdef _WIN32
    return std::u8string(path.begin(), path.end());
#else
    return path;
#endif
}

inline std::string utf8_path(const std::filesystem::path& path) {
#ifdef _WIN32
    const std::u8string text = path.u8string();
    return {text.begin(), text.end()};
#else
    return path.string();
#endif
}

} // namespace plait
