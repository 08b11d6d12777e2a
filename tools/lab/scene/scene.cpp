#include "scene.hpp"

#include "common/collider_reader.hpp"
#include "common/json_reader.hpp"
#include "common/params_reader.hpp"
#include "hash.hpp"
#include "methods/models.hpp"
#include "metrics/metrics.hpp"
#include "references/continuum.hpp"
#include "references/modes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lab {

namespace {

Vec3 read_vector(JsonReader& in, const char* key, const Vec3& otherwise) {
    std::array<float, 3> v{};
    if (!in.numbers(key, v, -1e6, 1e6))
        return otherwise;
    return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

Vec3 read_direction(JsonReader& in, const char* key, const Vec3& otherwise) {
    const Vec3 v = read_vector(in, key, otherwise);
    if (!(v.norm() > 0))
        in.fail(key, "is [0,0,0], which has no direction");
    return v.normalized();
}

void read_points(JsonReader& in, const Json& list, Strand& strand) {
    if (!list.is_array() || list.size() < 2 || list.size() > 256)
        in.fail("points", "is no list of 2 to 256 points");
    for (size_t i = 0; i < list.size(); ++i) {
        const Json& p = list[i];
        const bool fine = p.is_array() && p.size() == 3 && p[0].is_number() && p[1].is_number() &&
                          p[2].is_number();
        if (!fine)
            in.fail("points[" + std::to_string(i) + "]", "is " + p.dump() + ", not [x, y, z] in m");
        strand.points.emplace_back(p[0].get<double>(), p[1].get<double>(), p[2].get<double>());
    }
    strand.segments = static_cast<uint32_t>(list.size() - 1);
    strand.root = strand.points.front();
    strand.length = 0;
    for (const double l : strand.segment_lengths())
        strand.length += l;
}

// "angle": degrees above the horizontal in the x-y plane, for those who think in clamps.
void read_aim(JsonReader& in, Strand& strand) {
    static constexpr std::array aims{"tangent", "axis", "segment"};
    double angle = 0;
    const bool has_direction = in.value("direction") != nullptr;
    strand.direction = read_direction(in, "direction", strand.direction);
    if (in.number("angle", angle, -360, 360)) {
        if (has_direction)
            in.fail("angle", "is given beside direction: one of the two");
        strand.direction = Vec3(std::cos(angle * pi / 180), std::sin(angle * pi / 180), 0);
    }
    in.choice("aim", strand.aim, aims);
    in.number("roll", strand.roll, -360, 360);
    if (in.value("towards")) {
        strand.towards = read_direction(in, "towards", Vec3::UnitX());
        if (strand.towards.cross(strand.direction).norm() < 1e-6)
            in.fail("towards", "is along the strand's direction, so it says nothing");
    }
}

Strand read_strand(JsonReader in) {
    Strand strand;
    in.integer("segments", strand.segments, 1, 255);
    in.number("length", strand.length, 1e-6, 1e4);
    strand.root = read_vector(in, "root", strand.root);
    read_aim(in, strand);
    in.number("curvature", strand.curvature, -1e6, 1e6);
    in.number("torsion", strand.torsion, -1e6, 1e6);
    in.number("segment_ratio", strand.segment_ratio, 1e-3, 1e3);
    in.integer("mode", strand.mode, 0, strand.segments);
    in.number("amplitude", strand.amplitude, -0.5, 0.5);
    if (const Json* points = in.value("points"))
        read_points(in, *points, strand);
    if (double gamma = 0; in.number("gamma", gamma, 1e-9, 1e12))
        strand.gamma = gamma;
    in.finish();
    return strand;
}

// Copies of the first strand: over a disc across gravity's axis y, or along a line.
void read_bundle(JsonReader in, std::vector<Strand>& strands) {
    uint32_t count = 1;
    double radius = 0.01;
    in.integer("count", count, 1, 100000);
    in.number("radius", radius, 0, 1e3);
    const bool in_line = in.value("line") != nullptr;
    const Vec3 line = read_vector(in, "line", Vec3::Zero());
    in.finish();
    const Strand first = strands.front();
    for (uint32_t k = 1; k < count; ++k) {
        const double share = std::sqrt((k + 0.5) / count), angle = 2.399963229728653 * k; // golden
        Strand copy = first;
        const double r = radius * share;
        const Vec3 on_disc(r * std::cos(angle), 0, r * std::sin(angle));
        const Vec3 in_row = k * line;
        copy.root += in_line ? in_row : on_disc;
        for (Vec3& point : copy.points)
            point += copy.root - first.root;
        strands.push_back(copy);
    }
}

void read_strands(JsonReader& top, Scene& scene) {
    const Json* one = top.value("strand");
    const Json* many = top.value("strands");
    if (one && many)
        top.fail("strands", "is given beside strand: one of the two");
    if (one)
        scene.strands.push_back(read_strand(top.object(*one, "strand")));
    else if (many && (!many->is_array() || many->empty()))
        top.fail("strands", "is " + many->dump() + ", not a list of strands");
    else if (many)
        for (size_t i = 0; i < many->size(); ++i)
            scene.strands.push_back(read_strand(top.element(*many, i, "strands")));
    else
        scene.strands.emplace_back();
    if (const Json* bundle = top.value("bundle"))
        read_bundle(top.object(*bundle, "bundle"), scene.strands);
    top.integer("follows_per_guide", scene.follows_per_guide, 0, 64);
}

// gamma = rho A g L^3 / EI, of the first strand; 0 or "limp": no weight counts, or no stiffness.
void read_gamma(JsonReader& in, Scene& scene) {
    const Json* gamma = in.value("gamma");
    if (!gamma)
        return;
    if (in.value("bend_stiffness"))
        in.fail("gamma", "is given beside bend_stiffness: one of the two");
    if (*gamma == "limp") {
        scene.material.bend_stiffness = 0;
        return;
    }
    double value = 1;
    in.number("gamma", value, 1e-9, 1e12);
    const double g = scene.gravity.norm();
    if (!(g > 0))
        in.fail("gamma", "needs gravity; without it give bend_stiffness in N m^2");
    scene.material.bend_stiffness =
        scene.material.line_density * g * std::pow(scene.length(), 3) / value;
}

void read_material(JsonReader in, Scene& scene) {
    Material& m = scene.material;
    in.number("line_density", m.line_density, 1e-9, 1e3);
    in.number("bend_stiffness", m.bend_stiffness, 0, 1e3);
    in.number("stretch_stiffness", m.stretch_stiffness, 0, 1e9);
    in.number("twist_ratio", m.twist_ratio, 0, 1e3);
    in.number("tip_stiffness", m.tip_stiffness, 0, 100);
    read_gamma(in, scene);
    in.finish();
}

// A strand's own stiffness reaches the library as a share of the material's.
void check_gammas(JsonReader& top, const Scene& scene) {
    for (const Strand& strand : scene.strands)
        if (strand.gamma && !(scene.material.bend_stiffness > 0 && scene.gravity.norm() > 0))
            top.fail("strands", "have a gamma of their own, which needs gravity and a material "
                                "that bends");
}

void read_time(JsonReader& top, Scene& scene) {
    static constexpr std::array units{"second", "natural", "swing"};
    int unit = 0;
    top.choice("time_unit", unit, units);
    if (unit > 0 && !(scene.gravity.norm() > 0))
        top.fail("time_unit", std::string("is \"") + units[unit] + "\" without gravity");
    if (unit == 1)
        scene.unit_time = std::sqrt(scene.length() / scene.gravity.norm());
    if (unit == 2)
        scene.unit_time = 2 * pi / scene.first_mode(scene.strands.front());
    const double u = scene.unit_time;
    scene.rate *= u; // the defaults are in seconds
    top.number("rate", scene.rate, u, 1e5 * u);
    scene.rate /= u;
    scene.drag *= u;
    scene.settle_drag =
        scene.length() > 0 ? 2.4 * std::sqrt(scene.gravity.norm() / scene.length()) * u : 0;
    top.number("drag", scene.drag, 0, 1e4 * u);
    top.number("settle_drag", scene.settle_drag, 0, 1e4 * u);
    scene.drag /= u;
    scene.settle_drag /= u;
    scene.duration /= u;
    top.number("duration", scene.duration, 0, 1e6);
    top.number("settle", scene.settle, 0, 1e6);
    scene.duration *= u;
    scene.settle *= u;
    if (const double frames = (scene.duration + scene.settle) * scene.rate; frames > 1e6)
        top.fail("duration", "makes " + std::to_string(std::lround(frames)) +
                                 " steps at this rate, outside [0, 1000000]");
}

SceneCollider read_moving(JsonReader in, double unit_time) {
    SceneCollider collider{common::read_collider(in, common::smooth_collider()), {}};
    if (const Json* motion = in.value("motion"))
        collider.motion = read_motion(in, *motion, "motion", unit_time);
    in.finish();
    return collider;
}

TipPin read_tip_pin(JsonReader in) {
    TipPin pin;
    if (!in.value("at"))
        in.fail("at", "is missing: where the tip is drawn to, m");
    pin.at = read_vector(in, "at", Vec3::Zero());
    in.number("stiffness", pin.stiffness, 1e-12, double(PLAIT_PIN_HELD));
    in.finish();
    return pin;
}

// A number, or a property of the scene.
double property(JsonReader& in, const std::string& key, const Json& value, const Scene& scene) {
    if (value.is_number())
        return value.get<double>();
    if (value == "gamma")
        return scene.gamma();
    if (value == "segments")
        return scene.strands.front().segments;
    in.fail(key, "is " + value.dump() + ", neither a number nor \"gamma\" nor \"segments\"");
}

// How many segments a converged reference goes to the limit from: half of them meet at the places
// that are compared.
void read_limit(JsonReader& in, const Scene& scene, Reference& reference) {
    constexpr uint32_t multiple = 2 * places;
    if (!in.integer("segments", reference.segments, multiple, 255))
        return;
    if (reference.converged.empty())
        in.fail("segments", "is given without converged, the model that has them");
    if (reference.segments % multiple != 0)
        in.fail("segments", "is " + std::to_string(reference.segments) + ", no multiple of " +
                                std::to_string(multiple));
    for (const Strand& strand : scene.strands)
        if (!strand.points.empty())
            in.fail("segments", "is given for a strand of points, which has its own");
}

Reference read_reference(JsonReader in, const Scene& scene) {
    static constexpr std::array units{"si", "natural"};
    Reference reference;
    const bool has_table = in.text("table", reference.table);
    if (in.text("converged", reference.converged) && !find_model(reference.converged))
        in.fail("converged", "is \"" + reference.converged +
                                 "\", no known model; the nearest is \"" +
                                 std::string(nearest(reference.converged, model_labels())) + "\"");
    in.flag("plane", reference.plane);
    const int kinds = has_table + !reference.converged.empty() + reference.plane;
    if (kinds != 1)
        in.fail("table", kinds > 1 ? "is given beside converged or plane: one of the three"
                                   : "is missing: a file of tests/data");
    if (in.integer("substeps", reference.substeps, 1, 1000) && reference.converged.empty())
        in.fail("substeps", "is given without converged, the model that takes them");
    read_limit(in, scene, reference);
    int unit = 0;
    in.choice("units", unit, units);
    if (unit == 1) {
        reference.length_unit = scene.length();
        reference.time_unit = std::sqrt(scene.length() / scene.gravity.norm());
    }
    if (const Json* where = in.value("where")) {
        if (!where->is_object())
            in.fail("where", "is " + where->dump() + ", not an object of columns and values");
        for (const auto& [column, value] : where->items())
            reference.where[column] = property(in, "where." + column, value, scene);
    }
    if (const Json* columns = in.value("columns")) {
        const bool fine = columns->is_array() && !columns->empty() && columns->size() <= 3 &&
                          std::all_of(columns->begin(), columns->end(),
                                      [](const Json& name) { return name.is_string(); });
        if (!fine)
            in.fail("columns", "is " + columns->dump() + ", not the names of x, y and z");
        reference.columns = columns->get<std::vector<std::string>>();
    }
    in.finish();
    return reference;
}

void read_pass(JsonReader& in, std::map<std::string, double>& pass) {
    const Json* value = in.value("pass");
    if (!value)
        return;
    if (value->is_number()) {
        pass[""] = value->get<double>();
        return;
    }
    JsonReader each = in.object(*value, "pass");
    for (const std::string& model : model_labels())
        if (double mark = 0; each.number(model.c_str(), mark, 0, 1e9))
            pass[model] = mark;
    if (double mark = 0; each.number("quality", mark, 0, 1e9))
        pass["quality"] = mark;
    if (double mark = 0; each.number("others", mark, 0, 1e9))
        pass[""] = mark;
    each.finish();
}

Measure read_measure(JsonReader in, const Scene& scene) {
    Measure measure;
    if (!in.text("metric", measure.metric))
        in.fail("metric", "is missing: one of " + metric_list());
    if (!is_metric(measure.metric))
        in.fail("metric", "is \"" + measure.metric + "\", no known metric; the nearest is \"" +
                              std::string(nearest(measure.metric, metric_names())) + "\"");
    const double u = scene.unit_time;
    in.number("from", measure.from, 0, 1e9);
    in.number("to", measure.to, measure.from, 1e9);
    measure.from *= u;
    measure.to *= u;
    if (double least = 0; in.number("at_least", least, 0, 1e9))
        measure.at_least = least;
    if (double expect = 0; in.number("expect", expect, -1e9, 1e9))
        measure.expect = expect;
    if (in.value("strand") && is_of_all_strands(measure.metric))
        in.fail("strand", "chooses nothing, \"" + measure.metric + "\" is of all strands");
    in.integer("strand", measure.strand, 0, static_cast<uint32_t>(scene.strands.size() - 1));
    read_pass(in, measure.pass);
    if (const Json* reference = in.value("reference"))
        measure.reference = read_reference(in.object(*reference, "reference"), scene);
    in.finish();
    return measure;
}

void read_measures(JsonReader& top, Scene& scene) {
    if (const Json* reference = top.value("reference"))
        scene.reference = read_reference(top.object(*reference, "reference"), scene);
    top.each(
        "measure", [&](const JsonReader& in) { scene.measures.push_back(read_measure(in, scene)); },
        " of { metric, pass, ... }");
}

void read_method(JsonReader& top, Scene& scene) {
    scene.model = default_model().label;
    if (top.text("model", scene.model) && !find_model(scene.model))
        top.fail("model", "is \"" + scene.model + "\", no known model; the nearest is \"" +
                              std::string(nearest(scene.model, model_labels())) + "\"");
    uint32_t value = 0;
    if (top.integer("substeps", value, 1, 1000))
        scene.substeps = value;
    if (top.integer("iterations", value, 0, 256))
        scene.iterations = value;
    if (top.integer("bdf2", value, 0, 1))
        scene.bdf2 = value;
    top.text("device", scene.device);
    top.text("backend", scene.backend);
}

std::string physics_of(Json document) {
    if (document.is_object())
        for (const char* key : {"title", "model", "substeps", "iterations", "bdf2", "device",
                                "backend", "measure", "reference"})
            document.erase(key);
    return hash_of(document);
}

Json without_segments(Json document) {
    if (document.is_object() && document.contains("strand") && document["strand"].is_object())
        document["strand"].erase("segments");
    return document;
}

} // namespace

double Scene::length() const {
    return strands.front().length;
}

double Scene::gamma() const {
    const double EI = bend_stiffness(strands.front());
    if (!(EI > 0))
        return std::numeric_limits<double>::infinity();
    return material.line_density * gravity.norm() * std::pow(length(), 3) / EI;
}

double Scene::bend_stiffness(const Strand& strand) const {
    if (!strand.gamma)
        return material.bend_stiffness;
    return material.line_density * gravity.norm() * std::pow(strand.length, 3) / *strand.gamma;
}

// Of segments so many that the masses at its tip no longer matter.
double Scene::first_mode(const Strand& strand) const {
    constexpr size_t segments = 200;
    const std::vector<double> lengths(segments, strand.length / segments);
    const HangingChain chain{lengths, 1, true, bend_stiffness(strand) / material.line_density};
    return chain.frequencies(gravity.norm())[0];
}

uint32_t Scene::frames() const {
    return static_cast<uint32_t>(std::lround(duration * rate));
}

uint32_t Scene::settle_frames() const {
    return static_cast<uint32_t>(std::lround(settle * rate));
}

Scene read_scene(const Json& document, const Origin& origin) {
    Scene scene;
    scene.file = origin.file;
    scene.physics = physics_of(document);
    scene.physics_but_segments = physics_of(without_segments(document));
    JsonReader top(document, origin);
    top.text("title", scene.title);
    read_method(top, scene);
    scene.gravity = read_vector(top, "gravity", scene.gravity);
    scene.settle_gravity = read_vector(top, "settle_gravity", scene.gravity);
    read_strands(top, scene);
    if (const Json* material = top.value("material"))
        read_material(top.object(*material, "material"), scene);
    check_gammas(top, scene);
    read_time(top, scene);
    static constexpr std::array airs{"world", "head"};
    int air = 0;
    top.choice("air", air, airs);
    scene.sim.params.air_with_head = static_cast<float>(air);
    scene.sim.model = find_model(scene.model)->model;
    read_grid(top, scene.sim);
    if (const Json* params = top.value("params"))
        read_params(top.object(*params, "params"), scene.sim);
    for (const float knot : scene.sim.material.density_ramp)
        if (knot != 1)
            top.fail("params",
                     "has a density_ramp other than 1: the references are of even strands");
    if (const Json* motion = top.value("motion"))
        scene.motion = read_motion(top, *motion, "motion", scene.unit_time);
    top.each("colliders", [&](const JsonReader& in) {
        scene.colliders.push_back(read_moving(in, scene.unit_time));
    });
    if (const Json* pin = top.value("tip_pin"))
        scene.tip_pin = read_tip_pin(top.object(*pin, "tip_pin"));
    read_measures(top, scene);
    top.finish();
    return scene;
}

Scene read_scene(const std::string& file, const Json& overrides) {
    Origin origin{file, overrides, {}};
    Json document = read_json(origin);
    if (document.is_object())
        document.merge_patch(overrides);
    return read_scene(document, origin);
}

void set_path(Json& overrides, const std::string& path, const Json& value) {
    Json* at = &overrides;
    for (size_t from = 0;;) {
        const size_t dot = path.find('.', from);
        Json& next = (*at)[path.substr(from, dot - from)];
        if (dot == std::string::npos) {
            next = value;
            return;
        }
        if (!next.is_object())
            next = Json::object();
        at = &next;
        from = dot + 1;
    }
}

} // namespace lab
