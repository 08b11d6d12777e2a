#include "report.hpp"
#include "common/json_reader.hpp"
#include "common/params_reader.hpp"

#include <plait/plait_profile.h>

#include <algorithm>
#include <cstdio>

namespace simulate {

namespace {

double ms_per_frame(const plait_stage_time& stage, const Measurements& run) {
    return run.frames ? 1e3 * stage.seconds / run.frames : 0.0;
}

Json stage_ms(const Measurements& run) {
    Json stages = Json::object();
    for (const plait_stage_time& stage : run.stages)
        if (stage.calls)
            stages[stage.stage] = ms_per_frame(stage, run);
    return stages;
}

std::string hex(uint64_t value) {
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value));
    return text;
}

Json to_json(const InsideCount& count) {
    return {{"share", count.share()},   {"worst_share", count.worst_share},
            {"deepest", count.deepest}, {"frame", count.frame},
            {"strand", count.strand},   {"vertex", count.vertex}};
}

// null where nothing was looked at.
Json to_json(const InsideReport& inside) {
    if (inside.frames == 0)
        return nullptr;
    Json json = to_json(inside.simulated);
    json["frames"] = inside.frames;
    json["limit"] = InsideReport::limit;
    json["groomed"] = inside.groomed;
    if (inside.following.vertices)
        json["following"] = to_json(inside.following);
    return json;
}

Json to_json(const CrowdHead& head) {
    Json levels = Json::array();
    for (const LevelChange& change : head.levels)
        levels.push_back(
            {{"frame", change.frame}, {"level", change.level}, {"shown", change.shown}});
    return {{"distance", head.distance},
            {"pixels_per_metre", head.pixels_per_metre},
            {"levels", levels}};
}

Json budget_of(const Measurements& run, const CrowdChoice& choice) {
    Json heads = Json::array();
    for (const CrowdHead& head : run.crowd)
        heads.push_back(to_json(head));
    return {{"ms", choice.budget_ms},
            {"median_ms", run.median_ms()},
            {"p95_ms", run.percentile_ms(0.95)},
            {"heads", heads}};
}

void print_budget(const Measurements& run, const CrowdChoice& choice) {
    std::printf("%8s %8s %8s %8s\n", "head at", "level", "strands", "changes");
    for (const CrowdHead& head : run.crowd)
        if (!head.levels.empty())
            std::printf("%6.1f m %8u %8u %8zu\n", static_cast<double>(head.distance),
                        head.levels.back().level, head.levels.back().shown, head.levels.size() - 1);
    std::printf("budget %.2f ms: median frame %.2f ms, 95 of 100 within %.2f ms\n",
                static_cast<double>(choice.budget_ms), run.median_ms(), run.percentile_ms(0.95));
}

Json measured(const Measurements& run) {
    return {{"frames", run.frames},
            {"ms_per_frame", run.median_ms()},
            {"stage_ms", stage_ms(run)},
            {"max_stretch", run.max_stretch},
            {"mean_stretch", run.mean_stretch},
            {"worst_segment",
             {{"frame", run.worst.frame},
              {"strand", run.worst.strand},
              {"segment", run.worst.segment}}},
            {"stretched_frames", run.stretched_frames},
            {"neighbour_speed", run.neighbour_speed ? Json(*run.neighbour_speed) : Json()},
            {"nonfinite", run.nonfinite},
            {"inside", to_json(run.inside)},
            {"grid_outside", run.last.grid_outside},
            {"hash", hex(run.hash)}};
}

void print_stages(const Measurements& run) {
    std::vector<plait_stage_time> stages = run.stages;
    std::sort(stages.begin(), stages.end(),
              [](const auto& a, const auto& b) { return a.seconds > b.seconds; });
    double total = 0.0;
    for (const plait_stage_time& stage : stages)
        total += ms_per_frame(stage, run);
    std::printf("%-18s %10s %8s %8s\n", "stage", "ms/frame", "share", "calls");
    for (const plait_stage_time& stage : stages)
        if (stage.calls)
            std::printf("%-18s %10.3f %7.1f%% %8llu\n", stage.stage, ms_per_frame(stage, run),
                        total > 0.0 ? 100.0 * ms_per_frame(stage, run) / total : 0.0,
                        static_cast<unsigned long long>(stage.calls));
    std::printf("%-18s %10.3f\n", "all stages", total);
}

void print_sag(const plait_sim_info& info) {
    std::printf(
        "sag-free: residual %.1e, %llu joints stiffened, the worst %.1f times; strands that "
        "buckle %llu\n",
        static_cast<double>(info.sag_residual),
        static_cast<unsigned long long>(info.joints_stiffened),
        static_cast<double>(info.worst_stiffening),
        static_cast<unsigned long long>(info.sag_unstable));
}

void print_inside(const char* what, const InsideCount& count) {
    std::printf("inside what is drawn, deeper than %.0f mm: %.3f %% of the vertices %s, %.3f %% in "
                "the worst frame",
                1e3 * static_cast<double>(InsideReport::limit), 100.0 * count.share(), what,
                100.0 * count.worst_share);
    if (count.deepest > 0.0f)
        std::printf("; deepest %.1f mm: vertex %u of strand %u, in frame %u",
                    1e3 * static_cast<double>(count.deepest), count.vertex, count.strand,
                    count.frame);
    std::printf("\n");
}

void print_inside(const InsideReport& inside, bool changes_level) {
    if (inside.frames == 0)
        return;
    print_inside(changes_level ? "that are shown" : "that are simulated", inside.simulated);
    if (inside.following.vertices)
        print_inside("that follow", inside.following);
    if (inside.groomed > 0.0)
        std::printf("as groomed, before the first step: %.3f %%\n", 100.0 * inside.groomed);
}

