#include "many.hpp"

#include "common/progress.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <map>

namespace simulate {

namespace {

constexpr uint32_t most_parts = 1000000;

std::optional<uint32_t> read_number(std::string_view text) {
    uint32_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty() || error != std::errc() || end != text.data() + text.size())
        return std::nullopt;
    return value;
}

// What each scene leaves under a name of its own lies in its folder.
Json keys_of(const Json& keys, const std::string& folder) {
    Json own = keys;
    own["out"] = folder;
    for (const char* key : {"cache", "json", "trace"})
        if (keys.contains(key))
            own[key] = (std::filesystem::path(folder) / keys.at(key)).string();
    return own;
}

// By a path that leads out of the folder all scenes would write one file.
bool leads_out(const std::filesystem::path& path) {
    const auto normal = path.lexically_normal();
    return path.is_absolute() || (!normal.empty() && *normal.begin() == "..");
}

void check_files(const Json& keys) {
    for (const char* key : {"cache", "json", "trace"}) {
        if (!keys.contains(key))
            continue;
        const auto name = keys.at(key).get<std::string>();
        if (leads_out(name))
            throw Failure("--" + std::string(key) + " is " + name +
                          ", and of several scenes it is a file in the folder of each");
    }
    if (keys.contains("replay"))
        throw Failure("--replay is given, and several scenes, too: it draws one");
}

void say_what_failed(const std::vector<std::string>& failed, size_t of) {
    std::string names;
    for (const std::string& name : failed)
        names += (names.empty() ? "" : ", ") + name;
    std::fprintf(stderr, "plait-simulate: %zu of %zu scenes failed: %s\n", failed.size(), of,
                 names.c_str());
}

} // namespace

Part read_part(const std::string& text) {
    const size_t slash = text.find('/');
    const auto number = read_number(text.substr(0, slash));
    const auto of = slash == std::string::npos ? std::nullopt : read_number(text.substr(slash + 1));
    if (!number || !of)
        throw Failure("--part is \"" + text + "\", not I/N, as 2/5: the second of five parts");
    if (*of < 1 || *of > most_parts)
        throw Failure("--part is " + text + ": N is " + std::to_string(*of) + ", range is [1, " +
                      std::to_string(most_parts) + "]");
    if (*number < 1 || *number > *of)
        throw Failure("--part is " + text + ": I is " + std::to_string(*number) +
                      ", range is [1, " + std::to_string(*of) + "]");
    return {*number, *of};
}

std::vector<SceneJob> scene_jobs(const std::vector<std::string>& files, const Json& keys,
                                 const std::optional<Part>& part) {
    if (part && files.empty())
        throw Failure("--part shares out the scenes of --scene, and none is given");
    if (!part && files.size() < 2)
        return {{files.empty() ? "" : files.front(), "", keys}};
    check_files(keys);
    const std::filesystem::path out = keys.contains("out") ? keys.at("out") : Json("out");
    std::vector<SceneJob> jobs;
    std::map<std::string, std::string> named; // file, by name
    for (size_t i = 0; i < files.size(); ++i) {
        const std::string name = std::filesystem::path(files[i]).stem().string();
        const auto [same, is_new] = named.emplace(name, files[i]);
        if (!is_new)
            throw Failure("two scenes would leave their results in " + (out / name).string() +
                          ": " + same->second + " and " + files[i]);
        if (!part || i % part->of == part->number - 1)
            jobs.push_back({files[i], name, keys_of(keys, (out / name).string())});
    }
    return jobs;
}

Exit do_all(const std::vector<SceneJob>& jobs, const std::function<void(const SceneJob&)>& work) {
    std::vector<std::string> failed;
    Exit worst = Exit::ok;
    const auto fail = [&](const SceneJob& job, const std::exception& failure, Exit exit) {
        std::fprintf(stderr, "plait-simulate: %s\n", failure.what());
        failed.push_back(job.name);
        worst = std::max(worst, exit);
    };
    for (size_t i = 0; i < jobs.size() && !interrupted(); ++i) {
        if (!jobs[i].name.empty())
            std::printf("%sscene %zu of %zu: %s\n", i ? "\n" : "", i + 1, jobs.size(),
                        jobs[i].name.c_str());
        std::fflush(stdout); // before what fails
        try {
            work(jobs[i]);
        } catch (const Failure& failure) {
            fail(jobs[i], failure, failure.exit);
        } catch (const std::exception& failure) {
            fail(jobs[i], failure, Exit::user_error);
        }
        std::fflush(stdout);
    }
    if (!failed.empty() && !failed.front().empty())
        say_what_failed(failed, jobs.size());
    return interrupted() ? ended() : worst;
}

} // namespace simulate
