#include "volume.hpp"

#include "ball.hpp"
#include "measures.hpp"

#include "common/progress.hpp"

#include <algorithm>
#include <cmath>

namespace lab::volume {

namespace {

constexpr uint32_t skipped = 2; // steps that are not timed

const Method& method_of(const std::string& name) {
    std::string names;
    for (const Method& method : all_methods()) {
        if (method.name == name)
            return method;
        names += (names.empty() ? "" : ", ") + method.name;
    }
    throw Failure("--methods has " + name + ", there are " + names);
}

// Without any comes first: what a method of the library costs is what its steps take beyond those.
std::vector<const Method*> chosen(const VolumeOptions& options) {
    std::vector<const Method*> methods{&all_methods()[0]};
    for (const std::string& name : options.methods)
        if (const Method& method = method_of(name); &method != methods[0])
            methods.push_back(&method);
    if (options.methods.empty())
        for (size_t i = 1; i < all_methods().size(); ++i)
            methods.push_back(&all_methods()[i]);
    return methods;
}

double least(const std::vector<double>& values) {
    return values.empty() ? 0 : *std::min_element(values.begin(), values.end());
}

// Hair in free fall that drifts, comes together towards its axis and moves at random besides.
std::vector<Vec3> stirred(const Cloud& cloud) {
    std::vector<Vec3> v(cloud.size(), Vec3::Zero());
    uint32_t state = 1;
    const auto draw = [&] {
        state = state * 1664525u + 1013904223u;
        return static_cast<double>(state >> 8) * 0x1p-23 - 1;
    };
    for (size_t i = 0; i < v.size(); ++i) {
        const Vec3 aside(cloud.x[i].x(), 0, cloud.x[i].z());
        const Vec3 own(draw(), draw(), draw());
        if (cloud.moves[i])
            v[i] = Vec3(0.5, 0, 0) - 4 * aside + 0.2 * own;
    }
    return v;
}

// What a step changes of free hair: of the library's methods, velocities beyond those without.
void measure_free(plait_context* context, const VolumeOptions& options,
                  std::vector<VolumeRow>& rows) {
    const Hair hair = free_hair(options.strands);
    Cloud without;
    for (VolumeRow& row : rows) {
        Run run(context, hair, *row.method, options.model, true);
        run.set_velocities(stirred(run.read()));
        run.step();
        Cloud after = run.read();
        if (row.method == &all_methods()[0])
            without = after;
        std::vector<Vec3> changed(after.size(), Vec3::Zero());
        if (const auto change = run.change(after)) {
            for (size_t i = 0; i < changed.size(); ++i) {
                changed[i] = change->velocity[i];
                if (!change->acceleration.empty())
                    changed[i] += change->acceleration[i] / rate;
            }
        } else {
            for (size_t i = 0; i < changed.size(); ++i)
                changed[i] = after.v[i] - without.v[i];
        }
        row.momentum = momentum_change(without, changed);
        row.energy = energy_change(without, changed);
    }
}

} // namespace

// Step by step for all of them, so that a busy machine is busy for all.
std::vector<VolumeRow> measure_volume(Contexts& contexts, const VolumeOptions& options) {
    plait_context* const context = contexts.of(*find_model(options.model));
    const Hair hair = ball_hair(options.strands);
    std::vector<VolumeRow> rows;
    std::vector<std::unique_ptr<Run>> runs;
    std::vector<std::vector<double>> heights, times;
    for (const Method* method : chosen(options)) {
        rows.emplace_back().method = method;
        runs.push_back(std::make_unique<Run>(context, hair, *method, options.model, false));
    }
    heights.resize(rows.size());
    times.resize(rows.size());
    const Cloud rest = runs[0]->read();
    const Room room = room_of(rest);
    const Neighbours neighbours(rest, hair.row);
    const auto steps = static_cast<uint32_t>(std::max(4.0, std::round(options.seconds * rate)));
    Progress progress("volume", steps);
    std::vector<Cloud> before(rows.size(), rest);
    for (uint32_t step = 0; step < steps && !interrupted(); ++step) {
        for (size_t i = 0; i < runs.size(); ++i) {
            runs[i]->step();
            const Cloud cloud = runs[i]->read();
            if (const auto change = runs[i]->change(cloud))
                runs[i]->apply(cloud, *change);
            const Room now = room_of(cloud);
            rows[i].volumes.push_back(now.volume / room.volume);
            heights[i].push_back(now.height / room.height);
            rows[i].jitter = way(before[i], cloud) / strand_length(rest, hair.row);
            if (step + 1 == steps) {
                rows[i].neighbours = neighbours.kept(cloud);
                rows[i].crowd = neighbours.crowd(cloud);
            }
            before[i] = cloud;
            if (step >= skipped)
                times[i].push_back(rows[i].method->program ? runs[i]->program_ms()
                                                           : runs[i]->step_ms());
        }
        progress.update(step + 1);
    }
    const double bare = least(times[0]);
    const auto last_second =
        static_cast<std::ptrdiff_t>(std::min<size_t>(rows[0].volumes.size(), 60));
    for (size_t i = 0; i < rows.size() && last_second > 0; ++i) {
        rows[i].volume = rows[i].volumes.back();
        rows[i].height = heights[i].back();
        rows[i].volume_least =
            *std::min_element(rows[i].volumes.end() - last_second, rows[i].volumes.end());
        rows[i].volume_most = *std::max_element(rows[i].volumes.begin(), rows[i].volumes.end());
        rows[i].height_least = *std::min_element(heights[i].end() - last_second, heights[i].end());
        rows[i].cost = least(times[i]) - (rows[i].method->program ? 0 : bare);
    }
    // by the one that stretches: in the others strands pull their vertices along
    measure_free(contexts.of(*find_model("cosserat")), options, rows);
    return rows;
}

} // namespace lab::volume
