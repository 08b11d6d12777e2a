#include "core/levels/director.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plait {
namespace {

// ms of one core, of strands that meet bodies and of those that do not, per vertex: measured with
// `long` and two cores. What counts is how they compare; the price takes the rest.
constexpr double work_of_sim = 0.1; // but for rigid hair
constexpr double guide_with_bodies = 1.06e-4, shown_with_bodies = 2.8e-5;
constexpr double guide_alone = 3.1e-5, shown_alone = 1.4e-5;

constexpr double safety = 1.5;              // nothing untaught was further off in 89 of 100 motions
constexpr double bias = 1.25;               // by which what is taken now is preferred: no flicker
constexpr double keeps_budget = 1.05;       // for what is taken now
constexpr double adds_budget = 0.95;        // for what is added
constexpr double out_of_sight = 1;          // s until hair that nobody sees goes rigid
constexpr double rises = 0.05, falls = 0.5; // s, in which the price follows what is measured
constexpr double most_rise = 2;             // of what it is, so far at once
constexpr double remembers = 2;             // s, of how time goes with work

double square(double x) {
    return x * x;
}

double guide_work(const DirectedHair& hair, uint32_t level) {
    if (hair.guides[level] == 0)
        return 0;
    return work_of_sim + (hair.meets_bodies ? guide_with_bodies : guide_alone) * hair.substeps *
                             hair.vertices * hair.guides[level];
}

double shown_work(const DirectedHair& hair, uint32_t shown) {
    return (hair.meets_bodies ? shown_with_bodies : shown_alone) * hair.vertices * shown;
}

double work_of(const DirectedHair& hair, LevelChoice choice) {
    return guide_work(hair, choice.level) + shown_work(hair, choice.shown);
}

// px: its motion is wrong by that much.
double motion_error(const DirectedHair& hair, uint32_t level) {
    return safety * hair.share[level] * hair.swing * hair.pixels_per_metre;
}

// px: hairs that stand for many are drawn so much wider than hair.
double width_error(const DirectedHair& hair, const DirectorGoal& goal, uint32_t shown) {
    return 2 * std::max(0.0, hair.width * hair.pixels_per_metre / shown - goal.hair / 2);
}

double error_of(const DirectedHair& hair, const DirectorGoal& goal, LevelChoice choice) {
    return std::hypot(motion_error(hair, choice.level), width_error(hair, goal, choice.shown));
}

// Of hair that nobody sees: no finer than it is.
LevelChoice choice_unseen(const DirectedHair& hair) {
    uint32_t level = hair.level_count - 1;
    const bool rigid = hair.guides[level] == 0;
    if (rigid && hair.unseen < out_of_sight && level > hair.first_level)
        --level;
    return {std::max(level, hair.now.level), hair.shown[0]};
}

} // namespace

bool covers(const DirectedHair& hair, const DirectorGoal& goal) {
    return width_error(hair, goal, hair.now.shown) <= goal.tolerance;
}

void Director::Ladder::add(Rung rung) {
    if (count > 0 && rung.error >= rungs[count - 1].error)
        return;
    const auto gain = [](const Rung& from, const Rung& to) {
        return (from.error - to.error) / (to.work - from.work);
    };
    while (count > 1 && gain(rungs[count - 2], rungs[count - 1]) <= gain(rungs[count - 1], rung))
        --count;
    rungs[count++] = rung;
}

bool Director::Ladder::keeps() const {
    return next().work <= kept * (1 + 1e-9);
}

double Director::Ladder::slope() const {
    if (ends())
        return -1;
    const double gain = (here().error - next().error) / (next().work - here().work);
    return keeps() ? bias * bias * gain : gain;
}

bool Director::Climber::done(double tolerance) const {
    if (levels.ends() && shown.ends())
        return true;
    const bool coarser = work() < kept() * (1 - 1e-9);
    return error() <= square(coarser ? tolerance / bias : tolerance);
}

Director::Ladder& Director::Climber::best() {
    return levels.slope() >= shown.slope() ? levels : shown;
}

Director::Climber Director::climber_of(const DirectedHair& hair, const DirectorGoal& goal) {
    Climber climber;
    climber.levels.kept = guide_work(hair, hair.now.level);
    climber.shown.kept = shown_work(hair, hair.now.shown);
    if (hair.pixels_per_metre == 0) {
        const LevelChoice choice = choice_unseen(hair);
        climber.levels.add({guide_work(hair, choice.level), 0, choice.level});
        climber.shown.add({shown_work(hair, choice.shown), 0, choice.shown});
        return climber;
    }
    for (uint32_t level = hair.level_count; level-- > hair.first_level;)
        climber.levels.add(
            {guide_work(hair, level), square(hair.importance * motion_error(hair, level)), level});
    for (uint32_t i = 0; i < hair.shown_count; ++i)
        climber.shown.add({shown_work(hair, hair.shown[i]),
                           square(hair.importance * width_error(hair, goal, hair.shown[i])),
                           hair.shown[i]});
    return climber;
}

