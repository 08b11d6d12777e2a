// What a run keeps beside the positions of its frames, and goes on from.
#include "run.hpp"

#include "restart.hpp"

#include <algorithm>

namespace simulate {

namespace {

Json to_json(const plait_sim_measures& m) {
    return {m.max_stretch, m.mean_stretch, m.max_speed,
            m.nonfinite,   m.grid_outside, m.pairs_dropped};
}

void from_json(const Json& json, plait_sim_measures& m) {
    m.max_stretch = json.at(0);
    m.mean_stretch = json.at(1);
    m.max_speed = json.at(2);
    m.nonfinite = json.at(3);
    m.grid_outside = json.at(4);
    m.pairs_dropped = json.at(5);
}

Json to_json(const std::vector<plait_stage_time>& stages) {
    Json list = Json::array();
    for (const plait_stage_time& stage : stages)
        if (stage.calls > 0)
            list.push_back({stage.stage, stage.calls, stage.seconds});
    return list;
}

Json to_json(const Measurements& run) {
    return {{"frames", run.frames},
            {"frame_ms", run.frame_ms},
            {"last", to_json(run.last)},
            {"max_stretch", run.max_stretch},
            {"mean_stretch", run.mean_stretch},
            {"nonfinite", run.nonfinite},
            {"stretched_frames", run.stretched_frames},
            {"worst", {run.worst.frame, run.worst.strand, run.worst.segment}}};
}

void from_json(const Json& json, Measurements& run) {
    run.frames = json.at("frames");
    run.frame_ms = json.at("frame_ms").get<std::vector<double>>();
    from_json(json.at("last"), run.last);
    run.max_stretch = json.at("max_stretch");
    run.mean_stretch = json.at("mean_stretch");
    run.nonfinite = json.at("nonfinite");
    run.stretched_frames = json.at("stretched_frames");
    const Json& worst = json.at("worst");
    run.worst = {worst.at(0), worst.at(1), worst.at(2)};
}

// Bits go with all of these.
std::string in_words(const plait_device_info& device) {
    return std::string(device.name) + " (" + device.backend + ", " + device.driver + ")";
}

} // namespace

void Simulation::restart_by(Restart& restart) {
    if (std::string(describe_device().backend) == "reference")
        throw Failure("restart_every or resume is given, and the backend reference computes in "
                      "float64, of which a snapshot holds float32: a run that goes on from it "
                      "would come to something else");
    restart_ = &restart;
}

// To `times`, of the stages since the run was taken up.
void Simulation::add_stages_before(std::vector<plait_stage_time>& times) const {
    for (const plait_stage_time& before : stages_before_) {
        const auto at = std::ranges::find_if(
            times, [&](const auto& now) { return std::string(now.stage) == before.stage; });
        if (at == times.end()) {
            times.push_back(before);
        } else {
            at->calls += before.calls;
            at->seconds += before.seconds;
        }
    }
}

void Simulation::keep(const Measurements& measurements) {
    size_t size = 0;
    check(plait_sim_save(sim_.get(), nullptr, &size));
    std::string sim(size, 0);
    check(plait_sim_save(sim_.get(), sim.data(), &size));
    auto stages = stage_times(false);
    add_stages_before(stages);
    Json kept = to_json(measurements);
    kept["stages"] = to_json(stages);
    kept["neighbours"] = {neighbours_->sum().squares, neighbours_->sum().count};
    kept["next_switch"] = next_switch_;
    kept["warnings"] = said_;
    kept["device"] = in_words(describe_device());
    restart_->keep(measurements.frames, kept, std::move(sim));
}

// In place of settling and of the frames that were done.
void Simulation::take_up(Measurements& measurements) {
    const Json& kept = *restart_->begin();
    const std::string& sim = restart_->sim();
    check(plait_sim_restore(sim_.get(), sim.data(), sim.size()));
    from_json(kept, measurements);
    for (const Json& stage : kept.at("stages")) {
        plait_stage_time time{{}, stage.at(1), stage.at(2)};
        stage.at(0).get<std::string>().copy(time.stage, sizeof time.stage - 1);
        stages_before_.push_back(time);
    }
    positions_ = read_positions();
    const Json& neighbours = kept.at("neighbours");
    neighbours_->go_on(positions_, {neighbours.at(0), neighbours.at(1)});
    if (!changes_level())
        measurements.neighbour_speed = neighbours_->rms_speed();
    next_switch_ = kept.at("next_switch");
    said_ = kept.at("warnings").get<std::vector<std::string>>();
    const std::string was = kept.at("device"), is = in_words(describe_device());
    if (was != is)
        said_.push_back("frames up to " + std::to_string(measurements.frames) +
                        " were simulated on " + was + ", the others on " + is +
                        ": they differ by rounding from those of one device");
    stage_times(true);
}

} // namespace simulate