void print_compared(const std::string& label, const Measurements& run) {
    std::printf("%-50s %9.2f ms/frame, worst stretch %9.2f %%", label.c_str(), run.median_ms(),
                100.0 * static_cast<double>(run.max_stretch));
    if (run.neighbour_speed)
        std::printf(", neighbours apart by %.3f m/s", *run.neighbour_speed);
    std::printf("\n");
}

void print_comparison(const Report& report) {
    for (const Compared& other : report.beside)
        print_compared(other.variant.label, other.run);
    if (!report.beside.empty())
        print_compared(label_of(report.scene), report.main);
}

Json compared(const Compared& other) {
    Json json = measured(other.run);
    json["label"] = other.variant.label;
    json["model"] = model_names[other.variant.sim.model];
    json["grid"] = grid_name(other.variant.sim);
    return json;
}

// How many strands each is of.
Json materials_of(const Report& report) {
    const auto taken = report.figure.of_simulated(
        strand_materials(report.scene.materials, report.figure.groom.get(), report.scene.seed));
    Json list = Json::array();
    for (uint32_t m = 0; m < report.scene.materials.size(); ++m)
        list.push_back({{"name", report.scene.materials[m].name},
                        {"strands", std::count(taken.begin(), taken.end(), m)}});
    return list;
}

} // namespace

Json to_json(const Report& report) {
    const Scene& scene = report.scene;
    Json json = measured(report.main);
    json["device"] = report.main.device.name;
    json["platform"] = report.main.device.platform;
    json["backend"] = report.main.device.backend;
    json["driver"] = report.main.device.driver;
    json["groom"] = scene.groom.name;
    json["motion"] = scene.motion;
    json["model"] = model_names[scene.sim.model];
    json["grid"] = grid_name(scene.sim);
    json["strands"] = report.main.info.strands;
    json["guides"] = report.main.info.guides;
    json["vertices"] = report.main.info.vertices_per_strand;
    json["frames_planned"] = scene.frames();
    json["rate"] = scene.rate;
    json["substeps"] = scene.substeps;
    json["seed"] = scene.seed;
    json["settle"] = scene.settle;
    json["bind"] = bind_names[static_cast<size_t>(scene.bind)];
    json["sag_free"] = sag_free_names[scene.sim.sag_free];
    if (scene.sim.sag_free != PLAIT_SAG_FREE_OFF)
        json["sag"] = {{"residual", report.main.info.sag_residual},
                       {"unstable", report.main.info.sag_unstable},
                       {"joints_stiffened", report.main.info.joints_stiffened},
                       {"worst_stiffening", report.main.info.worst_stiffening}};
    json["device_bytes"] = report.main.info.device_bytes;
    json["groom_strands"] = report.figure.info.strands;
    json["groom_vertices"] = report.figure.info.vertices;
    json["bounds_min"] = report.figure.info.bounds_min;
    json["bounds_max"] = report.figure.info.bounds_max;
    json["mean_length"] = report.figure.info.mean_length;
    json["materials"] = materials_of(report);
    json["scale"] = scene.groom.scale;
    json["warnings"] = report.warnings;
    json["import_repairs"] = report.figure.info.repairs_total;
    json["first_repair"] = report.figure.info.first_repair;
    json["interrupted"] = report.interrupted;
    if (scene.crowd.directed())
        json["budget"] = budget_of(report.main, scene.crowd);
    if (report.profile)
        json["profile"] = to_json(*report.profile);
    json["compared"] = Json::array();
    for (const Compared& other : report.beside)
        json["compared"].push_back(compared(other));
    return json;
}

void print_report(const Report& report) {
    const Measurements& run = report.main;
    std::printf("%s (%s), %llu strands x %u, %u of %u frames%s\n", run.device.name,
                run.device.backend, static_cast<unsigned long long>(run.info.strands),
                run.info.vertices_per_strand, run.frames, report.scene.frames(),
                report.interrupted ? ", interrupted" : "");
    if (report.profile)
        std::fputs(to_text(*report.profile).c_str(), stdout);
    else if (report.scene.crowd.heads == 1) // of several no stage is timed
        print_stages(run);
    std::printf("median frame %.2f ms; worst stretch %.2f %%, mean at the end %.2f %%; non-finite "
                "vertices %llu\n",
                run.median_ms(), 100.0 * static_cast<double>(run.max_stretch),
                100.0 * static_cast<double>(run.mean_stretch),
                static_cast<unsigned long long>(run.nonfinite));
    if (run.max_stretch > 0.0f)
        std::printf(
            "worst segment: %u of strand %u, in frame %u; frames with a segment off by more "
            "than 10 %%: %u\n",
            run.worst.segment, run.worst.strand, run.worst.frame, run.stretched_frames);
    print_inside(run.inside, report.scene.changes_level());
    if (report.scene.crowd.directed())
        print_budget(run, report.scene.crowd);
    if (report.scene.sim.sag_free != PLAIT_SAG_FREE_OFF)
        print_sag(run.info);
    print_comparison(report);
    if (report.figure.info.repairs_total)
        std::printf("%llu repairs at import; the first: %s\n",
                    static_cast<unsigned long long>(report.figure.info.repairs_total),
                    report.figure.info.first_repair);
    for (const std::string& file : report.files)
        std::printf("wrote %s\n", file.c_str());
}

} // namespace simulate
