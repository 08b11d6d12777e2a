#include "trial.hpp"

#include "common.hpp"

#include <algorithm>
#include <cmath>

namespace lab::stability {

using namespace common;

namespace {

constexpr char letters[] = "NEFJsr.";
// s after which energy counts: the root stops at its greatest acceleration, and BDF2 remembers it.
constexpr double energy_after = 0.1;

double length_of(const std::vector<Point>& rest) {
    double length = 0;
    for (size_t i = 1; i < rest.size(); ++i)
        length += (rest[i] - rest[i - 1]).norm();
    return length;
}

using Turn = Eigen::Quaterniond;

plait_pose shifted(plait_pose pose, const Point& by) {
    for (int c = 0; c < 3; ++c)
        pose.t[c] = static_cast<float>(double(pose.t[c]) + by[c]);
    return pose;
}

Turn turn_of(const plait_pose& pose) {
    return Turn(pose.q[3], pose.q[0], pose.q[1], pose.q[2]);
}

Point apply(const plait_pose& pose, const Point& p) {
    return turn_of(pose) * p + Point(pose.t[0], pose.t[1], pose.t[2]);
}

// Masses and springs of one strand, as far as positions alone tell: which way the segments of a rod
// are turned is not among a sim's fields.
class Elastic {
  public:
    Elastic(const std::vector<Point>& rest, const plait::SimDesc& desc);

    double kinetic(const std::vector<Point>& v) const;
    // Height and stretch, J: not above what there is.
    double least(const std::vector<Point>& x) const;
    // And bending, were every segment turned along its edge without more twist than that needs: not
    // below what there is.
    double most(const std::vector<Point>& x, const Turn& root) const;
    double weight_times_length() const { return density_ * length_ * gravity * length_; }

  private:
    std::vector<double> lengths_, masses_;
    std::vector<Turn> joints_;          // at rest; the first from the axes of rest space
    double length_, density_, EI_, EA_; // the mean density
};

Elastic::Elastic(const std::vector<Point>& rest, const plait::SimDesc& desc)
    : length_(length_of(rest)),
      density_(desc.material.line_density * 0.5 * (1 + desc.material.density_ramp[3])),
      EI_(desc.material.bend_stiffness), EA_(desc.material.stretch_stiffness) {
    if (EA_ == 0)
        EA_ = density_ * length_ * 10 * gravity / 0.01; // the library's choice
    Turn frame = Turn::Identity();
    for (size_t i = 1; i < rest.size(); ++i) {
        const Point edge = rest[i] - rest[i - 1];
        lengths_.push_back(edge.norm());
        const Turn next = turn_between(frame * Point::UnitX(), edge) * frame;
        joints_.push_back(frame.conjugate() * next);
        frame = next.normalized();
    }
    double above = 0;        // arc length
    std::vector<double> own; // masses of the segments
    for (const double l : lengths_) {
        const double share = (above + 0.5 * l) / length_;
        own.push_back(desc.material.line_density * l *
                      (1 + (desc.material.density_ramp[3] - 1) * share));
        above += l;
    }
    for (size_t i = 0; i < own.size(); ++i) {
        const double after = i + 1 < own.size() ? own[i + 1] : 0;
        masses_.push_back(0.5 * (own[i] + after));
    }
}

double Elastic::kinetic(const std::vector<Point>& v) const {
    double energy = 0;
    for (size_t i = 0; i < masses_.size(); ++i)
        energy += 0.5 * masses_[i] * v[i + 1].squaredNorm();
    return energy;
}

double Elastic::least(const std::vector<Point>& x) const {
    double energy = 0;
    for (size_t i = 0; i < masses_.size(); ++i) {
        const double stretch = (x[i + 1] - x[i]).norm() - lengths_[i];
        energy += masses_[i] * gravity * (x[i + 1].y() - x[0].y()) +
                  0.5 * EA_ / lengths_[i] * stretch * stretch;
    }
    return energy;
}

double Elastic::most(const std::vector<Point>& x, const Turn& root) const {
    double energy = least(x);
    Turn frame = root;
    for (size_t i = 0; i < lengths_.size(); ++i) {
        frame = frame * joints_[i];
        const Turn bend = turn_between(frame * Point::UnitX(), x[i + 1] - x[i]);
        // 4EI/lbar (1 - cos(angle/2)); the root is a joint of half a length
        const double joint = 0.5 * (lengths_[i] + (i > 0 ? lengths_[i - 1] : 0));
        energy += 2 * EI_ / joint * bend.vec().squaredNorm() / (1 + std::abs(bend.w())) * 2;
        frame = (bend * frame).normalized();
    }
    return energy;
}

// What a strand does, followed from step to step.
class Watch {
  public:
    Watch(const TrialStrand& strand, const Trial& trial);
    // Positions and, where the trial has energy, velocities.
    void see(const std::vector<Point>& x, const std::vector<Point>& v, const plait_pose& root,
             double elapsed, bool shaking, bool last);
    Outcome outcome() const;
    bool lost() const { return !finite_; }

