#include "whole_file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace plait_groom_tool {

std::string write_whole(const std::string& text, const std::string& path) {
    const std::string part = path + ".part";
    std::FILE* file = std::fopen(part.c_str(), "wb");
    bool good = file && std::fwrite(text.data(), 1, text.size(), file) == text.size();
    if (file)
        good = std::fclose(file) == 0 && good;
    if (good && std::rename(part.c_str(), path.c_str()) == 0)
        return {};
    const std::string reason = std::strerror(errno);
    std::remove(part.c_str());
    return path + ": " + reason;
}

} // namespace plait_groom_tool
