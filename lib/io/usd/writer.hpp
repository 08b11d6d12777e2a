// Curves to USD text: /hair, a transform, above /hair/strands, the curves. Numbers are read back to the
// bit.
#pragma once

#include "io/curves/clip.hpp"

#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace plait {

// Text that goes to a file in pieces that are not small.
class TextFile {
  public:
    explicit TextFile(NewFile file) : file_(std::move(file)), text_(LONG_TEXT) {}

    NewFile& file() { return file_; }
    uint64_t size() const { return file_.size() + used_; }
    Status add(std::string_view text);
    // [1, 2, 3] or, of width 3, [(1, 2, 3), ...].
    Status add_list(std::span<const float> values, size_t width);
    Status add_list(std::span<const uint32_t> values);
    Status flush();

  private:
    static constexpr size_t LONG_TEXT = 1 << 20, LONGEST_NUMBER = 32;

    // For a few numbers and signs between them.
    Status make_room() { return used_ + 4 * LONGEST_NUMBER < LONG_TEXT ? Status() : flush(); }
    void put(float value);
    void put(uint32_t value);
    void put(std::string_view signs) { used_ += signs.copy(&text_[used_], signs.size()); }

    NewFile file_;
    std::vector<char> text_;
    size_t used_ = 0; // bytes of it
};

class UsdClip final : public ClipWriter {
  public:
    static Result<std::unique_ptr<ClipWriter>> create(const std::string& path,
                                                      const ClipRules& rules);

    Status begin(const ClipShape& shape) override;
    Status add_frame(double time, std::span<const float> positions) override;
    Status add_velocities(std::span<const float> velocities) override;
    Status commit() override;

  private:
    UsdClip(NewFile file, const ClipRules& rules) : rules_(rules), out_(std::move(file)) {}

    Status write_header();
    Status write_time(const char* field, uint64_t& at);
    Status patch_time(uint64_t at, double code);
    double code_of(double time) const { return time * rules_.frames_per_second; }
    Status write_extent();
    Status write_velocities();

    ClipRules rules_;
    TextFile out_;
    std::optional<TextFile> velocities_; // beside it, until all points are written
    std::vector<double> codes_;          // of the frames
    std::vector<std::array<float, 6>> extents_;
    float widest_ = 0;
    size_t velocity_frames_ = 0;
    uint64_t start_at_ = 0, end_at_ = 0; // of the codes of the first and the last frame
};

} // namespace plait