  private:
    void see_energy(const std::vector<Point>& x, const std::vector<Point>& v, const Turn& root);
    double expected_response(const TrialStrand& strand, const plait::SimDesc& desc) const;

    std::vector<Point> rest_, before_;
    std::vector<double> lengths_;
    Point first_tip_ = Point::Zero();
    double length_ = 0, speed_limit_ = 0, must_move_ = 0, moved_ = 0;
    Elastic elastic_;
    bool has_energy_, finite_ = true;
    double still_ = 0;                                        // s since the root stopped
    double energy_ = std::numeric_limits<double>::infinity(); // at most this is left
    Outcome seen_;
};

Watch::Watch(const TrialStrand& strand, const Trial& trial)
    : rest_(strand.rest), before_(strand.rest), length_(length_of(strand.rest)),
      elastic_(strand.rest, trial.desc), has_energy_(trial.has_energy) {
    for (size_t i = 1; i < rest_.size(); ++i)
        lengths_.push_back((rest_[i] - rest_[i - 1]).norm());
    speed_limit_ = 6 * (strand.root_speed + 3 * std::sqrt(gravity * length_));
    must_move_ = expected_response(strand, trial.desc);
    first_tip_ = rest_.back() - rest_.front();
}

// A tenth of the deflection of a level rod, or of half its length; 0 where that is below 1e-3 L.
double Watch::expected_response(const TrialStrand& strand, const plait::SimDesc& desc) const {
    if (desc.model == PLAIT_MODEL_TRESSFX)
        return 0.05 * length_;
    const double EI = double(desc.material.bend_stiffness);
    const double gamma =
        double(desc.material.line_density) * gravity * std::pow(length_, 3) / std::max(EI, 1e-300);
    const double deflection = std::min(0.5, gamma * std::max(1.0, strand.stir) / 8);
    return deflection < 1e-2 ? 0 : 0.1 * deflection * length_;
}

// Energy never rises where nothing moves the root, so that at any time it is at most the least of
// what it was before.
void Watch::see_energy(const std::vector<Point>& x, const std::vector<Point>& v, const Turn& root) {
    const double kinetic = elastic_.kinetic(v);
    const double least = kinetic + elastic_.least(x), most = kinetic + elastic_.most(x, root);
    const double scale = std::max(energy_, 0.0) + elastic_.weight_times_length();
    seen_.energy = std::max(seen_.energy, (least - energy_) / scale);
    energy_ = std::min(energy_, most);
}

void Watch::see(const std::vector<Point>& x, const std::vector<Point>& v, const plait_pose& root,
                double elapsed, bool shaking, bool last) {
    const Point origin = apply(root, rest_[0]);
    double strain = 0, fastest = 0, moved = 0;
    for (size_t i = 1; i < x.size(); ++i) {
        const double away = (x[i] - origin).norm();
        if (!std::isfinite(away)) {
            finite_ = false;
            return;
        }
        seen_.distance = std::max(seen_.distance, away / length_);
        strain = std::max(strain, std::abs((x[i] - x[i - 1]).norm() / lengths_[i - 1] - 1));
        moved = std::max(moved, (x[i] - before_[i]).norm());
    }
    fastest = elapsed > 0 ? moved / elapsed : 0;
    seen_.speed = std::max(seen_.speed, fastest / speed_limit_);
    moved_ = std::max(moved_, ((x.back() - x.front()) - first_tip_).norm());
    (shaking ? seen_.strain : seen_.rest_strain) =
        shaking ? std::max(seen_.strain, strain) : strain;
    if (!shaking && last)
        seen_.jitter = std::max(seen_.jitter, moved / length_);
    if (still_ > energy_after && has_energy_ && elapsed > 0)
        see_energy(x, v, turn_of(root));
    still_ = shaking ? 0 : still_ + elapsed;
    before_ = x;
}

Outcome Watch::outcome() const {
    Outcome o = seen_;
    o.response = must_move_ > 0 ? moved_ / must_move_ : 1;
    if (!finite_)
        o.distance = std::numeric_limits<double>::infinity();
    if (!(o.distance <= 100))
        o.grade = Grade::nonfinite;
    else if (o.speed > 1 || o.energy > 0.05)
        o.grade = Grade::explosion;
    else if (o.response < 1)
        o.grade = Grade::frozen;
    else if (o.jitter > 1e-4)
        o.grade = Grade::jitter;
    else if (o.strain > 0.1)
        o.grade = Grade::shaken;
    else if (o.rest_strain > 0.01)
        o.grade = Grade::rest;
    return o;
}

// The sim of a trial, moved frame by frame.
class Scene {
  public:
    Scene(plait_context* context, const Trial& trial);
    void step_to(double time, double elapsed);
    void drag(double value);
    std::vector<std::vector<Point>> positions() const; // relative to the offset
    std::vector<std::vector<Point>> velocities() const;

