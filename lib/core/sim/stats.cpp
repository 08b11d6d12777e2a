// Health and cost of a sim.
#include "core/sim/sim.hpp"

#include <plait/params.h>

#include <algorithm>
#include <cmath>

namespace plait {
namespace {

using Float4 =
    std::array<float, 4>; // worst stretch, non-finite vertices, displacement, mean stretch

void reduce(std::span<const Float4> strands, plait_sim_measures& out) {
    double stretch = 0;
    double displacement = 0;
    for (const Float4& s : strands) {
        out.max_stretch = std::max(out.max_stretch, s[0]);
        out.nonfinite += static_cast<uint64_t>(s[1]);
        displacement = std::max(displacement, double(s[2]));
        stretch += double(s[3]);
    }
    out.max_speed = static_cast<float>(displacement);
    out.mean_stretch = static_cast<float>(stretch / double(strands.size()));
}

bool is_allowed(const Float4& acceleration) {
    return std::all_of(acceleration.begin(), acceleration.begin() + 3, [](float a) {
        return std::abs(a) <= PLAIT_MOST_ACCELERATION; // NaN is not
    });
}

} // namespace

void Sim::add_stats() {
    schedule_.add(PLAIT_STAGE_stats, stepped().guides, plait_layout_params{layout_.row},
                  {&state_.rest_length, &state_.vertex_count, &state_.position,
                   &state_.position_prev, &strand_stats_});
}

Status Sim::measure(plait_sim_measures& out) {
    out = {};
    if (!strand_stats_)
        PLAIT_TRY(
            device().create(strand_stats_, PLAIT_ELEMENT_FLOAT4, layout_.guides, "strand_stats"));
    schedule_.clear();
    add_stats();
    PLAIT_TRY(submit());
    std::pmr::vector<Float4> strands(stepped().guides, &context_.memory);
    if (!strands.empty()) {
        PLAIT_TRY(device().read(strand_stats_, 0, strands.size(), strands.data()));
        reduce(strands, out);
    }
    const auto ignored = accelerations_ignored();
    PLAIT_TRY(ignored);
    out.nonfinite += *ignored;
    out.max_speed *= scale_ / substep_length();
    uint32_t outside = 0;
    if (grid_.outside())
        PLAIT_TRY(device().read(grid_.outside(), &outside));
    out.grid_outside = outside;
    uint32_t dropped = 0;
    if (const PairBuffers* pairs = pairs_.buffers())
        PLAIT_TRY(device().read(pairs->dropped, &dropped));
    out.pairs_dropped = dropped;
    return {};
}

// Vertices whose acceleration the stages take as 0. Only a kernel of the caller's, or the caller on
// the device, can have written such a one.
Result<uint64_t> Sim::accelerations_ignored() const {
    if (!state_.acceleration)
        return uint64_t{0};
    std::pmr::vector<uint32_t> counts(layout_.guides, &context_.memory);
    std::pmr::vector<Float4> accelerations(layout_.guide_vertices(), &context_.memory);
    PLAIT_TRY(device().read(state_.vertex_count, 0, counts.size(), counts.data()));
    PLAIT_TRY(device().read(state_.acceleration, accelerations.data()));
    uint64_t ignored = 0;
    for (size_t strand = 0; strand < counts.size(); ++strand)
        for (size_t i = 0; i < counts[strand]; ++i)
            ignored += !is_allowed(accelerations[strand * layout_.row + i]);
    return ignored;
}

uint64_t Sim::device_bytes() const {
    uint64_t bytes = model_->device_bytes() + grid_.device_bytes() + volume_.device_bytes() +
                     display_.device_bytes() + skin_.device_bytes() + binding_.device_bytes() +
                     (3 + pose_before_.size()) * pose_spare_.bytes() + strand_stats_.bytes() +
                     boxes_.bytes() + box_.bytes() + wind_.device_bytes() +
                     (levels_ ? levels_->device_bytes() : 0) + colliders_.device_bytes();
    if (const MeshBuffers* meshes = meshes_.buffers())
        bytes += meshes->bytes();
    bytes += bending_.device_bytes() + taken_.bytes();
    if (const PairBuffers* pairs = pairs_.buffers())
        bytes += pairs->bytes();
    for (const Buffer* buffer : state_.all())
        bytes += buffer->bytes();
    for (const Roots::Poses* each : roots_.all_poses())
        bytes += each->poses.bytes();
    return bytes;
}

// What the device has measured since it was last asked.
struct Sim::Measured {
    explicit Measured(Memory* memory) : launches(memory) {}

    std::array<plait_stage_cost, PLAIT_STAGE_COUNT> costs{};
    std::pmr::vector<plait_stage_launch> launches;
};

Status Sim::take_measured(Measured& out) const {
    PLAIT_TRY(device().stage_costs(out.costs.data(), true));
    size_t count = 0;
    PLAIT_TRY(device().take_launches(nullptr, count));
    out.launches.resize(count);
    if (count > 0)
        PLAIT_TRY(device().take_launches(out.launches.data(), count));
    out.launches.resize(count);
    return {};
}

Status Sim::harvest() {
    Measured measured(&context_.memory);
    PLAIT_TRY(take_measured(measured));
    for (size_t i = 0; i < costs_.size(); ++i)
        costs_[i].seconds += measured.costs[i].seconds;
    for (const plait_stage_launch& launch : measured.launches)
        launches_.add(launch);
    return {};
}

// What was measured before is another sim's, or one's that is gone.
Status Sim::begin_measuring() {
    if (context_.measured == this)
        return {};
    Measured left(&context_.memory);
    PLAIT_TRY(context_.measured ? context_.measured->harvest() : take_measured(left));
    context_.measured = this;
    return {};
}

Result<size_t> Sim::launch_count() {
    if (!context_.profile)
        return Error{PLAIT_INVALID_STATE,
                     "nothing is timed: the context was made with profile 0, 1 is needed"};
    if (context_.measured == this)
        PLAIT_TRY(harvest());
    return launches_.size();
}

size_t Sim::stage_time_count() const {
    return static_cast<size_t>(std::count_if(costs_.begin(), costs_.end(),
                                             [](const auto& cost) { return cost.calls > 0; }));
}

Status Sim::stage_times(std::span<plait_stage_time> dst, bool reset) {
    if (context_.measured == this)
        PLAIT_TRY(harvest());
    auto out = dst.begin();
    for (size_t i = 0; i < costs_.size() && out != dst.end(); ++i) {
        if (costs_[i].calls == 0)
            continue;
        *out = {};
        const std::string_view name = plait_stage_describe(static_cast<plait_stage>(i))->name;
        name.copy(out->stage, sizeof out->stage - 1);
        out->calls = costs_[i].calls;
        out->seconds = costs_[i].seconds;
        ++out;
    }
    if (reset)
        costs_ = {};
    return {};
}

} // namespace plait
