// Recording a sim to a file, by the functions that every user of the library has.
#include "api/recorder.hpp"

#include "api/objects.hpp"
#include "api/structs.hpp"
#include "api/view.hpp"
#include "core/sim/import_frame.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

struct plait_recorder {
    plait::Memory own;
    plait::api::Recorder recorder;

    plait_recorder(const plait_allocator& allocator, const plait_recorder_desc& desc)
        : own(allocator), recorder(&own, desc) {}
    plait::Memory& memory() { return own; }
};

namespace plait::api {
namespace {

plait_recorder_desc default_recorder_desc() {
    plait_recorder_desc desc{};
    desc.scale = 1;
    desc.frames_per_second = 24;
    return desc;
}

Status check_desc(const plait_recorder_desc& desc) {
    if (desc.strands < 0 || desc.strands > PLAIT_RECORDER_STRANDS_GUIDES)
        return invalid(format("desc->strands is %d, range is [0, %d]",
                              static_cast<int>(desc.strands), PLAIT_RECORDER_STRANDS_GUIDES));
    if (desc.velocities > 1)
        return invalid(format("desc->velocities is %u, range is [0, 1]", desc.velocities));
    if (desc.axes < 0 || desc.axes > PLAIT_AXES_Z_UP_LEFT_HANDED)
        return invalid(format("desc->axes is %d, range is [0, %d]", static_cast<int>(desc.axes),
                              PLAIT_AXES_Z_UP_LEFT_HANDED));
    if (!(desc.scale > 0 && desc.scale <= 1e6f))
        return invalid(
            format("desc->scale is %g, range is (0, 1e6]", static_cast<double>(desc.scale)));
    if (!(desc.frames_per_second >= 1e-3 && desc.frames_per_second <= 1e6))
        return invalid(
            format("desc->frames_per_second is %g, range is [1e-3, 1e6]", desc.frames_per_second));
    return check_allocator(desc.allocator, "desc->allocator");
}

// What a public function that failed has said.
Status passed_on(plait_result result) {
    return result == PLAIT_OK ? Status() : Error{result, plait_last_error()};
}

template <typename T>
Status read_field(plait_sim* sim, plait_field field, std::pmr::vector<T>& values) {
    size_t size = 0;
    PLAIT_TRY(passed_on(plait_sim_read(sim, field, nullptr, &size)));
    values.resize(size / sizeof(T));
    return passed_on(plait_sim_read(sim, field, values.data(), &size));
}

} // namespace

Status Recorder::open(const std::string& path) {
    PLAIT_TRY(copy_view(desc_.widths, 1, "desc->widths", widths_));
    PLAIT_TRY(copy_view(desc_.strand_uv, 2, "desc->strand_uv", uv_));
    for (size_t i = 0; i < widths_.size(); ++i)
        if (!(widths_[i] >= 0 && widths_[i] <= 1))
            return invalid(format("desc->widths[%zu] is %g, range is [0, 1] m", i,
                                  static_cast<double>(widths_[i])));
    ClipRules rules;
    rules.axes = desc_.axes;
    rules.metres_per_unit = 1 / static_cast<double>(desc_.scale);
    rules.frames_per_second = desc_.frames_per_second;
    rules.velocities = desc_.velocities != 0;
    rules.memory = widths_.get_allocator().resource();
    auto clip = make_clip_writer(path, rules);
    PLAIT_TRY(clip);
    clip_ = std::move(*clip);
    path_ = path;
    return {};
}

Status Recorder::check_open() const {
    if (!ended_)
        return {};
    return Error{PLAIT_INVALID_STATE, format("%s: the recording has ended: %s", path_.c_str(),
                                             closed_ ? "it is closed" : "an earlier call failed")};
}

Status Recorder::check_time(double time) const {
    if (std::isfinite(time) && (frames_ == 0 || time > time_))
        return {};
    return invalid(frames_ > 0 ? format("time is %g, range is above that of the frame before, %g s",
                                        time, time_)
                               : format("time is %g, range is finite", time));
}

Status Recorder::read_shape(plait_sim* sim) {
    auto info = plait_sim_info_defaults();
    PLAIT_TRY(passed_on(plait_sim_describe(sim, &info)));
    PLAIT_TRY(read_field(sim, PLAIT_FIELD_VERTEX_COUNT, other_counts_));
    if (desc_.strands == PLAIT_RECORDER_STRANDS_GUIDES)
        other_counts_.resize(info.guides);
    row_ = info.vertices_per_strand;
    return {};
}

// The first shape is the recording's, and the others are held to it.
Status Recorder::take_shape(const char* of) {
    if (frames_ == 0) {
        counts_ = other_counts_;
        return check_metadata();
    }
    if (other_counts_.size() != counts_.size())
        return invalid(
            format("%s %zu strands, the recording %zu", of, other_counts_.size(), counts_.size()));
    const auto [other, own] = std::ranges::mismatch(other_counts_, counts_);
    if (own != counts_.end())
        return invalid(format("strand %td: %s %u vertices, the recording %u", own - counts_.begin(),
                              of, *other, *own));
    return {};
}

Status Recorder::check_metadata() const {
    const size_t strands = counts_.size();
    const size_t vertices = std::accumulate(counts_.begin(), counts_.end(), size_t{0});
    if (widths_.size() > 1 && widths_.size() != strands && widths_.size() != vertices)
        return invalid(
            format("widths of the recorder are %zu; allowed are 0, 1 or one for each of the "
                   "%zu strands or %zu vertices",
                   widths_.size(), strands, vertices));
    if (!uv_.empty() && uv_.size() != 2 * strands)
        return invalid(format("strand_uv of the recorder is for %zu strands, there are %zu",
                              uv_.size() / 2, strands));
    return {};
}

Status Recorder::read_positions(plait_sim* sim) {
    PLAIT_TRY(read_field(sim, PLAIT_FIELD_POSITION, shown_));
    now_.clear();
    for (size_t strand = 0; strand < counts_.size(); ++strand)
        for (size_t vertex = 0; vertex < counts_[strand]; ++vertex) {
            const float* const from = &shown_[4 * (strand * row_ + vertex)];
            now_.insert(now_.end(), from, from + 3);
        }
    return {};
}

// Of the moment in the middle of both, or of one of them where it is the first or the last.
Status Recorder::write_velocities(double from, double to, std::span<const float> begin,
                                  std::span<const float> end) {
    const double seconds = to - from;
    velocities_.resize(end.size());
    for (size_t i = 0; i < end.size(); ++i)
        velocities_[i] =
            seconds > 0 ? static_cast<float>((double(end[i]) - double(begin[i])) / seconds) : 0.0f;
    return clip_->add_velocities(velocities_);
}

Status Recorder::write_frame(double time) {
    if (frames_ == 0) {
        for (float& width : widths_)
            width *= desc_.scale;
        PLAIT_TRY(clip_->begin({counts_, widths_, uv_}));
    }
    PLAIT_TRY(clip_->add_frame(time, now_));
    if (desc_.velocities && frames_ > 0) // of the frame before
        PLAIT_TRY(write_velocities(frames_ > 1 ? time_before_ : time_, time,
                                   frames_ > 1 ? before_ : last_, now_));
    if (desc_.velocities) {
        std::swap(before_, last_);
        std::swap(last_, now_);
    }
    time_before_ = std::exchange(time_, time);
    ++frames_;
    return {};
}

// What now_ has, in metres.
Status Recorder::add_frame(double time) {
    for (size_t at = 0; at < now_.size(); at += 3) {
        float* const p = &now_[at];
        for (int axis = 0; axis < 3; ++axis)
            p[axis] *= desc_.scale;
        turn_to_axes(p, desc_.axes);
    }
    ended_ = true; // unless all of it is written
    PLAIT_TRY(write_frame(time));
    ended_ = false;
    return {};
}

Status Recorder::add(plait_sim* sim, double time) {
    PLAIT_TRY(check_open());
    PLAIT_TRY(check_time(time));
    PLAIT_TRY(read_shape(sim));
    PLAIT_TRY(take_shape("sim has"));
    PLAIT_TRY(read_positions(sim));
    return add_frame(time);
}

Status Recorder::add_positions(const plait_view& counts, const plait_view& positions, double time) {
    PLAIT_TRY(check_open());
    PLAIT_TRY(check_time(time));
    PLAIT_TRY(copy_view(counts, 1, "vertex_counts", other_counts_));
    size_t vertices = 0;
    for (size_t strand = 0; strand < other_counts_.size(); ++strand) {
        const uint32_t count = other_counts_[strand];
        if (count < PLAIT_MIN_VERTICES || count > PLAIT_MAX_VERTICES)
            return invalid(format("vertex_counts[%zu] is %u, range is [%d, %d]", strand, count,
                                  PLAIT_MIN_VERTICES, PLAIT_MAX_VERTICES));
        vertices += count;
    }
    if (positions.count != vertices || vertices == 0)
        return invalid(format("positions.count is %zu, the %zu strands of vertex_counts have %zu "
                              "vertices, range is from 2 on",
                              positions.count, other_counts_.size(), vertices));
    PLAIT_TRY(take_shape("vertex_counts has"));
    PLAIT_TRY(copy_view(positions, 3, "positions", now_));
    return add_frame(time);
}

Status Recorder::end() {
    if (desc_.velocities)
        PLAIT_TRY(write_velocities(time_before_, frames_ > 1 ? time_ : time_before_,
                                   frames_ > 1 ? before_ : last_, last_));
    return clip_->commit();
}

Status Recorder::close() {
    PLAIT_TRY(check_open());
    if (frames_ == 0)
        return Error{PLAIT_INVALID_STATE, format("%s: has no frame yet", path_.c_str())};
    ended_ = true;
    PLAIT_TRY(end());
    closed_ = true;
    return {};
}

} // namespace plait::api

