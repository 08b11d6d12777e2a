// Source: warm starting, Moreau & Jean 1996. Ours: friction as a spring drawn by the slip before, and
// placing root to tip. The formulae are those of docs/stages/strands.md.
#include "backend/reference/contact/contact_placer.hpp"

#include <plait/constants.h>

#include <algorithm>
#include <cmath>

namespace plait::reference {
namespace {

// m, about how far a surface is from the middle of what is behind it, at the least.
double thin(const Body& body) {
    if (const Capsule* capsule = std::get_if<Capsule>(&body))
        return std::min(capsule->ra, capsule->rb);
    if (const Box* box = std::get_if<Box>(&body))
        return box->half.minCoeff() + box->rounding;
    if (const Hull* hull = std::get_if<Hull>(&body))
        return hull->around.half.minCoeff(); // with its margin
    return INFINITY;
}

} // namespace

ContactPlacer::ContactPlacer(Contacts& contacts, std::vector<double> force)
    : contacts_(contacts), force_(std::move(force)) {
    const plait_lane_params& params = contacts_.params_;
    for (size_t i = 0; i < params.collider_count; ++i)
        colliders_.push_back(collider_at(contacts_.colliders_, params.collider_first + i));
    for (size_t i = 1; i < force_.size(); ++i)
        begin(i);
    contacts_.touched_ = pressed_;
}

const MeshPlane* ContactPlacer::mesh(size_t vertex) const {
    const std::vector<std::optional<MeshPlane>>& planes = contacts_.planes_;
    return planes.empty() || !planes[vertex] ? nullptr : &*planes[vertex];
}

Hollow::Wall ContactPlacer::deepest(size_t vertex, const MeshPlane& plane, const Vec3& p) const {
    const Vec3 way = p - plane.anchor;
    Hollow::Wall least{plane.normal, plane.height + plane.normal.dot(way)};
    if (contacts_.of_strands())
        return least;
    const auto take = [&](const Hollow::Wall& wall) {
        if (const double height = wall.height + wall.normal.dot(way); height < least.height)
            least = {wall.normal, height};
    };
    if (plane.crease)
        take(*plane.crease);
    if (!contacts_.hollows_.empty())
        std::ranges::for_each(contacts_.hollows_[vertex].walls, take);
    return least;
}

double ContactPlacer::tolerance(size_t vertex) const {
    return PLAIT_CONTACT_TOLERANCE * contacts_.length_[vertex];
}

double ContactPlacer::stiffness(size_t vertex) const {
    return contacts_.mass_[vertex] * contacts_.params_.contact_rate;
}

Vec3 ContactPlacer::carried(const Collider& collider, size_t vertex) const {
    const Motion& motion = contacts_.motion_;
    return collider.carried(motion.root + motion.start[vertex]) - motion.root;
}

// Of what need come no farther out of a collider that holds the root.
double ContactPlacer::gap(const Collider& collider, size_t vertex, const Surface& surface) const {
    const double root_depth = -collider.surface(contacts_.motion_.root).distance;
    return surface.distance +
           std::max(root_depth - PLAIT_CONTACT_ROOT_CLEARANCE * contacts_.arc_[vertex], 0.0);
}

// The slip in this substep of what goes on as in the last ones.
double ContactPlacer::grip(size_t vertex, const Vec3& normal, const Vec3& anchor) const {
    const Motion& motion = contacts_.motion_;
    const Vec3 surface = anchor - motion.start[vertex];
    const auto slip = [&](const Vec3& velocity) {
        const Vec3 way = motion.whole * velocity - surface;
        return (way - normal.dot(way) * normal).norm();
    };
    const double now = slip(motion.v[vertex]);
    double next = now;
    if (contacts_.params_.bdf2)
        next = std::clamp(2 * now - slip(motion.v_before[vertex]), now / 4, 2 * now);
    return std::max(next, double(contacts_.params_.contact_slip));
}

// The contact of a vertex that was pressed to a surface and is near one still.
void ContactPlacer::begin(size_t vertex) {
    Contact& at = contacts_.at_[vertex];
    at = Contact{};
    at.anchor = contacts_.motion_.start[vertex];
    if (!(force_[vertex] > 0) || contacts_.length_[vertex] == 0)
        return;
    const double reach = PLAIT_CONTACT_REACH * tolerance(vertex);
    double least = reach;
    for (const Collider& collider : colliders_) {
        const Vec3 anchor = carried(collider, vertex);
        const Surface surface = collider.surface(contacts_.motion_.root + anchor);
        const double distance = gap(collider, vertex, surface);
        if (distance >= least || clearance(collider, contacts_.motion_.root + anchor) > reach)
            continue;
        least = distance;
        at.normal = surface.normal;
        at.anchor = anchor;
        at.friction = contacts_.motion_.friction * collider.friction;
        at.stiffness = stiffness(vertex);
    }
    const MeshPlane* plane = contacts_.of_strands() && least < 0 ? nullptr : mesh(vertex);
    const bool of_plane = plane && plane->start < least;
    if (of_plane) {
        least = plane->start;
        at.normal = plane->normal;
        at.anchor = plane->anchor;
        at.friction = contacts_.motion_.friction * plane->friction;
        at.stiffness = stiffness(vertex);
    }
    if (at.stiffness == 0)
        return;
    at.push = force_[vertex];
    at.begin = at.push / at.stiffness + std::max(-least - 0.75 * tolerance(vertex), 0.0);
    const bool of_strand = contacts_.of_strands() && of_plane;
    if (of_strand) // which sinks with what lies on it
        at.begin = -least;
    at.offset = at.normal.dot(at.anchor) + at.begin;
    at.friction = std::min(at.friction, PLAIT_CONTACT_MAX_FRICTION * contacts_.stretch_[vertex] *
                                            contacts_.length_[vertex] / std::max(at.push, 1e-30));
    at.grip = grip(vertex, at.normal, at.anchor);
    deep_ = deep_ || (-least > 2 * tolerance(vertex) && !of_strand);
    pressed_ = true;
}

// Where it crossed the surface, if it goes, as the collider sees it, by more than half its radius. A body that hair
// stays inside of is convex, and lets nothing through.
std::optional<Tangent> ContactPlacer::crossing(const Collider& collider, size_t vertex,
                                               const Vec3& p) const {
    const Vec3 from = carried(collider, vertex), root = contacts_.motion_.root;
    const double way = (p - from).norm();
    if (collider.inward || way <= thin(collider.body) / 2 ||
        clearance(collider, root + (from + p) / 2) > way / 2)
        return {};
    return first_crossing(collider, root + from, root + p);
}

std::optional<ContactPlacer::Nearest> ContactPlacer::nearest_body(size_t vertex, const Vec3& p,
                                                                  double reach, bool sweeps) {
    std::optional<Nearest> found;
    for (const Collider& collider : colliders_) {
        Surface surface = collider.surface(contacts_.motion_.root + p);
        const auto tangent = sweeps ? crossing(collider, vertex, p) : std::nullopt;
        const bool swept =
            tangent && (surface.distance > 0 ||
                        !(surface.normal.dot(tangent->normal) > PLAIT_SWEEP_SAME_SIDE));
        if (swept)
            surface = {tangent->height, tangent->normal};
        else if (clearance(collider, contacts_.motion_.root + p) > std::max(reach, 0.0))
            continue;
        const double distance = gap(collider, vertex, surface);
        if (distance < (found ? found->gap : reach))
            found = Nearest{distance, collider.friction, surface.normal, carried(collider, vertex),
                            true};
    }
    return found;
}

// Lifts p to where the plane of a strand leaves it, if that is in a body. No strand pushes another one into one.
std::optional<ContactPlacer::Nearest> ContactPlacer::nearest(size_t vertex, double reach, Vec3& p) {
    const auto body = nearest_body(vertex, p, reach, true);
    const MeshPlane* plane = mesh(vertex);
    if (!plane || (contacts_.of_strands() && body && body->gap < 0))
        return body;
    const auto [normal, height] = deepest(vertex, *plane, p);
    if (height >= (body ? body->gap : reach))
        return body;
    const Nearest found{height, plane->friction, normal, plane->anchor, false};
    if (!contacts_.of_strands() || height >= 0)
        return found;
    const Vec3 lifted = p - height * normal;
    const auto behind = nearest_body(vertex, lifted, 0, false);
    if (behind)
        p = lifted;
    return behind ? behind : found;
}

void ContactPlacer::arrive(size_t vertex, const Nearest& found) {
    Contact& at = contacts_.at_[vertex];
    at.anchor = found.anchor;
    at.friction = contacts_.motion_.friction * found.friction;
    at.slide.setZero();
    at.push = at.begin = 0;
    at.grip = contacts_.params_.contact_slip;
}

Vec3 ContactPlacer::place(size_t vertex, Vec3 p) {
    Contact& at = contacts_.at_[vertex];
    depth_ = -INFINITY;
    held_ = astray_ = false;
    if (contacts_.length_[vertex] == 0)
        return p;
    astray_ = strays(vertex, p);
    const double tolerance = this->tolerance(vertex), near = PLAIT_CONTACT_REACH * tolerance;
    const bool was = at.stiffness > 0;
    const double height = was ? at.normal.dot(p) - at.offset : 0;
    const auto found = nearest(vertex, height < 0 ? near : 0, p);
    // one that the step pulls off is free, unless it is deep: near the surface rounding would decide
    const double held = tolerance / 2, stop = PLAIT_ARTICULATED_STOP * contacts_.length_[vertex];
    if (!found || !(height < 0 || found->gap < -(was ? held : stop))) {
        at.stiffness = 0;
        return p;
    }
    const double deep = std::max(-found->gap, 0.0);
    const double h = contacts_.motion_.h, rate = contacts_.params_.contact_rate;
    const double sinks = was ? -height : std::min(deep / (rate * h * h), tolerance);
    double lift = -std::clamp(sinks, 0.0, held) - found->gap;
    if (was && std::abs(lift) < 2 * tolerance)
        lift *= PLAIT_CONTACT_BACK;
    const bool strand = contacts_.of_strands() && !found->body;
    if (height < 0 && strand) // the spring tells where it is
        lift = 0;
    deep_ = deep_ || (std::abs(lift) > PLAIT_CONTACT_DEEP * contacts_.length_[vertex] && !strand);
    depth_ = -(found->gap + lift);
    Vec3 to = p + lift * found->normal;
    if (!was) {
        arrive(vertex, *found);
        Vec3 u = to - at.anchor;
        u -= found->normal.dot(u) * found->normal;
        if (!contacts_.touched_)
            to -= std::min(at.friction * deep / std::max(u.norm(), 1e-20), 1.0) * u;
    }
    at.stiffness = stiffness(vertex);
    at.normal = found->normal;
    at.offset = at.normal.dot(to) + sinks;
    held_ = found->body || !contacts_.of_strands();
    return to;
}

// What slips slides with mu N from now on. Only what its spring has all but stopped is not thrown back by that:
// a spring as weak as mu N draws it by what it slipped stops more of it.
void ContactPlacer::rub(Contact& at, const Vec3& to) {
    const double slip = contacts_.params_.contact_slip;
    const Vec3 u = contacts_.slip_of(at, to);
    const bool back = at.slide.dot(u) < 0, more = slip < u.norm() && !back;
    const bool stops = at.sticks() && u.norm() < PLAIT_CONTACT_STOPS * at.grip;
    at.slide = more && !stops ? Vec3(u.normalized()) : Vec3(Vec3::Zero());
    if (back || (more && stops))
        at.grip = back ? slip : u.norm();
    back_ = back_ || back;
    slips_ = slips_ || more;
}

// N and friction are those of the solve, which does not know that a segment's length leaves the vertex elsewhere, and
// a micrometre is a multiple of N: the spring comes along, by no more than what is pressed may be deep.
void ContactPlacer::bring(size_t vertex, const Vec3& to, const Vec3& x) {
    Contact& at = contacts_.at_[vertex];
    if (at.stiffness == 0)
        return;
    rub(at, to);
    at.offset += std::clamp(at.normal.dot(x - to), -tolerance(vertex), tolerance(vertex));
}

// The body or, where no strands meet, the mesh in which x is too deep.
std::optional<ContactPlacer::Nearest> ContactPlacer::holder(size_t vertex, const Vec3& x) {
    const double most = PLAIT_CONTACT_MAX_PENETRATION * contacts_.length_[vertex];
    auto found = nearest_body(vertex, x, -most, false);
    const MeshPlane* plane = contacts_.of_strands() ? nullptr : mesh(vertex);
    if (!plane)
        return found;
    const auto [normal, height] = deepest(vertex, *plane, x);
    if (height < (found ? found->gap : -most))
        found = Nearest{height, plane->friction, normal, plane->anchor, false};
    return found;
}

// A vertex that touches no body but is left too deep in one touches it from now on: its depth, or 0.
double ContactPlacer::behind(size_t vertex, const Vec3& x) {
    if (held_ || contacts_.length_[vertex] == 0)
        return 0;
    const auto found = holder(vertex, x);
    if (!found)
        return 0;
    arrive(vertex, *found);
    Contact& at = contacts_.at_[vertex];
    at.stiffness = stiffness(vertex);
    at.normal = found->normal;
    at.offset = at.normal.dot(x);
    return -found->gap;
}

// Is p farther from the vertex' way than it may be for what was looked for?
bool ContactPlacer::strays(size_t vertex, const Vec3& p) const {
    return contacts_.astray(vertex, p).norm() >
           PLAIT_CONTACT_ROOM * contacts_.length_[vertex] - PLAIT_CONTACT_REACH * tolerance(vertex);
}

// Past the first steps, where strands meet and of what strays, what is left too deep comes to the surface.
Vec3 ContactPlacer::left(size_t vertex, const Vec3& to, const Vec3& leader, const Vec3& x) {
    const double length = contacts_.length_[vertex];
    const bool keeps = contacts_.of_strands() || step_ >= PLAIT_CONTACT_NEWTON_STEPS || astray_;
    // where its segment's length has carried it off, it may be deep
    const bool off = (x - to).norm() > PLAIT_CONTACT_MAX_PENETRATION * length;
    deep_ = deep_ || (!keeps && off && holder(vertex, x));
    const double behind = keeps ? this->behind(vertex, x) : 0;
    const Contact& at = contacts_.at_[vertex];
    const double depth = behind > 0 ? behind : depth_ + at.normal.dot(to - x);
    const bool under = held_ && at.stiffness > 0 && depth > PLAIT_CONTACT_MAX_PENETRATION * length;
    if (!(behind > 0))
        bring(vertex, to, x);
    deep_ = deep_ || behind > 0 || under;
    const bool moves = behind > 0 || under;
    if (!keeps || at.stiffness == 0 || (contacts_.of_strands() && !moves))
        return x;
    const Vec3 out = x - leader, on = moves ? on_circle(at.normal, out, depth, length) : out;
    const Vec3 kept = in_edge(vertex, leader, at.normal, on);
    deep_ = deep_ || kept != on;
    return kept == out ? x : Vec3(leader + kept);
}

void ContactPlacer::placed() {
    contacts_.touched_ = contacts_.touched_ || contacts_.touching();
}

void ContactPlacer::press(const std::vector<Vec3>& x) {
    deep_ = slips_ = back_ = false;
    ++step_;
    contacts_.press(x);
}

} // namespace plait::reference
