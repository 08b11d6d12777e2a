#include "io/curves/curve_set.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace plait {
namespace {

// Objects of one file may share arrays, which each then takes for itself.
constexpr uint64_t MOST_SHARED = 64 << 20;

Error bad(const CurveObject& object, const std::string& text) {
    return {PLAIT_BAD_DATA, object.place + ": " + text};
}

// The number of values for `count` of an object of so many curves and points.
Status check_scope(const CurveObject& object, const char* what, size_t count) {
    const size_t curves = object.counts.size(), points = object.points.size() / 3;
    if (count == 0 || count == 1 || count == curves || count == points)
        return {};
    return bad(object,
               format("%s has %zu values; allowed are 1, one for each of the %zu curves, or "
                      "one for each of the %zu points",
                      what, count, curves, points));
}

// The index, in an array of `count` of check_scope(), of a curve whose first point is `first`.
size_t index_of(const CurveObject& object, size_t count, size_t curve, size_t first) {
    if (count == 1)
        return 0;
    return count == object.counts.size() ? curve : first;
}

// The mean over its points, of equal ones their value to the bit.
float width_of(const CurveObject& object, size_t curve, size_t first, size_t points, float factor) {
    const size_t at = index_of(object, object.widths.size(), curve, first);
    const bool per_point =
        object.widths.size() != 1 && object.widths.size() != object.counts.size();
    const size_t count = per_point ? points : 1;
    double sum = 0;
    for (size_t i = 0; i < count; ++i)
        sum += static_cast<double>(object.widths[at + i]);
    return factor * static_cast<float>(sum / static_cast<double>(count));
}

CurvePoint point_of(const CurveObject& object, size_t i) {
    return {static_cast<double>(object.points[3 * i]),
            static_cast<double>(object.points[3 * i + 1]),
            static_cast<double>(object.points[3 * i + 2])};
}

const char* basis_name(CurveBasis basis) {
    return basis == CurveBasis::BEZIER     ? "Bezier"
           : basis == CurveBasis::B_SPLINE ? "B-spline"
                                           : "Catmull-Rom";
}

} // namespace

Status StrandBuilder::check(const CurveObject& object) {
    const uint64_t points = object.points.size() / 3;
    uint64_t sum = 0;
    for (size_t c = 0; c < object.counts.size(); ++c) {
        const int64_t count = object.counts[c];
        if (count < 1 || static_cast<uint64_t>(count) > points - sum)
            return bad(object, format("curve %zu has %" PRId64 " points; allowed are 1 to %" PRIu64
                                      ", which are left of the object's %" PRIu64,
                                      c, count, points - sum, points));
        sum += static_cast<uint64_t>(count);
    }
    if (sum != points)
        return bad(object, format("its curves have %" PRIu64 " points together; it has %" PRIu64,
                                  sum, points));
    if (!object.knots.empty() && object.knots.size() != points + 4 * object.counts.size())
        return bad(object,
                   format("has %zu knots; allowed are four more than points for each curve, "
                          "%" PRIu64,
                          object.knots.size(), points + 4 * object.counts.size()));
    PLAIT_TRY(check_scope(object, "width", object.widths.size()));
    PLAIT_TRY(check_scope(object, "uv", object.uv.size() / 2));
    for (const auto& [name, count] :
         {std::pair("guide", object.guide.size()), std::pair("group id", object.group.size())})
        if (count > 1 && count != object.counts.size())
            return bad(object,
                       format("%s has %zu values; allowed are 1, or one for each of the %zu "
                              "curves",
                              name, count, object.counts.size()));
    PLAIT_TRY(check_guides(object));
    if (!object.to_world.is_finite())
        return bad(object, "its transform has a number that is not finite");
    taken_ += 12 * points + 12 * object.counts.size();
    if (taken_ > std::max(3 * budget_, MOST_SHARED))
        return Error{PLAIT_UNSUPPORTED,
                     format("%s: the file's objects share arrays: their points would take %" PRIu64
                            " bytes, allowed are three times the file's %" PRIu64,
                            object.place.c_str(), taken_, budget_)};
    return {};
}

