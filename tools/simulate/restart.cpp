#include "restart.hpp"

#include "common/file.hpp"
#include "common/progress.hpp"
#include "recording.hpp"
#include "scene/inputs.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace simulate {

namespace {

constexpr const char *snapshot_name = "restart.snapshot", *frames_name = "restart.frames";
constexpr size_t most_differences = 5; // in a message

// Then `run_size` bytes of CBOR, then the sim's.
struct Head {
    char magic[8];
    uint64_t checksum; // of what follows it
    uint64_t run_size, sim_size;
};
constexpr char restart_magic[8] = {'P', 'L', 'A', 'I', 'T', 'R', 'S', '1'};

uint64_t checksum_of(const std::string& file) {
    constexpr size_t from = offsetof(Head, run_size);
    Checksum sum;
    sum.add(file.data() + from, file.size() - from);
    return sum.value();
}

[[noreturn]] void fail_damaged(const std::string& path, const char* what) {
    throw Failure(path + ": " + what + "; remove it to begin anew");
}

bool all_of_it_wants(const std::vector<Watcher>& watchers, uint32_t frame) {
    return std::ranges::any_of(watchers, [&](const Watcher& w) { return w.wanted(frame); });
}

} // namespace

Snapshot read_snapshot(const std::string& path) {
    std::ifstream stream(path, std::ios::binary);
    const std::string file{std::istreambuf_iterator<char>(stream), {}};
    Head head{};
    if (!stream || file.size() < sizeof head)
        fail_damaged(path, "is no snapshot of a run, or cut short");
    std::memcpy(&head, file.data(), sizeof head);
    if (std::memcmp(head.magic, restart_magic, sizeof restart_magic) != 0)
        fail_damaged(path, "is no snapshot of a run of this version");
    const size_t size = file.size() - sizeof head;
    if (head.run_size > size || head.sim_size != size - head.run_size ||
        head.checksum != checksum_of(file))
        fail_damaged(path, "is damaged or cut short");
    const char* const run = file.data() + sizeof head;
    return {Json::from_cbor(run, run + head.run_size),
            file.substr(sizeof head + head.run_size, head.sim_size)};
}

void write_snapshot(const Snapshot& snapshot, const std::string& path) {
    std::string run;
    Json::to_cbor(snapshot.run, run);
    Head head{{}, 0, run.size(), snapshot.sim.size()};
    std::memcpy(head.magic, restart_magic, sizeof restart_magic);
    std::string file(sizeof head, 0);
    std::memcpy(file.data(), &head, sizeof head);
    file += run + snapshot.sim;
    head.checksum = checksum_of(file);
    std::memcpy(file.data(), &head, sizeof head);
    write_text(file, path);
}

Restart::Restart(const Scene& scene) : scene_(scene), levels_(Json::array()) {
    if (is_on())
        inputs_ = Json::parse(scene.inputs);
    if (std::filesystem::exists(path(snapshot_name)))
        look_at(read_snapshot(path(snapshot_name)));
    if (from_)
        std::printf("%s: going on after frame %u of %u\n", scene.out.c_str(), begin_frame(),
                    scene.frames());
    else if (done_)
        std::printf("%s: is done; remove %s to do it again\n", scene.out.c_str(), snapshot_name);
    else if (scene.resume)
        std::printf("%s: nothing was kept there, beginning anew\n", scene.out.c_str());
    if (!from_ && !done_)
        begin_anew();
}

// What is there is gone on from, or refused, or of no use.
void Restart::look_at(Snapshot&& found) {
    const bool ended = found.run.at("done").get<bool>();
    if (!scene_.resume && !ended)
        throw Failure(path(snapshot_name) + ": a run was cut off here, and kept after frame " +
                      found.run.at("frames").dump() + " of " + found.run.at("planned").dump() +
                      "; --resume goes on with it; remove it to begin anew");
    if (!scene_.resume)
        return;
    check_same(found.run);
    done_ = ended && std::filesystem::exists(path("stats.json"));
    if (!ended)
        from_ = std::move(found);
}

void Restart::begin_anew() {
    std::error_code ignored;
    std::filesystem::remove(path(snapshot_name), ignored);
    std::filesystem::remove(path(frames_name), ignored);
}

void Restart::check_same(const Json& run) const {
    const std::vector<std::string> found = differences(run.at("inputs"), inputs_);
    if (found.empty())
        return;
    std::string list;
    for (size_t i = 0; i < std::min(found.size(), most_differences); ++i)
        list += (i ? "; " : "") + found[i];
    if (found.size() > most_differences)
        list += "; and " + std::to_string(found.size() - most_differences) + " more";
    throw Failure(path(snapshot_name) + ": is of another run: " + list +
                  "; give what was given then, or remove it to begin anew");
}

