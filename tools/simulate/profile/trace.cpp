#include "trace.hpp"
#include "common/json_reader.hpp"

#include <algorithm>
#include <limits>

namespace simulate {

namespace {

constexpr int process = 1, host_thread = 1, device_thread = 2;

// ns that the device's clock is ahead of the host's. What a frame's calls enqueue was queued inside
// of them, so every frame bounds it on both sides, and all frames together closely.
int64_t clock_difference(const Timeline& timeline) {
    int64_t least = std::numeric_limits<int64_t>::min(), most = std::numeric_limits<int64_t>::max();
    auto launch = timeline.launches().begin();
    const auto end = timeline.launches().end();
    for (auto call = timeline.calls().begin(); call != timeline.calls().end();) {
        const uint32_t frame = call->frame;
        uint64_t begin = std::numeric_limits<uint64_t>::max(), over = 0;
        for (; call != timeline.calls().end() && call->frame == frame; ++call)
            if (call->enqueues) {
                begin = std::min(begin, call->begin_ns);
                over = std::max(over, call->end_ns);
            }
        for (; launch != end && launch->frame == frame; ++launch)
            if (launch->run.end_ns > launch->run.begin_ns && over > 0) {
                const auto queued = static_cast<int64_t>(launch->run.queued_ns);
                least = std::max(least, queued - static_cast<int64_t>(over));
                most = std::min(most, queued - static_cast<int64_t>(begin));
            }
    }
    const bool known = least > std::numeric_limits<int64_t>::min();
    return known ? least + (most - least) / 2 : 0;
}

// Times of the format are us, in doubles: from the beginning of the run, so that none is rounded.
Json event(const char* name, const char* category, int thread, int64_t begin_ns, uint64_t ns) {
    return {{"name", name},
            {"cat", category},
            {"ph", "X"},
            {"pid", process},
            {"tid", thread},
            {"ts", 1e-3 * static_cast<double>(begin_ns)},
            {"dur", 1e-3 * static_cast<double>(ns)}};
}

Json name_of(const char* what, int thread, const std::string& name) {
    return {
        {"name", what}, {"ph", "M"}, {"pid", process}, {"tid", thread}, {"args", {{"name", name}}}};
}

void add_calls(const Timeline& timeline, uint64_t start, Json& events) {
    for (const HostCall& call : timeline.calls()) {
        Json json = event(call.name, "host", host_thread,
                          static_cast<int64_t>(call.begin_ns - start), call.end_ns - call.begin_ns);
        json["args"] = {{"frame", call.frame}};
        events.push_back(std::move(json));
    }
}

void add_launches(const Timeline& timeline, uint64_t start, Json& events) {
    const int64_t ahead = clock_difference(timeline) + static_cast<int64_t>(start);
    for (const Launch& launch : timeline.launches()) {
        const plait_launch& run = launch.run;
        if (run.end_ns <= run.begin_ns)
            continue;
        const uint64_t ns = run.end_ns - run.begin_ns;
        Json json = event(run.stage, "stage", device_thread,
                          static_cast<int64_t>(run.begin_ns) - ahead, ns);
        json["args"] = {{"frame", launch.frame},
                        {"items", run.items},
                        {"bytes", run.bytes},
                        {"GB/s", static_cast<double>(run.bytes) / static_cast<double>(ns)}};
        events.push_back(std::move(json));
    }
}

} // namespace

Json to_trace(const Measurements& run) {
    const Timeline& timeline = run.timeline;
    const uint64_t start = timeline.calls().empty() ? 0 : timeline.calls().front().begin_ns;
    Json events = Json::array({name_of("process_name", host_thread, "plait-simulate"),
                               name_of("thread_name", host_thread, "host"),
                               name_of("thread_name", device_thread, run.device.name)});
    add_calls(timeline, start, events);
    add_launches(timeline, start, events);
    return {{"traceEvents", std::move(events)},
            {"displayTimeUnit", "ms"},
            {"otherData",
             {{"device", run.device.name},
              {"platform", run.device.platform},
              {"driver", run.device.driver},
              {"has_device_times", timeline.has_device_times()}}}};
}

} // namespace simulate