Status StrandBuilder::check_guides(const CurveObject& object) const {
    const size_t curves = object.counts.size(), followed = StrandSet::guides_of_file * curves;
    const std::tuple<const char*, size_t, size_t> lists[] = {
        {"id", object.id.size(), curves},
        {"closest_guides", object.guide_ids.size(), followed},
        {"guide_weights", object.guide_weights.size(), followed}};
    for (const auto& [name, count, wanted] : lists)
        if (count > 0 && count != wanted)
            return bad(object, format("%s has %zu values; allowed are %zu, %zu for each curve",
                                      name, count, wanted, wanted / curves));
    if (object.guide_ids.empty() != object.guide_weights.empty())
        return bad(object, "closest_guides and guide_weights: one is given, both belong together");
    return {};
}

Status StrandBuilder::check_curve(const CurveObject& object, size_t curve, size_t first,
                                  size_t points) const {
    if (object.basis == CurveBasis::LINEAR || span_count(object.basis, object.ends, points))
        return {};
    return bad(object, format("curve %zu, from point %zu on, has %zu points; a %s curve has %s",
                              curve, first, points, basis_name(object.basis),
                              object.basis == CurveBasis::BEZIER ? "4, 7, 10, ..."
                              : object.ends == CurveEnds::OUTER  ? "2 or more"
                                                                 : "4 or more"));
}

void StrandBuilder::push(const CurveObject& object, const CurvePoint& point) {
    const auto placed = object.to_world(point[0], point[1], point[2]);
    for (const double c : placed)
        strands_.positions.push_back(options_.scale * static_cast<float>(c * object.unit));
}

Status StrandBuilder::read_knots(const CurveObject& object, size_t curve, size_t first,
                                 size_t points) {
    knots_.clear();
    for (size_t i = 0; i < points + 4; ++i) {
        knots_.push_back(static_cast<double>(object.knots[first + 4 * curve + i]));
        if (!std::isfinite(knots_[i]) || (i > 0 && knots_[i] < knots_[i - 1]))
            return bad(object,
                       format("knot %zu of curve %zu is %g; allowed are finite ones that rise or "
                              "stay",
                              i, curve, knots_[i]));
    }
    if (!(knots_[3] < knots_[points]))
        return bad(object,
                   format("curve %zu has no length: its knots are %g from knot 3 to knot %zu",
                          curve, knots_[3], points));
    return {};
}

Status StrandBuilder::add_points(const CurveObject& object, size_t curve, size_t first,
                                 size_t points) {
    if (object.basis == CurveBasis::LINEAR) {
        if (object.to_world == Matrix{} && object.unit == 1) // to the bit
            for (size_t i = 3 * first; i < 3 * (first + points); ++i)
                strands_.positions.push_back(options_.scale * object.points[i]);
        else
            for (size_t i = first; i < first + points; ++i)
                push(object, point_of(object, i));
        strands_.vertex_counts.push_back(static_cast<uint32_t>(points));
        return {};
    }
    curve_.clear();
    for (size_t i = first; i < first + points; ++i)
        curve_.push_back(point_of(object, i));
    CubicCurve cubic(object.basis, object.ends);
    if (!object.knots.empty())
        PLAIT_TRY(read_knots(object, curve, first, points));
    const std::span<const CurvePoint> polyline =
        object.knots.empty() ? cubic.polyline(curve_) : cubic.polyline(curve_, knots_);
    for (const CurvePoint& point : polyline)
        push(object, point);
    strands_.vertex_counts.push_back(static_cast<uint32_t>(polyline.size()));
    ++cubic_;
    sharp_spans_ += cubic.sharp_spans();
    return {};
}

bool StrandBuilder::is_wanted(const CurveObject& object, size_t curve) {
    ++curves_;
    if (object.guide.empty())
        return options_.part != StrandPart::GUIDES;
    says_guides_ = true;
    const bool guide = object.guide[object.guide.size() == 1 ? 0 : curve] != 0;
    guides_ += guide;
    return options_.part == StrandPart::ALL || (options_.part == StrandPart::GUIDES) == guide;
}

void StrandBuilder::count_groups(const CurveObject& object) {
    for (size_t c = 0; c < object.group.size(); ++c)
        if (object.group[c] != last_group_) {
            last_group_ = object.group[c];
            groups_.add(format("%" PRId64, last_group_));
        }
}