using namespace plait;

extern "C" {

void plait_recorder_desc_init(plait_recorder_desc* desc, size_t size) {
    api::init_struct(desc, size, api::default_recorder_desc());
}

plait_result plait_recorder_create(const char* path, const plait_recorder_desc* desc,
                                   plait_recorder** out) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(path, "path"));
        PLAIT_TRY(api::need(out, "out"));
        plait_recorder_desc given = api::default_recorder_desc();
        if (desc)
            PLAIT_TRY(api::read_struct(desc, given, "desc"));
        PLAIT_TRY(api::check_desc(given));
        Memory memory(given.allocator);
        auto handle = make_in<plait_recorder>(&memory, given.allocator, given);
        PLAIT_TRY(handle->recorder.open(path));
        *out = handle.release();
        return {};
    });
}

plait_result plait_recorder_add(plait_recorder* recorder, plait_sim* sim, double time) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(recorder, "recorder"));
        PLAIT_TRY(api::need(sim, "sim"));
        return recorder->recorder.add(sim, time);
    });
}

plait_result plait_recorder_add_positions(plait_recorder* recorder, const plait_view* vertex_counts,
                                          const plait_view* positions, double time) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(recorder, "recorder"));
        PLAIT_TRY(api::need(vertex_counts, "vertex_counts"));
        PLAIT_TRY(api::need(positions, "positions"));
        return recorder->recorder.add_positions(*vertex_counts, *positions, time);
    });
}

plait_result plait_recorder_close(plait_recorder* recorder) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(recorder, "recorder"));
        return recorder->recorder.close();
    });
}

void plait_recorder_destroy(plait_recorder* recorder) {
    api::destroy(recorder);
}
}
