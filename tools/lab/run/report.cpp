#include "report.hpp"
#include "common/file.hpp"
#include "common/json_reader.hpp"

#include <cmath>
#include <cstdio>

namespace lab {

namespace {

// The last second of the recording.
Measure at_the_end(const char* metric, const Scene& scene) {
    Measure measure = measure_of(metric);
    measure.from = std::max(0.0, scene.duration - 1);
    return measure;
}

void print_positions(const RunReport& report) {
    const Frame& last = report.recording.frames.back();
    for (size_t s = 0; s < last.x.size(); ++s) {
        std::printf("\nstrand %zu at %.6g s%*sx%*sy%*sz   m\n", s, last.time, 6, "", 13, "", 13,
                    "");
        const size_t step = std::max<size_t>(1, last.x[s].size() / 40);
        for (size_t i = 0; i < last.x[s].size(); ++i)
            if (i % step == 0 || i + 1 == last.x[s].size())
                std::printf("%6zu %19.8g %13.8g %13.8g\n", i, last.x[s][i].x(), last.x[s][i].y(),
                            last.x[s][i].z());
    }
}

void print_cost(const RunReport& report, const Cost& cost) {
    const uint32_t row = report.scene.strands.front().segments + 1;
    std::printf("\ncost, median of %u steps of %llu vertices\n", cost.runs,
                static_cast<unsigned long long>(cost.vertices));
    std::printf("  %-44s %.4g\n", "wall, ns per vertex and step", cost.ns_per_vertex());
    std::printf("  %-44s %.4g\n", "kernels, ns per vertex and step",
                1e9 * cost.kernel / static_cast<double>(cost.vertices));
    std::printf("  %-44s %.4g\n", "wall, ms per 1/60 s and million vertices", cost.ms_per_frame());
    std::printf("  %-44s %.4g\n", "strands of this length in real time at 60 Hz",
                cost.strands_at_60_hz(row));
}

Json positions(const Frame& frame) {
    Json strands = Json::array();
    for (const auto& strand : frame.x) {
        Json list = Json::array();
        for (const Vec3& x : strand)
            list.push_back({x.x(), x.y(), x.z()});
        strands.push_back(list);
    }
    return strands;
}

Json to_json(const Measured& m) {
    Json json{{"metric", m.measure.metric},
              {"value", m.value.value}, // null when it is no number
              {"unit", metric_unit(m.measure.metric)}};
    if (m.verdict != Verdict::none)
        json["verdict"] = m.verdict == Verdict::pass ? "pass" : "miss";
    if (!m.value.note.empty())
        json["note"] = m.value.note;
    return json;
}

Json to_json(const Cost& cost) {
    return {{"vertices", cost.vertices},
            {"runs", cost.runs},
            {"wall_seconds", cost.wall},
            {"kernel_seconds", cost.kernel},
            {"ns_per_vertex", cost.ns_per_vertex()},
            {"ms_per_frame_per_million", cost.ms_per_frame()}};
}

} // namespace

const char* verdict_word(Verdict verdict) {
    return verdict == Verdict::pass ? "pass" : verdict == Verdict::fail ? "MISS" : "";
}

std::string number(double value) {
    if (std::isnan(value))
        return "-";
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

std::vector<Measured> measure_all(const Scene& scene, const Method& method,
                                  const Recording& recording) {
    std::vector<Measure> measures = scene.measures;
    for (const char* metric : {"strain_max", "strain_rest", "energy_rise", "nonfinite"})
        measures.push_back(measure_of(metric));
    measures.push_back(at_the_end("jitter", scene));
    std::vector<Measured> all;
    for (const Measure& measure : measures) {
        const Value value = evaluate(scene, method, recording, measure);
        all.push_back({measure, value, judge(measure, method, value)});
    }
    return all;
}

void print_report(const RunReport& report) {
    const Scene& scene = report.scene;
    std::printf("%s: %s on %s (%s)\n",
                scene.title.empty() ? scene.file.c_str() : scene.title.c_str(),
                report.method.label().c_str(), report.device.name, report.device.backend);
    std::printf(
        "%zu strand%s, the first of %u segments and %.4g m, Gamma %.4g; %.5g Hz, %.4g s%s\n",
        scene.strands.size(), scene.strands.size() > 1 ? "s" : "", scene.strands[0].segments,
        scene.length(), scene.gamma(), scene.rate, scene.duration,
        report.recording.interrupted ? ", interrupted" : "");
    print_positions(report);
    std::printf("\n%-24s %12s %-9s %s\n", "metric", "value", "unit", "");
    for (const Measured& m : report.measured)
        std::printf("%-24s %12.6g %-9s %s %s\n", m.measure.metric.c_str(), m.value.value,
                    metric_unit(m.measure.metric), verdict_word(m.verdict), m.value.note.c_str());
    if (report.cost)
        print_cost(report, *report.cost);
}

void print_json(const RunReport& report) {
    const Scene& scene = report.scene;
    Json json{{"scene", scene.file},
              {"title", scene.title},
              {"model", report.method.model->label},
              {"baseline", report.method.model->baseline()},
              {"substeps", report.method.setting.substeps},
              {"iterations", report.method.setting.iterations},
              {"bdf2", report.method.setting.bdf2},
              {"device", report.device.name},
              {"backend", report.device.backend},
              {"driver", report.device.driver},
              {"segments", scene.strands[0].segments},
              {"length", scene.length()},
              {"gamma", scene.gamma()},
              {"rate", scene.rate},
              {"time", report.recording.frames.back().time},
              {"interrupted", report.recording.interrupted},
              {"positions", positions(report.recording.frames.back())}};
    for (const Measured& m : report.measured)
        json["measured"].push_back(to_json(m));
    if (report.cost)
        json["cost"] = to_json(*report.cost);
    std::fputs(json_text(json).c_str(), stdout);
}

} // namespace lab
