// plait-simulate: simulate a groom on a moving head and show what came of it.
#include "cache.hpp"
#include "common/devices.hpp"
#include "common/file.hpp"
#include "common/json_reader.hpp"
#include "common/params_list.hpp"
#include "common/presets.hpp"
#include "common/progress.hpp"
#include "options.hpp"
#include "pictures/album.hpp"
#include "pictures/inside.hpp"
#include "profile/ceiling.hpp"
#include "profile/trace.hpp"
#include "recording.hpp"
#include "report.hpp"
#include "restart.hpp"
#include "scene/loaded.hpp"

#include <cstdio>

namespace simulate {

namespace {

std::unique_ptr<Album> make_album(const Scene& scene, const Figure& figure,
                                  const std::vector<Variant>& beside) {
    if (!scene.pictures.wanted)
        return nullptr;
    if (const std::string reason = Album::why_not(); !reason.empty()) {
        std::fprintf(stderr, "plait-simulate: %s\n", reason.c_str());
        return nullptr;
    }
    return std::make_unique<Album>(scene, figure, beside);
}

// A body has its own.
std::unique_ptr<Motion> motion_of(const Scene& scene) {
    return make_motion(scene.body ? "still" : scene.motion);
}

void warn(const std::vector<std::string>& sentences, std::vector<std::string>& all) {
    for (const std::string& sentence : sentences)
        std::fprintf(stderr, "plait-simulate: warning: %s\n", sentence.c_str());
    all.insert(all.end(), sentences.begin(), sentences.end());
}

Watcher watcher_of(Inside& inside) {
    return {[&inside](uint32_t frame) { return inside.wants(frame); },
            [&inside](const Shot& shot) { inside.take(shot); }};
}

Measurements run_scene(const Scene& scene, const Figure& figure, Album* album, Inside& inside,
                       Restart& restart, std::vector<std::string>& warnings) {
    Simulation simulation(scene, figure);
    warn(simulation.take_warnings(), warnings);
    std::vector<Watcher> watchers;
    std::unique_ptr<CacheWriter> cache;
    std::unique_ptr<Recording> recording;
    if (Recording::is_for(scene.cache)) {
        recording = std::make_unique<Recording>(scene.cache, scene, figure);
        watchers.push_back(
            {[](uint32_t) { return true; }, [&](const Shot& shot) { recording->add(shot); }});
    } else if (!scene.cache.empty() && !restart.is_on()) {
        cache =
            std::make_unique<CacheWriter>(scene.cache, simulation.vertex_count(), simulation.row(),
                                          scene.frames(), static_cast<float>(scene.rate));
        watchers.push_back(
            {[](uint32_t) { return true; }, [&](const Shot& shot) { cache->append(shot); }});
    }
    if (album)
        watchers.push_back({[album](uint32_t frame) { return album->wants(frame); },
                            [album](const Shot& shot) { album->take(shot); }});
    watchers.push_back(watcher_of(inside));
    if (restart.is_on()) {
        simulation.restart_by(restart);
        restart.keep_frames(watchers, simulation.vertex_count(), simulation.row());
    }
    Measurements run = simulation.run(*motion_of(scene), watchers, "simulating");
    if (recording)
        recording->close();
    run.inside = inside.finish();
    warn(simulation.take_warnings(), warnings); // of its steps
    return run;
}

// The same hair and motion by other means, for the comparison sheet.
Compared run_beside(const Scene& scene, const Figure& figure, const Variant& variant, size_t index,
                    Album& album, Inside& inside) {
    const std::vector<Watcher> watchers{{[&](uint32_t frame) { return album.wants_beside(frame); },
                                         [&](const Shot& shot) { album.take_beside(index, shot); }},
                                        watcher_of(inside)};
    const Scene other = variant.of(scene);
    Compared beside{variant,
                    Simulation(other, figure).run(*motion_of(scene), watchers, "comparing ")};
    beside.run.inside = inside.finish();
    return beside;
}

void finish_report(Report& report, Album* album) {
    report.interrupted = interrupted();
    if (album)
        report.files = album->finish();
    const Json json = to_json(report);
    for (const std::string& path : {report.scene.out + "/stats.json", report.scene.json})
        if (!path.empty()) {
            write_json(json, path);
            report.files.push_back(path);
        }
    if (!report.scene.trace.empty()) {
        write_text(to_trace(report.main).dump() + '\n', report.scene.trace);
        report.files.push_back(report.scene.trace);
        if (report.main.frames > 0 && !report.main.timeline.has_device_times())
            std::fprintf(stderr, "plait-simulate: the driver's events carry no times: the trace "
                                 "has the host's calls only\n");
    }
    print_report(report);
}

void simulate_scene(Scene& scene) {
    Restart restart(scene);
    if (restart.is_done())
        return;
    const Figure figure = make_figure(scene);
    std::printf("%s\n", loaded_line(scene, figure).c_str());
    if (!figure.notes.empty())
        std::printf("%s: %s\n", scene.groom.name.c_str(), figure.notes.c_str());
    std::fflush(stdout); // before the progress, also into a pipe
    std::vector<std::string> warnings;
    warn(size_warnings(scene, figure), warnings);
    make_folder(scene.out);
    const std::vector<Variant> beside = variants_beside(scene);
    const std::unique_ptr<Album> album = make_album(scene, figure, beside);
    Inside inside(scene, figure);
    Measurements run = run_scene(scene, figure, album.get(), inside, restart, warnings);
    std::optional<Profile> profile;
    if (scene.profile)
        profile = make_profile(run, figure.info.vertices, copy_rate(run.device));
    Report report{scene, figure, std::move(run), std::move(profile), {}, std::move(warnings),
                  false, {}};
    for (size_t i = 0; i < beside.size() && album && !interrupted(); ++i)
        report.beside.push_back(run_beside(scene, figure, beside[i], i, *album, inside));
    finish_report(report, album.get());
    if (!report.interrupted)
        restart.finish();
}

// Draws a trajectory. The scene's groom gives the head, the pivot and the camera.
void replay(Scene scene) {
    CacheReader cache(scene.replay);
    scene.rate = static_cast<uint32_t>(std::max(1.0f, cache.header().rate));
    scene.seconds = static_cast<float>(cache.frames()) / static_cast<float>(scene.rate);
    if (cache.frames() == 0)
        throw Failure(scene.replay + ": holds no whole frame");
    const Figure figure = make_figure(scene);
    make_folder(scene.out);
    const std::unique_ptr<Album> album = make_album(scene, figure, {});
    Progress progress("drawing", cache.frames());
    for (uint32_t frame = 0; frame < cache.frames() && album && !interrupted(); ++frame) {
        if (album->wants(frame))
            album->take(cache.read(frame));
        progress.update(frame + 1);
    }
    std::printf("%u of %u frames\n", cache.frames(), cache.header().frames_planned);
    if (album)
        for (const std::string& file : album->finish())
            std::printf("wrote %s\n", file.c_str());
}

Exit run(const CommandLine& line) {
    if (line.list_devices) {
        print_devices();
        return Exit::ok;
    }
    if (line.list_presets) {
        print_presets();
        return Exit::ok;
    }
    if (line.list_params) {
        print_params();
        return Exit::ok;
    }
    const std::vector<SceneJob> jobs = scene_jobs(line.scene_files, line.keys, line.part);
    if (jobs.empty())
        std::printf("part %u of %u has none of the %zu scenes\n", line.part->number, line.part->of,
                    line.scene_files.size());
    watch_for_interrupt();
    return do_all(jobs, [](const SceneJob& job) {
        Scene scene = make_scene(job.file, job.keys);
        if (scene.replay.empty())
            simulate_scene(scene);
        else
            replay(scene);
    });
}

} // namespace

} // namespace simulate

int main(int argc, char** argv) {
    using namespace simulate;
    const CommandLine line = read_command_line(argc, argv);
    if (line.exit_code)
        return *line.exit_code;
    try {
        return static_cast<int>(run(line));
    } catch (const Failure& failure) {
        std::fprintf(stderr, "plait-simulate: %s\n", failure.what());
        return static_cast<int>(failure.exit);
    } catch (const std::exception& failure) {
        std::fprintf(stderr, "plait-simulate: %s\n", failure.what());
        return static_cast<int>(Exit::user_error);
    }
}