  private:
    void add_colliders();
    void set_pins(double time);
    std::vector<std::vector<Point>> read(plait_field field, const Point& origin) const;

    const Trial& trial_;
    uint32_t row_ = 0;
    GroomHandle groom_;
    SimHandle sim_;
    std::vector<plait_collider_id> colliders_;
};

Scene::Scene(plait_context* context, const Trial& trial) : trial_(trial) {
    std::vector<float> positions;
    std::vector<uint32_t> counts;
    for (const TrialStrand& strand : trial.strands) {
        counts.push_back(static_cast<uint32_t>(strand.rest.size()));
        row_ = std::max(row_, counts.back());
        for (const Point& p : strand.rest)
            for (int c = 0; c < 3; ++c)
                positions.push_back(static_cast<float>(p[c]));
    }
    plait_groom_desc desc = plait_groom_desc_defaults();
    desc.positions = {positions.data(), positions.size() / 3, 0};
    desc.vertex_counts = {counts.data(), counts.size(), 0};
    plait_import_options options{};
    plait_import_options_init(&options, sizeof options);
    options.min_segment = 0; // even segments of a thousandth are as given
    plait_groom* groom = nullptr;
    check(plait_groom_create(&desc, &options, &groom));
    groom_.reset(groom);
    plait_sim* sim = nullptr;
    check(plait::create_sim(context, groom, trial.desc, &sim));
    sim_.reset(sim);

    std::vector<plait_pose> poses;
    for (const TrialStrand& strand : trial.strands)
        poses.push_back(shifted(strand.root(0), trial.offset));
    plait_roots roots = plait_roots_defaults();
    roots.root_poses = {poses.data(), poses.size(), 0};
    check(plait_sim_teleport(sim, &roots));
    check(plait_sim_reset(sim));
    add_colliders();
    set_pins(0);
}

void Scene::set_pins(double time) {
    if (trial_.pins.empty())
        return;
    std::vector<plait_pin> pins;
    for (const TrialPin& pin : trial_.pins) {
        const Point at = pin.target(time) + trial_.offset;
        plait_pin one{};
        one.strand = pin.strand;
        one.vertex = pin.vertex;
        one.frame = PLAIT_PIN_FRAME_WORLD;
        one.stiffness = static_cast<float>(pin.stiffness);
        for (int c = 0; c < 3; ++c)
            one.target[c] = static_cast<float>(at[c]);
        pins.push_back(one);
    }
    check(plait_sim_set_pins(sim_.get(), pins.data(), pins.size()));
}

void Scene::add_colliders() {
    for (const TrialCollider& collider : trial_.colliders) {
        plait_collider_desc shape = collider.shape;
        shape.pose = shifted(collider.pose(0), trial_.offset);
        colliders_.emplace_back();
        check(plait_collider_create(sim_.get(), &shape, &colliders_.back()));
    }
}

void Scene::step_to(double time, double elapsed) {
    std::vector<plait_pose> poses;
    for (const TrialStrand& strand : trial_.strands)
        poses.push_back(shifted(strand.root(time), trial_.offset));
    plait_roots roots = plait_roots_defaults();
    roots.root_poses = {poses.data(), poses.size(), 0};
    check(plait_sim_set_roots(sim_.get(), &roots));
    for (size_t i = 0; i < colliders_.size(); ++i) {
        const plait_pose pose = shifted(trial_.colliders[i].pose(time), trial_.offset);
        check(plait_collider_set_pose(sim_.get(), colliders_[i], &pose));
    }
    set_pins(time);
    check(plait_sim_step(sim_.get(), elapsed));
}

void Scene::drag(double value) {
    plait_sim_params params{};
    plait_sim_params_init(&params, sizeof params);
    check(plait_sim_get_params(sim_.get(), &params));
    params.drag = static_cast<float>(value);
    check(plait_sim_set_params(sim_.get(), &params));
}

std::vector<std::vector<Point>> Scene::positions() const {
    return read(PLAIT_FIELD_POSITION, trial_.offset);
}

std::vector<std::vector<Point>> Scene::velocities() const {
    return read(PLAIT_FIELD_VELOCITY, Point::Zero());
}

std::vector<std::vector<Point>> Scene::read(plait_field field, const Point& origin) const {
    std::vector<float> data(size_t{4} * row_ * trial_.strands.size());
    size_t size = data.size() * sizeof(float);
    check(plait_sim_read(sim_.get(), field, data.data(), &size));
    std::vector<std::vector<Point>> strands;
    for (size_t s = 0; s < trial_.strands.size(); ++s) {
        strands.emplace_back();
        for (size_t i = 0; i < trial_.strands[s].rest.size(); ++i) {
            const float* p = &data[4 * (s * row_ + i)];
            strands.back().push_back(Point(p[0], p[1], p[2]) - origin);
        }
    }
    return strands;
}

} // namespace

char letter_of(Grade grade) {
    return letters[static_cast<size_t>(grade)];
}

Grade grade_of(char letter) {
    for (size_t i = 0; i < grades; ++i)
        if (letters[i] == letter)
            return static_cast<Grade>(i);
    throw Failure(std::string("no grade is called '") + letter + "', there are " + letters);
}

Outcome worst(const Outcome& a, const Outcome& b) {
    return {std::min(a.grade, b.grade),       std::max(a.distance, b.distance),
            std::max(a.speed, b.speed),       std::max(a.energy, b.energy),
            std::min(a.response, b.response), std::max(a.jitter, b.jitter),
            std::max(a.strain, b.strain),     std::max(a.rest_strain, b.rest_strain)};
}

std::vector<Outcome> run(plait_context* context, const Trial& trial) {
    Scene scene(context, trial);
    std::vector<Watch> watches;
    for (const TrialStrand& strand : trial.strands)
        watches.emplace_back(strand, trial);
    const double step = double(trial.desc.step), end = trial.shake + trial.settle;
    bool settling = false;
    double time = 0;
    for (size_t frame = 0; time < end - 0.5 * step; ++frame) {
        const double dt = trial.frames.empty() ? step : trial.frames[frame % trial.frames.size()];
        if (!settling && time >= trial.shake - 0.5 * step) {
            settling = true;
            if (trial.settle_drag)
                scene.drag(2.4 * std::sqrt(gravity / length_of(trial.strands[0].rest)));
        }
        time += dt;
        scene.step_to(time, dt);
        const auto x = scene.positions(), v = trial.has_energy ? scene.velocities() : x;
        for (size_t s = 0; s < x.size(); ++s)
            watches[s].see(x[s], v[s], trial.strands[s].root(time), dt, !settling,
                           time > end - 0.5);
        if (std::ranges::all_of(watches, &Watch::lost))
            break;
    }
    std::vector<Outcome> outcomes;
    for (const Watch& watch : watches)
        outcomes.push_back(watch.outcome());
    return outcomes;
}

} // namespace lab::stability