std::string Restart::frames_path() const {
    const bool has_trajectory = !scene_.cache.empty() && !Recording::is_for(scene_.cache);
    return has_trajectory ? scene_.cache : path(frames_name);
}

void Restart::keep_frames(std::vector<Watcher>& watchers, const std::vector<uint32_t>& vertex_count,
                          uint32_t row) {
    const bool all = frames_path() == scene_.cache;
    std::vector<Watcher> seen = watchers;
    if (all)
        seen.push_back({[](uint32_t) { return true; }, [](const Shot&) {}});
    if (from_)
        show_again(seen, vertex_count, row);
    else
        frames_ = std::make_unique<CacheWriter>(frames_path(), vertex_count, row, scene_.frames(),
                                                static_cast<float>(scene_.rate));
    watchers.push_back({[seen](uint32_t frame) { return all_of_it_wants(seen, frame); },
                        [this](const Shot& shot) { append(shot); }});
}

// As it was shown first.
Shot Restart::placed(Shot shot, uint32_t frame) const {
    shot.frame = frame;
    shot.time = static_cast<float>(frame) / static_cast<float>(scene_.rate);
    const auto all = static_cast<uint32_t>(shot.vertex_count.size());
    uint32_t shown = all;
    for (const Json& level : levels_)
        if (level.at(0).get<uint32_t>() <= frame) {
            shown = level.at(1);
            shot.level = level.at(2);
        }
    if (shown > all)
        fail_damaged(frames_path(), "has fewer strands than were kept");
    shot.vertex_count = shot.vertex_count.first(shown);
    shot.positions = shot.positions.first(size_t{4} * shot.row * shown);
    shot.widen = static_cast<float>(all) / static_cast<float>(shown);
    return shot;
}

void Restart::show_again(const std::vector<Watcher>& watchers, const std::vector<uint32_t>& counts,
                         uint32_t row) {
    const uint32_t frames = begin_frame(), there = from_->run.at("kept_frames");
    levels_ = from_->run.at("levels");
    kept_ = frames;
    CacheReader reader(frames_path());
    if (reader.header().strands != counts.size() || reader.header().row != row ||
        reader.frames() < there)
        fail_damaged(frames_path(), "holds not what was kept");
    Progress progress("kept frames", frames);
    for (uint32_t frame = 0; frame < frames && !interrupted(); ++frame) {
        if (!all_of_it_wants(watchers, frame))
            continue;
        if (frame_count_ == there)
            fail_damaged(frames_path(), "holds not what was kept");
        const Shot shot = placed(reader.read(frame_count_++), frame);
        frame_sum_.add(reader.packed().data(), reader.packed().size_bytes());
        for (const Watcher& watcher : watchers)
            if (watcher.wanted(frame))
                watcher.see(shot);
        progress.update(frame + 1);
    }
    if (!interrupted() && (frame_count_ != there ||
                           frame_sum_.value() != from_->run.at("frames_sum").get<uint64_t>()))
        fail_damaged(frames_path(), "holds not what was kept");
    if (!interrupted())
        frames_ = std::make_unique<CacheWriter>(frames_path(), reader.header(), there);
}

void Restart::append(const Shot& shot) {
    const auto shown = static_cast<uint32_t>(shot.vertex_count.size());
    if (!shot.level.empty() &&
        (levels_.empty() || levels_.back().at(1) != shown || levels_.back().at(2) != shot.level))
        levels_.push_back({shot.frame, shown, shot.level});
    frames_->append(shot);
    ++frame_count_;
    frame_sum_.add(frames_->packed().data(), frames_->packed().size_bytes());
}

void Restart::keep(uint32_t frames, const Json& measured, std::string sim) {
    write_snapshot({{{"inputs", inputs_},
                     {"done", false},
                     {"frames", frames},
                     {"planned", scene_.frames()},
                     {"kept_frames", frame_count_},
                     {"frames_sum", frame_sum_.value()},
                     {"levels", levels_},
                     {"measured", measured}},
                    std::move(sim)},
                   path(snapshot_name));
    kept_ = frames;
}

void Restart::finish() {
    if (!is_on())
        return;
    write_snapshot({{{"inputs", inputs_}, {"done", true}}, ""}, path(snapshot_name));
    frames_.reset();
    std::error_code ignored;
    std::filesystem::remove(path(frames_name), ignored);
}

} // namespace simulate
