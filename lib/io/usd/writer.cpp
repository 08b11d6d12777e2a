#include "io/usd/writer.hpp"

#include "io/curves/number.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <utility>

namespace plait {
namespace {

constexpr size_t TIME_WIDTH = 24; // room for a time that is not known yet

std::array<float, 6> extent_of(std::span<const float> positions) {
    constexpr float most = std::numeric_limits<float>::max();
    std::array<float, 6> extent{most, most, most, -most, -most, -most};
    for (size_t i = 0; i + 2 < positions.size(); i += 3)
        for (size_t k = 0; k < 3; ++k) {
            extent[k] = std::min(extent[k], positions[i + k]);
            extent[3 + k] = std::max(extent[3 + k], positions[i + k]);
        }
    return extent;
}

} // namespace

Status TextFile::flush() {
    const size_t used = std::exchange(used_, 0);
    return file_.write(std::as_bytes(std::span(text_).first(used)));
}

Status TextFile::add(std::string_view text) {
    while (!text.empty()) {
        PLAIT_TRY(make_room());
        const std::string_view piece = text.substr(0, LONGEST_NUMBER);
        put(piece);
        text.remove_prefix(piece.size());
    }
    return {};
}

void TextFile::put(float value) {
    char* const first = &text_[used_];
    used_ += static_cast<size_t>(put_number(first, value) - first);
}

void TextFile::put(uint32_t value) {
    char* const first = &text_[used_];
    used_ += static_cast<size_t>(std::to_chars(first, first + LONGEST_NUMBER, value).ptr - first);
}

Status TextFile::add_list(std::span<const float> values, size_t width) {
    PLAIT_TRY(add("["));
    for (size_t i = 0; i < values.size(); i += width) {
        PLAIT_TRY(make_room());
        put(std::string_view(i == 0 ? "" : ", "));
        put(std::string_view(width > 1 ? "(" : ""));
        for (size_t k = 0; k < width; ++k) {
            put(std::string_view(k == 0 ? "" : ", "));
            put(values[i + k]);
        }
        put(std::string_view(width > 1 ? ")" : ""));
    }
    return add("]");
}

Status TextFile::add_list(std::span<const uint32_t> values) {
    PLAIT_TRY(add("["));
    for (size_t i = 0; i < values.size(); ++i) {
        PLAIT_TRY(make_room());
        put(std::string_view(i == 0 ? "" : ", "));
        put(values[i]);
    }
    return add("]");
}

Result<std::unique_ptr<ClipWriter>> UsdClip::create(const std::string& path,
                                                    const ClipRules& rules) {
    if (rules.axes != PLAIT_AXES_Y_UP && rules.axes != PLAIT_AXES_Z_UP)
        return Error{PLAIT_UNSUPPORTED,
                     format("%s: axes are left-handed (%d); those of USD are Y_UP (0) and Z_UP (1)",
                            path.c_str(), static_cast<int>(rules.axes))};
    auto file = NewFile::create(path);
    PLAIT_TRY(file);
    std::unique_ptr<UsdClip> clip(new UsdClip(std::move(*file), rules));
    if (rules.velocities) {
        auto beside = NewFile::create(path);
        PLAIT_TRY(beside);
        clip->velocities_.emplace(std::move(*beside));
    }
    return std::unique_ptr<ClipWriter>(std::move(clip));
}

Status UsdClip::write_time(const char* field, uint64_t& at) {
    PLAIT_TRY(out_.add(format("    %s = ", field)));
    at = out_.size();
    return out_.add(std::string(TIME_WIDTH, ' ') + "\n");
}

Status UsdClip::patch_time(uint64_t at, double code) {
    const std::string text = number_text(code);
    return out_.file().patch(at, std::as_bytes(std::span(text)));
}

Status UsdClip::write_header() {
    PLAIT_TRY(out_.add(format("#usda 1.0\n(\n    \"plait %d.%d.%d\"\n    defaultPrim = \"hair\"\n"
                              "    metersPerUnit = %s\n    upAxis = \"%s\"\n",
                              PLAIT_VERSION_MAJOR, PLAIT_VERSION_MINOR, PLAIT_VERSION_PATCH,
                              number_text(rules_.metres_per_unit).c_str(),
                              rules_.axes == PLAIT_AXES_Z_UP ? "Z" : "Y")));
    if (rules_.moves) {
        const std::string rate = number_text(rules_.frames_per_second);
        PLAIT_TRY(out_.add(format("    framesPerSecond = %s\n    timeCodesPerSecond = %s\n",
                                  rate.c_str(), rate.c_str())));
        PLAIT_TRY(write_time("startTimeCode", start_at_));
        PLAIT_TRY(write_time("endTimeCode", end_at_));
    }
    return out_.add(")\n\ndef Xform \"hair\"\n{\n    def BasisCurves \"strands\"\n    {\n"
                    "        uniform token type = \"linear\"\n"
                    "        uniform token wrap = \"nonperiodic\"\n");
}

Status UsdClip::begin(const ClipShape& shape) {
    PLAIT_TRY(write_header());
    PLAIT_TRY(out_.add("        int[] curveVertexCounts = "));
    PLAIT_TRY(out_.add_list(shape.vertex_counts));
    PLAIT_TRY(out_.add("\n"));
    if (!shape.widths.empty()) {
        std::pmr::vector<float> widths(rules_.memory);
        append_widths(shape, widths);
        widest_ = *std::ranges::max_element(shape.widths);
        PLAIT_TRY(out_.add("        float[] widths = "));
        PLAIT_TRY(out_.add_list(widths, 1));
        PLAIT_TRY(out_.add(" (\n            interpolation = \"vertex\"\n        )\n"));
    }
    if (!shape.uv.empty()) {
        PLAIT_TRY(out_.add("        texCoord2f[] primvars:st = "));
        PLAIT_TRY(out_.add_list(shape.uv, 2));
        PLAIT_TRY(out_.add(" (\n            interpolation = \"uniform\"\n        )\n"));
    }
    return out_.add(rules_.moves ? "        point3f[] points.timeSamples = {\n"
                                 : "        point3f[] points = ");
}

Status UsdClip::add_frame(double time, std::span<const float> positions) {
    codes_.push_back(code_of(time));
    extents_.push_back(extent_of(positions));
    if (rules_.moves)
        PLAIT_TRY(out_.add("            " + number_text(codes_.back()) + ": "));
    PLAIT_TRY(out_.add_list(positions, 3));
    return out_.add(rules_.moves ? ",\n" : "\n");
}

Status UsdClip::add_velocities(std::span<const float> velocities) {
    PLAIT_TRY(velocities_->add("            " + number_text(codes_[velocity_frames_++]) + ": "));
    PLAIT_TRY(velocities_->add_list(velocities, 3));
    return velocities_->add(",\n");
}

// Of points, and as wide as curves are.
Status UsdClip::write_extent() {
    PLAIT_TRY(out_.add(rules_.moves ? "        float3[] extent.timeSamples = {\n"
                                    : "        float3[] extent = "));
    for (size_t i = 0; i < extents_.size(); ++i) {
        for (size_t k = 0; k < 6; ++k)
            extents_[i][k] += k < 3 ? -widest_ / 2 : widest_ / 2;
        if (rules_.moves)
            PLAIT_TRY(out_.add("            " + number_text(codes_[i]) + ": "));
        PLAIT_TRY(out_.add_list(extents_[i], 3));
        PLAIT_TRY(out_.add(rules_.moves ? ",\n" : "\n"));
    }
    return out_.add(rules_.moves ? "        }\n" : "");
}

Status UsdClip::write_velocities() {
    PLAIT_TRY(out_.add("        vector3f[] velocities.timeSamples = {\n"));
    PLAIT_TRY(out_.flush());
    PLAIT_TRY(velocities_->flush());
    PLAIT_TRY(velocities_->file().copy_to(out_.file()));
    return out_.add("        }\n");
}

Status UsdClip::commit() {
    PLAIT_TRY(out_.add(rules_.moves ? "        }\n" : ""));
    PLAIT_TRY(write_extent());
    if (velocities_)
        PLAIT_TRY(write_velocities());
    PLAIT_TRY(out_.add("    }\n}\n"));
    PLAIT_TRY(out_.flush());
    if (rules_.moves) {
        PLAIT_TRY(patch_time(start_at_, codes_.front()));
        PLAIT_TRY(patch_time(end_at_, codes_.back()));
    }
    return out_.file().commit();
}

} // namespace plait
