#include "subjects.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <cstring>

namespace plait::conformance {
namespace {

std::string lower(std::string text) {
    std::ranges::transform(text, text.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

bool is_reference(const plait_device_info& info) {
    return std::strcmp(info.backend, "reference") == 0;
}

std::string suite_name(const plait_device_info& info) {
    if (is_reference(info))
        return "reference";
    std::string name = std::string(info.platform) + "_" + info.name;
    const std::string long_form = "Portable Computing Language";
    if (const size_t at = name.find(long_form); at != std::string::npos)
        name.replace(at, long_form.size(), "PoCL");
    std::ranges::replace_if(
        name, [](unsigned char c) { return !std::isalnum(c); }, '_');
    return name;
}

std::vector<plait_device_info> devices_of(const plait_backend_api& api) {
    size_t count = 0;
    if (api.enumerate(nullptr, &count) != PLAIT_OK || count == 0)
        return {};
    std::vector<plait_device_info> devices(count);
    if (api.enumerate(devices.data(), &count) != PLAIT_OK)
        return {};
    devices.resize(count);
    return devices;
}

} // namespace

Subject::Subject(const plait_backend_api& api, uint32_t index, const plait_device_info& info)
    : api_(api), index_(index), info_(info), name_(suite_name(info)) {}

plait_device* Subject::device() {
    if (!device_ && open_error_.empty()) {
        plait_open_info open = {};
        open.struct_size = sizeof open;
        open.device_index = index_;
        if (const char* lanes = std::getenv("PLAIT_TEST_LANES"); lanes && !is_reference(info_))
            open.lanes = static_cast<uint32_t>(std::stoul(lanes));
        // As plait-bench --local-memory builds the solve.
        std::string text;
        plait_stage_source source = {"articulated", nullptr, "idle_local.cl"};
        if (const char* bytes = std::getenv("PLAIT_TEST_IDLE_LOCAL");
            bytes && !is_reference(info_)) {
            text = std::string("#define PLAIT_IDLE_LOCAL ") + bytes +
                   "\n#include \"strands/articulated.cl\"\n";
            source.source = text.c_str();
            open.stage_sources = &source;
            open.stage_source_count = 1;
        }
        char error[2000] = "";
        plait_device* handle = nullptr;
        if (api_.open(&open, &handle, error, sizeof error) == PLAIT_OK)
            device_ = {handle, api_.device->destroy};
        else
            open_error_ = name_ + " does not open: " + error;
    }
    return device_.get();
}

std::vector<Subject> find_subjects(const std::string& part) {
    std::vector<Subject> subjects;
    for (size_t b = 0; b < plait_backend_count(); ++b) {
        const plait_backend_api& api = *plait_backend_get(b);
        uint32_t index = 0;
        for (const plait_device_info& info : devices_of(api)) {
            const std::string all =
                std::string(info.backend) + " " + info.platform + " " + info.name;
            if (lower(all).find(lower(part)) != std::string::npos)
                subjects.emplace_back(api, index, info);
            ++index;
        }
    }
    return subjects;
}

std::shared_ptr<Subject> find_backend(const std::string& name) {
    for (Subject& subject : find_subjects(name))
        if (name == subject.info().backend)
            return std::make_shared<Subject>(subject);
    return nullptr;
}

} // namespace plait::conformance