void Director::climb(const DirectorGoal& goal) {
    const auto less = [&](uint32_t a, uint32_t b) {
        const double one = climbers_[a].best().slope(), two = climbers_[b].best().slope();
        return one != two ? one < two : a > b;
    };
    heap_.clear();
    double work = 0;
    for (uint32_t i = 0; i < climbers_.size(); ++i) {
        work += climbers_[i].work();
        if (!climbers_[i].done(goal.tolerance))
            heap_.push_back(i);
    }
    std::make_heap(heap_.begin(), heap_.end(), less);
    while (!heap_.empty()) {
        std::pop_heap(heap_.begin(), heap_.end(), less);
        Climber& climber = climbers_[heap_.back()];
        Ladder& ladder = climber.best();
        const double more = ladder.next().work - ladder.here().work;
        const double most = goal.budget * (ladder.keeps() ? keeps_budget : adds_budget) - fixed_;
        if (goal.budget > 0 && (work + more) * price_ > most) {
            ladder.count = ladder.at + 1; // a smaller step of somebody else's may fit
        } else {
            work += more;
            ++ladder.at;
        }
        if (climber.done(goal.tolerance))
            heap_.pop_back();
        else
            std::push_heap(heap_.begin(), heap_.end(), less);
    }
}

// What frames take is a line over their work. Its beginning is found where work has changed lately; else
// what was found before holds.
void Director::fit_fixed(double ms, double dt) {
    if (ms > 3 * (fixed_ + price_ * work_)) // something else took it
        return;
    const double keep = std::exp(-dt / remembers);
    means_ = {keep * means_.weight + 1, keep * means_.work + work_, keep * means_.ms + ms,
              keep * means_.work2 + work_ * work_, keep * means_.product + work_ * ms};
    const double n = means_.weight, work = means_.work / n, mean = means_.ms / n;
    const double spread = means_.work2 / n - work * work;
    if (spread < square(0.2 * work))
        return;
    const double slope = (means_.product / n - work * mean) / spread;
    if (slope > 0)
        fixed_ = std::clamp(mean - slope * work, 0.0, 0.8 * mean);
}

void Director::took(double ms, double dt) {
    if (!(ms > 0) || !(work_ > 0))
        return;
    took_[measured_++ % took_.size()] = ms;
    std::array<double, 5> sorted = took_;
    const size_t count = std::min<size_t>(measured_, sorted.size());
    std::fill(sorted.begin() + count, sorted.end(), std::numeric_limits<double>::infinity());
    std::sort(sorted.begin(), sorted.end());
    const double usual = sorted[(count - 1) / 2]; // two frames that stumbled say nothing
    fit_fixed(usual, dt);
    const double price = std::max(usual - fixed_, 0.2 * usual) / work_;
    const double share = 1 - std::exp(-dt / (price > price_ ? rises : falls));
    price_ += share * (std::min(price, most_rise * price_) - price_);
}

void Director::list_changes(std::span<const DirectedHair> hair, const DirectorGoal& goal,
                            bool over) {
    changes_.clear();
    for (uint32_t i = 0; i < hair.size(); ++i) {
        const Climber& climber = climbers_[i];
        const LevelChoice to{climber.levels.here().value, climber.shown.here().value};
        const DirectedHair& of = hair[i];
        const double work = work_of(of, to) - work_of(of, of.now);
        if (to == of.now || !(of.since >= goal.hold || (over && work < 0)))
            continue;
        const double gain = square(of.importance) *
                            (square(error_of(of, goal, of.now)) - square(error_of(of, goal, to)));
        changes_.push_back({i, work, gain, to.level < of.now.level});
    }
    // What is saved first, that which is missed least before the rest; then what gains most for its work.
    std::sort(changes_.begin(), changes_.end(), [](const Change& a, const Change& b) {
        if ((a.work < 0) != (b.work < 0))
            return a.work < 0;
        const double one = a.gain / std::max(std::fabs(a.work), 1e-9),
                     two = b.gain / std::max(std::fabs(b.work), 1e-9);
        return one != two ? one > two : a.index < b.index;
    });
}

DirectorReport Director::choose(std::span<const DirectedHair> hair, const DirectorGoal& goal,
                                std::span<LevelChoice> out) {
    climbers_.clear();
    double work = 0;
    for (const DirectedHair& of : hair) {
        climbers_.push_back(climber_of(of, goal));
        work += work_of(of, of.now);
    }
    climb(goal);
    const bool over = goal.budget > 0 && fixed_ + work * price_ > keeps_budget * goal.budget;
    list_changes(hair, goal, over);

    DirectorReport report;
    for (size_t i = 0; i < hair.size(); ++i)
        out[i] = hair[i].now;
    uint32_t left = static_cast<uint32_t>((hair.size() + 7) / 8), wakings = 2;
    for (const Change& change : changes_) {
        const bool first = std::isinf(hair[change.index].since);
        const bool saves = over && change.work < 0;
        const bool fits = goal.budget == 0 || change.work <= 0 ||
                          fixed_ + (work + change.work) * price_ <= keeps_budget * goal.budget;
        if (!fits || (!first && !saves && (left == 0 || (change.wakes && wakings == 0))))
            continue;
        if (!first && !saves) {
            --left;
            wakings -= change.wakes;
        }
        const Climber& climber = climbers_[change.index];
        out[change.index] = {climber.levels.here().value, climber.shown.here().value};
        work += change.work;
        ++report.changed;
    }
    for (size_t i = 0; i < hair.size(); ++i)
        report.worst = std::max(report.worst, error_of(hair[i], goal, out[i]));
    work_ = work;
    report.predicted = fixed_ + work * price_;
    return report;
}

} // namespace plait
