#include "video.hpp"

#include <cstdlib>
#include <filesystem>

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
           "-pix_fmt yuv420p -crf 18 -movflags +faststart -f mp4 " +
           quoted(path);
}

bool ffmpeg_is_there() {
    return std::system("command -v ffmpeg >/dev/null 2>&1") == 0;
}

} // namespace

Video::Video(const std::string& stem, uint32_t width, uint32_t height, double rate) {
    if (!ffmpeg_is_there()) {
        path_ = stem + ".gif";
        gif_ = std::make_unique<render::Gif>(path_, static_cast<int>(width),
                                             static_cast<int>(height), rate);
        return;
    }
    path_ = stem + ".mp4";
    partial_ = path_ + ".part";
    pipe_ = popen(command(partial_, width, height, rate).c_str(), "w");
    good_ = pipe_ != nullptr;
}

Video::~Video() {
    if (pipe_)
        pclose(pipe_);
    std::error_code error;
    if (!partial_.empty())
        std::filesystem::remove(partial_, error);
}

void Video::add(const render::Image& frame) {
    if (gif_)
        gif_->add(frame);
    else
        good_ =
            good_ && std::fwrite(frame.rgb.data(), 1, frame.rgb.size(), pipe_) == frame.rgb.size();
}

bool Video::close() {
    if (gif_)
        return gif_->close();
    if (!pipe_)
        return false;
    good_ = pclose(pipe_) == 0 && good_;
    pipe_ = nullptr;
    std::error_code error;
    if (good_)
        std::filesystem::rename(partial_, path_, error);
    return good_ && !error;
}

} // namespace simulate
