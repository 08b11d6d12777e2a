#include "video.hpp"

#include <cstdlib>

namespace simulate {

namespace {

std::string quoted(const std::string& word) {
    std::string quoted = "'";
    for (const char letter : word)
        quoted += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
    return quoted + "'";
}

// setsid: Ctrl-C is for us, who then end the video properly.
std::string command(const std::string& path, uint32_t width, uint32_t height, double rate) {
    const std::string size = std::to_string(width) + "x" + std::to_string(height);
    return "exec setsid ffmpeg -v error -y -f rawvideo -pix_fmt rgb24 -s " + size + " -r " +
           std::to_string(rate) +
           " -i - -vf 'pad=ceil(iw/2)*2:ceil(ih/2)*2' -c:v libx264 "
           "-pix_fmt yuv420p -crf 18 -movflags +faststart " +
           quoted(path);
}

} // namespace

bool Video::possible() {
    return std::system("command -v ffmpeg >/dev/null 2>&1") == 0;
}

Video::Video(const std::string& path, uint32_t width, uint32_t height, double rate)
    : pipe_(popen(command(path, width, height, rate).c_str(), "w")), good_(pipe_ != nullptr) {}

Video::~Video() {
    close();
}

void Video::add(const render::Image& frame) {
    good_ = good_ && std::fwrite(frame.rgb.data(), 1, frame.rgb.size(), pipe_) == frame.rgb.size();
}

bool Video::close() {
    if (pipe_)
        good_ = pclose(pipe_) == 0 && good_;
    pipe_ = nullptr;
    return good_;
}

} // namespace simulate
