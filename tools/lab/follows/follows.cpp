#include "follows.hpp"

#include "head.hpp"

#include "common/progress.hpp"

#include <plait/plait_offline.h>

#include <algorithm>
#include <memory>

namespace lab::follows {

namespace {

using LearnerHandle =
    std::unique_ptr<plait_follow_learner, Destroyer<plait_follow_learner_destroy>>;

constexpr uint64_t every = 2; // frame is learnt from: those between show little else

void check_guides(const FollowOptions& options) {
    for (const uint32_t guides : options.guides)
        if (guides < 1 || guides >= options.strands)
            throw Failure("--guides has " + std::to_string(guides) + ", range is [1, " +
                          std::to_string(options.strands - 1) + "], the strands less one");
}

// One run of all strands teaches all choices; none where it was interrupted.
std::vector<MapHandle> learn(plait_context* context, const Choice& whole,
                             const std::vector<Choice>& choices, const FollowOptions& options) {
    std::vector<LearnerHandle> learners;
    for (const Choice& choice : choices) {
        plait_follow_learner* learner = nullptr;
        check(plait_follow_learner_create(whole.groom.get(), choice.map.get(), &learner));
        learners.emplace_back(learner);
    }
    Run run(context, whole, whole.map.get());
    const uint64_t frames = frames_of(options.lesson);
    Progress progress("learn", static_cast<uint32_t>(frames));
    for (uint64_t frame = 1; frame <= frames && !interrupted(); ++frame) {
        run.step(frame, shaking);
        const plait_roots roots = shaking(static_cast<double>(frame) / rate);
        if (frame % every == 0) {
            const Hair hair = run.read();
            for (const LearnerHandle& learner : learners)
                check(plait_follow_learner_add_frame(
                    learner.get(), &roots, {hair.x.data(), hair.x.size(), sizeof hair.x[0]}));
        }
        progress.update(static_cast<uint32_t>(frame));
    }
    std::vector<MapHandle> maps;
    if (interrupted())
        return maps;
    for (const LearnerHandle& learner : learners) {
        plait_follow_map* map = nullptr;
        check(plait_follow_learner_learn(learner.get(), &map, nullptr));
        maps.emplace_back(map);
    }
    return maps;
}

struct Entry {
    std::unique_ptr<Run> run;
    Measures measures;
    FollowRow row;
};

Entry entry(plait_context* context, const Choice& choice, const plait_follow_map* map,
            Weights weights) {
    auto run = std::make_unique<Run>(context, choice, map);
    Measures measures(run->read(), run->simulated());
    FollowRow row;
    row.guides = choice.guides;
    row.weights = weights;
    return {std::move(run), std::move(measures), std::move(row)};
}

} // namespace

// Frame by frame, so that a busy machine is busy for all of them.
std::vector<FollowRow> measure_follows(Contexts& contexts, const FollowOptions& options) {
    check_guides(options);
    plait_context* const context = contexts.of(*find_model("articulated"));
    const Choice whole = choose_all(make_hair(options), options.strands);
    std::vector<Choice> choices;
    for (const uint32_t guides : options.guides)
        choices.push_back(choose(whole.groom.get(), guides, options.strands));
    std::vector<MapHandle> learnt;
    if (options.lesson > 0)
        learnt = learn(context, whole, choices, options);
    std::vector<Entry> entries;
    for (size_t i = 0; i < choices.size(); ++i) {
        entries.push_back(entry(context, choices[i], choices[i].map.get(), Weights::near));
        if (!learnt.empty())
            entries.push_back(entry(context, choices[i], learnt[i].get(), Weights::learnt));
    }
    entries.push_back(entry(context, whole, whole.map.get(), Weights::none));
    const uint64_t frames = frames_of(options.seconds);
    Progress progress("follows", static_cast<uint32_t>(frames));
    for (uint64_t frame = 1; frame <= frames && !interrupted(); ++frame) {
        for (Entry& each : entries)
            each.run->step(frame, nodding);
        const Hair truth = entries.back().run->read();
        for (Entry& each : entries)
            each.measures.add(each.run->read(), truth);
        progress.update(static_cast<uint32_t>(frame));
    }
    const double whole_wall = entries.back().run->wall();
    std::vector<FollowRow> rows;
    for (Entry& each : entries) {
        each.row.wall = 1e3 * each.run->wall();
        each.row.of_whole = whole_wall > 0 ? each.run->wall() / whole_wall : 0;
        each.measures.finish(each.row);
        rows.push_back(std::move(each.row));
    }
    return rows;
}

} // namespace lab::follows
