#include "core/sim/context.hpp"

#include "backend/registry.hpp"
#include "base/format.hpp"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstring>
#include <string_view>

namespace plait {
namespace {

bool contains(std::string_view text, std::string_view part) {
    const auto same = [](unsigned char a, unsigned char b) {
        return std::tolower(a) == std::tolower(b);
    };
    return std::search(text.begin(), text.end(), part.begin(), part.end(), same) != text.end();
}

// Whether these words name the device. PoCL calls its devices "pthread-" or "cpu-" and a processor,
// and its platform by its long name: the short one, by which everyone knows it, stands nowhere.
bool is_named(const plait_device_info& info, std::string_view words) {
    const std::string_view type = info.type == PLAIT_DEVICE_TYPE_CPU   ? "cpu"
                                  : info.type == PLAIT_DEVICE_TYPE_GPU ? "gpu"
                                                                       : "";
    const std::string_view short_name =
        contains(info.platform, "Portable Computing Language") ? "pocl" : "";
    for (const std::string_view whole : {type, short_name})
        if (!whole.empty() && words.size() == whole.size() && contains(whole, words))
            return true;
    for (const char* text : {info.name, info.vendor, info.platform})
        if (contains(text, words))
            return true;
    return false;
}

std::string describe(const Candidate& candidate) {
    return format("%s: %s (%s)", candidate.backend->name, candidate.info.name,
                  candidate.info.platform);
}

void append_devices(const plait_backend_api& backend, const Log& log,
                    std::vector<Candidate>& candidates) {
    size_t count = 0;
    plait_result result = backend.enumerate(nullptr, &count);
    std::vector<plait_device_info> infos(count);
    for (plait_device_info& info : infos)
        info.struct_size = sizeof info;
    if (result == PLAIT_OK && count > 0)
        result = backend.enumerate(infos.data(), &count);
    if (result != PLAIT_OK || count == 0) {
        log(PLAIT_LOG_LEVEL_DEBUG,
            format("backend %s: no device: %s", backend.name,
                   result == PLAIT_OK ? "none found" : plait_result_string(result)));
        return;
    }
    const int score = backend.score();
    for (size_t i = 0; i < std::min(count, infos.size()); ++i) {
        std::snprintf(infos[i].backend, sizeof infos[i].backend, "%s", backend.name);
        candidates.push_back({&backend, score, static_cast<uint32_t>(i), infos[i]});
    }
}

// Why the candidate is not what was asked for; "" if it is.
std::string mismatch(const Candidate& candidate, const ContextRules& rules) {
    if (rules.backend && std::strcmp(rules.backend, candidate.backend->name) != 0)
        return format("backend \"%s\" was asked for", rules.backend);
    if (rules.device && !is_named(candidate.info, rules.device))
        return format("device \"%s\" was asked for", rules.device);
    if (!rules.backend && !rules.device && candidate.score < 0)
        return "its backend is used only when it is asked for";
    return {};
}

Error no_device(const ContextRules& rules, const std::vector<Candidate>& candidates) {
    std::string text = "no device";
    if (rules.backend)
        text += format(" of backend \"%s\"", rules.backend);
    if (rules.device)
        text += format(" named like \"%s\"", rules.device);
    text += candidates.empty() ? "; there is none at all" : "; there are: ";
    for (size_t i = 0; i < candidates.size(); ++i)
        text += (i > 0 ? "; " : "") + describe(candidates[i]);
    return {PLAIT_NOT_FOUND, text};
}

Result<Device> open(const Candidate& candidate, const ContextRules& rules) {
    plait_open_info info{};
    info.struct_size = sizeof info;
    info.device_index = candidate.index;
    info.profile = rules.profile;
    info.log = rules.log.callback;
    info.log_user = rules.log.user;
    info.allocator = rules.allocator;
    info.stage_sources = rules.stage_sources;
    info.stage_source_count = rules.stage_source_count;
    info.lanes = rules.lanes;
    info.program_folder = rules.program_folder;
    info.native = rules.native;
    return Device::open(*candidate.backend, info);
}

bool caller_should_see(const ContextRules& rules, plait_result code) {
    return rules.backend || rules.device || rules.native || rules.program_folder ||
           rules.stage_source_count > 0 || code == PLAIT_COMPILE || code == PLAIT_INTERNAL;
}

} // namespace

std::vector<Candidate> list_candidates(const Log& log) {
    std::vector<Candidate> candidates;
    for (size_t i = 0; i < backend_count(); ++i)
        append_devices(*backend_at(i), log, candidates);
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
    return candidates;
}

std::bitset<PLAIT_STAGE_COUNT> replaced_stages(const ContextRules& rules) {
    std::bitset<PLAIT_STAGE_COUNT> replaced;
    for (int i = 0; i < PLAIT_STAGE_COUNT; ++i)
        for (size_t k = 0; k < rules.stage_source_count; ++k)
            if (std::strcmp(rules.stage_sources[k].stage,
                            plait_stage_describe(static_cast<plait_stage>(i))->name) == 0)
                replaced.set(static_cast<size_t>(i));
    return replaced;
}

Result<Device> open_device(const ContextRules& rules) {
    const auto candidates = list_candidates(rules.log);
    std::optional<Error> first_failure;
    for (const Candidate& candidate : candidates) {
        if (const std::string why = mismatch(candidate, rules); !why.empty()) {
            rules.log(PLAIT_LOG_LEVEL_DEBUG, describe(candidate) + ": passed over: " + why);
            continue;
        }
        auto device = open(candidate, rules);
        if (device) {
            rules.log(PLAIT_LOG_LEVEL_INFO, describe(candidate) + ": opened");
            return device;
        }
        if (caller_should_see(rules, device.error().code))
            return device.error();
        rules.log(PLAIT_LOG_LEVEL_WARNING,
                  describe(candidate) + ": rejected: " + device.error().message);
        if (!first_failure)
            first_failure = device.error();
    }
    return first_failure ? *first_failure : no_device(rules, candidates);
}

} // namespace plait