// Which group a strand is of; and what it is called or follows, where that is asked for.
Status StrandBuilder::add_names(const CurveObject& object, size_t curve) {
    constexpr size_t each = StrandSet::guides_of_file;
    const auto add = [&](const char* what, int64_t value, auto& to) -> Status {
        if (value < 0 || value > std::numeric_limits<int32_t>::max())
            return bad(object, format("%s of curve %zu is %" PRId64 "; allowed are 0 to 2^31 - 1",
                                      what, curve, value));
        to.push_back(static_cast<uint32_t>(value));
        return {};
    };
    if (!object.group.empty())
        PLAIT_TRY(
            add("group id", object.group[object.group.size() == 1 ? 0 : curve], strands_.group));
    if (options_.part == StrandPart::GUIDES && !object.id.empty())
        PLAIT_TRY(add("id", object.id[curve], strands_.id));
    says_what_follows_ = says_what_follows_ || !object.guide_ids.empty();
    if (options_.part != StrandPart::FOLLOWS || object.guide_ids.empty())
        return {};
    for (size_t k = each * curve; k < each * (curve + 1); ++k) {
        const float weight = object.guide_weights[k];
        PLAIT_TRY(add("closest_guides", weight == 0 ? 0 : object.guide_ids[k], strands_.guide_ids));
        strands_.guide_weights.push_back(weight);
    }
    return {};
}

Status StrandBuilder::add(const CurveObject& object) {
    if (object.counts.empty() && object.points.empty())
        return {};
    PLAIT_TRY(check(object));
    if (objects_++ == 0) {
        strands_.positions.reserve(object.points.size());
        strands_.vertex_counts.reserve(object.counts.size());
    }
    count_groups(object);
    const float factor = options_.scale * static_cast<float>(object.to_world.scale() * object.unit);
    for (size_t curve = 0, first = 0; curve < object.counts.size(); ++curve) {
        const auto points = static_cast<size_t>(object.counts[curve]);
        PLAIT_TRY(check_curve(object, curve, first, points));
        if (is_wanted(object, curve)) {
            PLAIT_TRY(add_points(object, curve, first, points));
            if (!object.widths.empty())
                strands_.thickness.push_back(width_of(object, curve, first, points, factor));
            PLAIT_TRY(add_names(object, curve));
            for (size_t i = 0; i < 2 && !object.uv.empty(); ++i)
                strands_.strand_uv.push_back(
                    object.uv[2 * index_of(object, object.uv.size() / 2, curve, first) + i]);
        }
        first += points;
    }
    return {};
}

// Of some strands only: none are used.
template <typename T>
void StrandBuilder::drop_partial(const char* what, size_t width, std::pmr::vector<T>& values,
                                 Notes& notes) {
    const size_t strands = strands_.vertex_counts.size(), have = values.size() / width;
    if (have == strands || have == 0)
        return;
    values.clear();
    notes.add(
        format("%s are not used: %zu of %zu strands have none", what, strands - have, strands));
}

Result<StrandSet> StrandBuilder::finish(const std::string& file, Notes& notes) {
    if (strands_.vertex_counts.empty())
        return Error{
            PLAIT_BAD_DATA,
            options_.part != StrandPart::ALL && curves_ > 0
                ? format("%s: has no %s among its %" PRIu64 " curves", file.c_str(),
                         options_.part == StrandPart::GUIDES ? "guides" : "strands beside guides",
                         curves_)
                : format("%s: has no curves", file.c_str())};
    if (says_guides_)
        notes.add(format("%" PRIu64 " of its %" PRIu64 " curves are guides", guides_, curves_));
    notes.add("runs of curves with one group id", groups_);
    if (cubic_ > 0)
        notes.add(format("%" PRIu64 " cubic curves were evaluated to polylines", cubic_));
    if (sharp_spans_ > 0)
        notes.add(format("%" PRIu64 " of their spans bend too sharply for %zu chords each",
                         sharp_spans_, CubicCurve::MOST_CHORDS));
    drop_partial("widths", 1, strands_.thickness, notes);
    drop_partial("uv", 2, strands_.strand_uv, notes);
    drop_partial("group ids", 1, strands_.group, notes);
    drop_partial("ids", 1, strands_.id, notes);
    drop_partial("closest_guides", StrandSet::guides_of_file, strands_.guide_ids, notes);
    if (strands_.guide_ids.empty())
        strands_.guide_weights.clear();
    if (says_what_follows_ && options_.part == StrandPart::ALL)
        notes.add("it says which guides its strands follow, which plait_groom_load_guides reads");
    return std::move(strands_);
}

} // namespace plait
