#include "bad_input.hpp"
#include "common/collider_reader.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

namespace lab::stability {

using namespace common;

namespace {

constexpr uint32_t vertices = 17;
constexpr size_t neighbours = 6, place = 2; // strands besides, and where the offender stands
constexpr int frames = 60;
constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float inf = std::numeric_limits<float>::infinity();

using Strand = std::vector<std::array<float, 3>>;
using Vertices = std::vector<std::array<float, 4>>;

Strand good_strand(float z) {
    Strand strand;
    for (uint32_t i = 0; i < vertices; ++i)
        strand.push_back({0.3f * static_cast<float>(i) / (vertices - 1), 0, z});
    return strand;
}

// Six strands side by side, and perhaps an offender among them.
std::vector<Strand> strands_with(const std::optional<Strand>& offender) {
    std::vector<Strand> strands;
    for (size_t i = 0; i < neighbours; ++i)
        strands.push_back(good_strand(0.01f * static_cast<float>(i)));
    if (offender)
        strands.insert(strands.begin() + place, *offender);
    return strands;
}

GroomHandle groom_of(const std::vector<Strand>& strands) {
    std::vector<float> positions;
    std::vector<uint32_t> counts;
    for (const Strand& strand : strands) {
        counts.push_back(static_cast<uint32_t>(strand.size()));
        for (const auto& p : strand)
            positions.insert(positions.end(), p.begin(), p.end());
    }
    plait_groom_desc desc = plait_groom_desc_defaults();
    desc.positions = {positions.data(), positions.size() / 3, 0};
    desc.vertex_counts = {counts.data(), counts.size(), 0};
    plait_groom* groom = nullptr;
    check(plait_groom_create(&desc, nullptr, &groom));
    return GroomHandle(groom);
}

SimHandle sim_of(const Subject& subject, const plait_groom* groom) {
    plait::SimDesc desc;
    desc.model = subject.model;
    desc.substeps = subject.substeps;
    desc.params.iterations = subject.iterations;
    desc.params.bdf2 = subject.bdf2;
    plait_sim* sim = nullptr;
    check(plait::create_sim(subject.context, groom, desc, &sim));
    return SimHandle(sim);
}

plait_roots head_at(int frame) {
    plait_roots roots = plait_roots_defaults();
    roots.head = {{0, 0, 0, 1}, {0.05f * std::sin(0.4f * static_cast<float>(frame)), 0, 0}};
    return roots;
}

// Shakes the head for a second; `meddle` may do what it likes before a frame.
Vertices shake(plait_sim* sim, const std::function<void(int)>& meddle = {}) {
    for (int frame = 0; frame < frames; ++frame) {
        const plait_roots roots = head_at(frame);
        check(plait_sim_set_roots(sim, &roots));
        if (meddle)
            meddle(frame);
        check(plait_sim_step(sim, 1.0 / 60));
    }
    size_t size = 0;
    check(plait_sim_read(sim, PLAIT_FIELD_POSITION, nullptr, &size));
    Vertices rows(size / sizeof(Vertices::value_type));
    check(plait_sim_read(sim, PLAIT_FIELD_POSITION, rows.data(), &size));
    return rows;
}

Vertices undisturbed(const Subject& subject) {
    const GroomHandle groom = groom_of(strands_with({}));
    const SimHandle sim = sim_of(subject, groom.get());
    return shake(sim.get());
}

// Vertices without the offender's; whether that is finite goes to `finite`.
Vertices without_offender(Vertices rows, bool& finite) {
    const auto first = rows.begin() + place * vertices, last = first + vertices;
    finite = std::all_of(first, last, [](const auto& p) {
        return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
    });
    rows.erase(first, last);
    return rows;
}

bool same(const Vertices& a, const Vertices& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
}

Verdict verdict_on(const std::string& input, const Vertices& rows, const Vertices& expected,
                   const std::string& report) {
    if (rows.size() == expected.size())
        return {input, same(rows, expected),
                (same(rows, expected) ? "culled: " : "culled, but the others differ: ") + report};
    bool finite = false;
    const bool untouched = same(without_offender(rows, finite), expected);
    if (!untouched)
        return {input, false, "the other strands differ from a run without it"};
    return {input, finite,
            finite ? "finite" + (report.empty() ? "" : ", mended: " + report)
                   : "the offender is not finite"};
}

// Of a groom in which one strand is bad.
Verdict try_strand(const Subject& subject, const std::string& input, const Strand& offender) {
    const GroomHandle groom = groom_of(strands_with(offender));
    plait_groom_info info = plait_groom_info{};
    plait_groom_info_init(&info, sizeof info);
    check(plait_groom_describe(groom.get(), &info));
    const SimHandle sim = sim_of(subject, groom.get());
    return verdict_on(input, shake(sim.get()), undisturbed(subject), info.first_repair);
}

// Of calls that must be refused with a sentence and change nothing.
Verdict try_calls(const Subject& subject, const std::string& input,
                  const std::function<std::vector<plait_result>(plait_sim*)>& calls) {
    const GroomHandle groom = groom_of(strands_with({}));
    const SimHandle sim = sim_of(subject, groom.get());
    size_t taken = 0;
    const Vertices rows = shake(sim.get(), [&](int frame) {
        if (frame != 30)
            return;
        for (const plait_result result : calls(sim.get()))
            taken += result == PLAIT_OK;
    });
    if (taken > 0)
        return {input, false, std::to_string(taken) + " of the calls were taken"};
    const bool untouched = same(rows, undisturbed(subject));
    return {input, untouched,
            untouched ? std::string("refused: ") + plait_last_error()
                      : "refused, but the hair differs from a run without the calls"};
}

// Of a strand's own root pose with this quaternion for one frame.
Verdict try_quaternion(const Subject& subject, const std::string& input,
                       const std::array<float, 4>& q) {
    const GroomHandle groom = groom_of(strands_with(good_strand(0.5f)));
    const SimHandle sim = sim_of(subject, groom.get());
    std::string report;
    const Vertices rows = shake(sim.get(), [&](int frame) {
        if (frame == 0)
            return; // where the hair is, as in the run without
        std::vector<plait_pose> poses(neighbours + 1, plait_pose{{0, 0, 0, 1}, {0, 0, 0}});
        if (frame == 30)
            std::copy(q.begin(), q.end(), poses[place].q);
        plait_roots roots = head_at(frame);
        roots.root_poses = {poses.data(), poses.size(), 0};
        if (plait_sim_set_roots(sim.get(), &roots) != PLAIT_OK)
            report = plait_last_error();
    });
    bool finite = false;
    if (!same(without_offender(rows, finite), undisturbed(subject)))
        return {input, false, "the other strands differ from a run without it"};
    return {input, finite,
            !finite          ? "the offender is not finite"
            : report.empty() ? "finite"
                             : "refused: " + report};
}

Verdict try_nothing(const std::string& input) {
    plait_groom_desc desc = plait_groom_desc_defaults();
    plait_groom* groom = nullptr;
    const plait_result result = plait_groom_create(&desc, nullptr, &groom);
    plait_groom_destroy(groom);
    return {input, result != PLAIT_OK,
            result == PLAIT_OK ? "taken" : std::string("refused: ") + plait_last_error()};
}

Verdict try_folded(const Subject& subject, const std::string& input) {
    const GroomHandle groom = groom_of(strands_with(good_strand(0.5f)));
    const SimHandle sim = sim_of(subject, groom.get());
    const Vertices rows = shake(sim.get(), [&](int frame) {
        if (frame != 0)
            return;
        size_t size = 0;
        check(plait_sim_read(sim.get(), PLAIT_FIELD_POSITION, nullptr, &size));
        Vertices state(size / sizeof(Vertices::value_type));
        check(plait_sim_read(sim.get(), PLAIT_FIELD_POSITION, state.data(), &size));
        for (uint32_t i = 0; i < vertices; ++i)
            state[place * vertices + i][0] *= -1;
        check(plait_sim_write(sim.get(), PLAIT_FIELD_POSITION, state.data(), size));
    });
    return verdict_on(input, rows, undisturbed(subject), "");
}

std::vector<plait_result> bad_numbers(plait_sim* sim) {
    std::vector<plait_result> results;
    const auto with = [&](const std::function<void(plait::SimDesc&)>& change) {
        plait::SimDesc desc;
        check(plait_sim_get_params(sim, &desc.params));
        change(desc);
        results.push_back(plait::set_all(sim, desc));
    };
    with([](plait::SimDesc& d) { d.material.bend_stiffness = -1; });
    with([](plait::SimDesc& d) { d.material.stretch_stiffness = -1; });
    with([](plait::SimDesc& d) { d.material.line_density = 0; });
    with([](plait::SimDesc& d) { d.material.bend_stiffness = nan; });
    with([](plait::SimDesc& d) { d.params.drag = inf; });
    for (const float radius : {0.0f, -1.0f, nan}) {
        plait_collider_desc collider = common::smooth_collider();
        collider.capsule.radius_a = collider.capsule.radius_b = radius;
        plait_collider_id id{};
        results.push_back(plait_collider_create(sim, &collider, &id));
    }
    for (const double dt : {-1.0, double(nan), double(inf)})
        results.push_back(plait_sim_step(sim, dt));
    return results;
}

std::vector<plait_result> bad_roots(plait_sim* sim) {
    std::vector<plait_result> results;
    for (const float bad : {nan, inf}) {
        plait_roots roots = head_at(0);
        roots.head.t[1] = bad;
        results.push_back(plait_sim_set_roots(sim, &roots));
        roots = head_at(0);
        roots.head.q[2] = bad;
        results.push_back(plait_sim_set_roots(sim, &roots));
    }
    return results;
}

using Try = std::function<Verdict(const Subject&, const std::string&)>;

Try strand(const std::function<void(Strand&)>& spoil) {
    return [spoil](const Subject& subject, const std::string& input) {
        Strand offender = good_strand(0.5f);
        spoil(offender);
        return try_strand(subject, input, offender);
    };
}

Try quaternion(const std::array<float, 4>& q) {
    return [q](const Subject& subject, const std::string& input) {
        return try_quaternion(subject, input, q);
    };
}

void scale_to(Strand& s, float spacing, float at) {
    for (size_t i = 0; i < s.size(); ++i)
        s[i] = {at + spacing * static_cast<float>(i), at, at};
}

const std::vector<std::pair<std::string, Try>>& all() {
    static const std::vector<std::pair<std::string, Try>> tries{
        {"zero-length segment", strand([](Strand& s) { s[9] = s[8]; })},
        {"all vertices coincident", strand([](Strand& s) { scale_to(s, 0, 0.5f); })},
        {"one vertex", strand([](Strand& s) { s.resize(1); })},
        {"two vertices", strand([](Strand& s) { s.resize(2); })},
        {"no strands", [](const Subject&, const std::string& input) { return try_nothing(input); }},
        {"NaN position", strand([](Strand& s) { s[5][1] = nan; })},
        {"infinite position", strand([](Strand& s) { s[5][1] = inf; })},
        {"NaN root for a frame",
         [](const Subject& subject, const std::string& input) {
             return try_calls(subject, input, bad_roots);
         }},
        {"zero quaternion", quaternion({0, 0, 0, 0})},
        {"quaternion of length 3", quaternion({0, 0, 0, 3})},
        {"coordinates of 1e6 m", strand([](Strand& s) { scale_to(s, 0.3f / 16, 0.9e6f); })},
        {"lengths of 1e-40 m", strand([](Strand& s) { scale_to(s, 1e-40f, 0); })},
        {"negative stiffness, radius, dt",
         [](const Subject& subject, const std::string& input) {
             return try_calls(subject, input, bad_numbers);
         }},
        {"folded against rest", try_folded},
    };
    return tries;
}

} // namespace

std::vector<std::string> bad_inputs() {
    std::vector<std::string> names;
    for (const auto& [name, attempt] : all())
        names.push_back(name);
    return names;
}

Verdict try_bad_input(const Subject& subject, const std::string& input) {
    for (const auto& [name, attempt] : all())
        if (name == input)
            return attempt(subject, input);
    throw Failure("no bad input is called \"" + input + "\"");
}

} // namespace lab::stability
