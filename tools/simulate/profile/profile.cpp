#include "profile.hpp"
#include "common/json_reader.hpp"

#include <algorithm>
#include <cstdio>
#include <numeric>

namespace simulate {

namespace {

template <typename... Values> std::string line(const char* pattern, Values... values) {
    char text[160];
    std::snprintf(text, sizeof text, pattern, values...);
    return std::string(text) + "\n";
}

template <typename List, typename Name> auto& named(List& list, Name member, const char* name) {
    const auto found = std::find_if(list.begin(), list.end(),
                                    [&](const auto& item) { return item.*member == name; });
    if (found != list.end())
        return *found;
    auto& added = list.emplace_back();
    added.*member = name;
    return added;
}

void add_launches(const Timeline& timeline, double frames, Profile& profile) {
    for (const Launch& launch : timeline.launches()) {
        StageProfile& stage = named(profile.stages, &StageProfile::stage, launch.run.stage);
        const auto ns = static_cast<double>(launch.run.end_ns - launch.run.begin_ns);
        stage.calls += 1 / frames;
        stage.us += 1e-3 * ns / frames;
        stage.bytes += static_cast<double>(launch.run.bytes) / frames;
        profile.stages_us += 1e-3 * ns / frames;
    }
    std::stable_sort(profile.stages.begin(), profile.stages.end(),
                     [](const auto& a, const auto& b) { return a.us > b.us; });
}

void add_calls(const Timeline& timeline, double frames, Profile& profile) {
    for (const HostCall& call : timeline.calls())
        if (call.of_frame)
            named(profile.host, &HostProfile::call, call.name).us +=
                1e-3 * static_cast<double>(call.end_ns - call.begin_ns) / frames;
}

double ns_per_vertex(double us, const Profile& profile) {
    return profile.vertices > 0 ? 1e3 * us / profile.vertices : 0.0;
}

std::string share_of_copy(double rate, const Profile& profile) {
    if (profile.copy_rate <= 0)
        return "-";
    char text[16];
    std::snprintf(text, sizeof text, "%.1f%%", 100 * rate / profile.copy_rate);
    return text;
}

std::string stage_line(const StageProfile& stage, const Profile& profile) {
    if (!profile.has_device_times)
        return line("%-18s %8.2f", stage.stage.c_str(), stage.calls);
    const double rate = stage.bytes_per_second();
    return line("%-18s %8.2f %10.1f %10.3f %9.2f %9s", stage.stage.c_str(), stage.calls, stage.us,
                ns_per_vertex(stage.us, profile), 1e-9 * rate,
                share_of_copy(rate, profile).c_str());
}

std::string host_line(const Profile& profile) {
    std::string text = "host, us/frame:";
    for (const HostProfile& call : profile.host) {
        char item[64];
        std::snprintf(item, sizeof item, "%s %s %.1f", &call == profile.host.data() ? "" : ",",
                      call.call.c_str(), call.us);
        text += item;
    }
    return text + "\n";
}

} // namespace

Profile make_profile(const Measurements& run, uint64_t vertices, double copy_rate) {
    Profile profile;
    profile.vertices = static_cast<double>(vertices);
    profile.copy_rate = copy_rate;
    profile.has_device_times = run.timeline.has_device_times();
    if (run.frames == 0)
        return profile;
    const double frames = run.frames;
    profile.frame_us =
        1e3 * std::accumulate(run.frame_ms.begin(), run.frame_ms.end(), 0.0) / frames;
    add_launches(run.timeline, frames, profile);
    add_calls(run.timeline, frames, profile);
    return profile;
}

Json to_json(const Profile& profile) {
    Json stages = Json::array();
    for (const StageProfile& stage : profile.stages)
        stages.push_back({{"stage", stage.stage},
                          {"calls", stage.calls},
                          {"us", stage.us},
                          {"ns_per_vertex", ns_per_vertex(stage.us, profile)},
                          {"bytes", stage.bytes},
                          {"bytes_per_second", stage.bytes_per_second()}});
    Json host = Json::object();
    for (const HostProfile& call : profile.host)
        host[call.call] = call.us;
    return {{"stages", stages},
            {"host_us", host},
            {"stages_us", profile.stages_us},
            {"other_us", profile.other_us()},
            {"frame_us", profile.frame_us},
            {"copy_bytes_per_second", profile.copy_rate},
            {"has_device_times", profile.has_device_times}};
}

std::string to_text(const Profile& profile) {
    if (profile.stages.empty())
        return "no frame was done: there is nothing to profile\n";
    std::string text = profile.has_device_times
                           ? line("%-18s %8s %10s %10s %9s %9s", "stage", "calls", "us/frame",
                                  "ns/vertex", "GB/s", "of a copy")
                           : line("%-18s %8s", "stage", "calls");
    for (const StageProfile& stage : profile.stages)
        text += stage_line(stage, profile);
    if (!profile.has_device_times) {
        text += "the driver's events carry no times: how long stages take is not known here\n";
        text += line("%-18s %8s %10.1f us", "frame", "", profile.frame_us);
        return text + host_line(profile);
    }
    const auto sum = [&](const char* name, double us) {
        return line("%-18s %8s %10.1f %10.3f", name, "", us, ns_per_vertex(us, profile));
    };
    text += sum("all stages", profile.stages_us) + sum("not in a stage", profile.other_us()) +
            sum("frame", profile.frame_us) + host_line(profile);
    if (profile.copy_rate > 0)
        text += line("a copy of memory on this device: %.2f GB/s, read and written",
                     1e-9 * profile.copy_rate);
    return text;
}

} // namespace simulate
