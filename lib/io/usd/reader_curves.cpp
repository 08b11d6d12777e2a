// Properties of prims that place or make curves.
#include "io/usd/reader.hpp"

#include "io/words.hpp"

#include <algorithm>
#include <iterator>

namespace plait {
namespace {

// Names that programs give to values of curves: USD's, Unreal's and Blender's.
struct Primvar {
    std::string_view name;
    UsdPrimvar UsdPrim::*of;
    size_t width;
    bool whole; // numbers
};
constexpr Primvar PRIMVARS[] = {
    {"primvars:st", &UsdPrim::uv, 2, false},
    {"primvars:uv", &UsdPrim::uv, 2, false},
    {"primvars:groom_root_uv", &UsdPrim::uv, 2, false},
    {"primvars:surface_uv_coordinate", &UsdPrim::uv, 2, false},
    {"widths", &UsdPrim::widths, 1, false},
    {"primvars:widths", &UsdPrim::widths, 1, false},
    {"primvars:groom_width", &UsdPrim::widths, 1, false},
    {"primvars:groom_guide", &UsdPrim::guide, 1, true},
    {"primvars:groom_group_id", &UsdPrim::group, 1, true},
    {"primvars:groom_id", &UsdPrim::id, 1, true},
    {"primvars:groom_closest_guides", &UsdPrim::guide_ids, 3, true},
    {"primvars:groom_guide_weights", &UsdPrim::guide_weights, 3, false}};
constexpr std::string_view INDICES = ":indices";

const Primvar* find_primvar(std::string_view name) {
    const auto found = std::ranges::find(PRIMVARS, name, &Primvar::name);
    return found == std::end(PRIMVARS) ? nullptr : found;
}

PackedFloats floats_of(const ByteWriter& bytes) {
    return {bytes.bytes().data(), bytes.size() / sizeof(float)};
}

PackedIntegers integers_of(const ByteWriter& bytes) {
    return {bytes.bytes().data(), bytes.size() / sizeof(int32_t), sizeof(int32_t), true};
}

} // namespace

// A value, or of samples, {time: value, ...}, that of the earliest time. `parse` reads one.
template <typename Parse>
Status UsdReader::read_value(const UsdPrim& prim, bool samples, const Parse& parse) {
    if (!samples) {
        if (!text_.next_is('N'))
            return parse();
        return text_.skip_value(); // None
    }
    PLAIT_TRY(text_.need('{'));
    size_t count = 0, first = 0;
    for (double earliest = 0; !text_.take('}'); ++count) {
        double time = 0;
        PLAIT_TRY(text_.number(time));
        PLAIT_TRY(text_.need(':'));
        if (count == 0 || time < earliest) {
            earliest = time;
            first = text_.place();
        }
        PLAIT_TRY(text_.skip_value());
        text_.take(',');
    }
    if (count == 0)
        return {};
    if (count > 1)
        moving_.add(prim.path);
    const size_t end = text_.place();
    text_.go_to(first);
    PLAIT_TRY(parse());
    text_.go_to(end);
    return {};
}

Status UsdReader::take_token(const UsdPrim& prim, std::string& to) {
    auto token = text_.string();
    PLAIT_TRY(token);
    if (token->size() > 32)
        return text_.bad(format("%s: has a word of %zu bytes; allowed are 32", prim.path.c_str(),
                                token->size()));
    to = *token;
    return {};
}

Status UsdReader::take_order(UsdPrim& prim) {
    prim.operations.clear();
    PLAIT_TRY(text_.need('['));
    while (!text_.take(']')) {
        auto name = text_.string();
        PLAIT_TRY(name);
        if (prim.operations.size() == MOST_OPERATIONS || name->size() > 128)
            return text_.bad(
                format("%s: its transform has more than %u operations, or one whose name "
                       "is longer than 128 bytes",
                       prim.path.c_str(), MOST_OPERATIONS));
        prim.operations.emplace_back(*name);
        text_.take(',');
    }
    return {};
}

Status UsdReader::take_property(UsdPrim& prim, std::string_view name, bool samples, bool& taken) {
    taken = true;
    if (name == "xformOpOrder")
        return take_order(prim);
    if (name.starts_with("xformOp:")) {
        if (prim.operands.size() == MOST_OPERATIONS || name.size() > 128)
            return text_.bad(
                format("%s: has more than %u operations, or one whose name is longer than "
                       "128 bytes",
                       prim.path.c_str(), MOST_OPERATIONS));
        UsdPrim::Operand& to = prim.operands[std::string(name)];
        return read_value(prim, samples, [&] {
            return text_.doubles(to.values.data(), to.values.size(), to.count);
        });
    }
    if (prim.type == "BasisCurves")
        return take_curves(prim, name, samples, taken);
    taken = false;
    return {};
}

Status UsdReader::take_curves(UsdPrim& prim, std::string_view name, bool samples, bool& taken) {
    const auto floats = [&](size_t width, ByteWriter& to) {
        to = ByteWriter(memory_);
        return read_value(prim, samples, [&] { return text_.floats(width, to); });
    };
    const auto integers = [&](ByteWriter& to) {
        to = ByteWriter(memory_);
        return read_value(prim, samples, [&] { return text_.integers(to); });
    };
    if (name == "points")
        return floats(3, prim.points);
    if (name == "curveVertexCounts")
        return integers(prim.counts);
    if (name.ends_with(INDICES))
        if (const Primvar* of = find_primvar(name.substr(0, name.size() - INDICES.size())))
            return integers((prim.*of->of).indices);
    if (const Primvar* of = find_primvar(name)) {
        ByteWriter& values = (prim.*of->of).values;
        return of->whole ? integers(values) : floats(of->width == 2 ? 2 : 1, values);
    }
    if (name == "type" || name == "basis" || name == "wrap")
        return read_value(prim, samples, [&] {
            return take_token(prim, name == "type"    ? prim.curve_type
                                    : name == "basis" ? prim.basis
                                                      : prim.wrap);
        });
    taken = name == "extent"; // which follows from the points
    return taken ? text_.skip_value() : Status();
}

Status UsdReader::expand(const UsdPrim& prim, std::string_view name, UsdPrimvar& of, size_t width) {
    const PackedIntegers indices = integers_of(of.indices);
    const std::span<const std::byte> values = of.values.bytes();
    const size_t bytes = width * sizeof(float), count = values.size() / bytes;
    ByteWriter expanded(memory_);
    expanded.reserve(bytes * indices.size());
    for (size_t i = 0; i < indices.size(); ++i) {
        const int64_t index = indices[i];
        if (index < 0 || static_cast<uint64_t>(index) >= count)
            return text_.bad(format("%s: index %zu of %s is %" PRId64 "; there are %zu values",
                                    prim.path.c_str(), i, std::string(name).c_str(), index, count));
        expanded.add(values.subspan(bytes * static_cast<size_t>(index), bytes));
    }
    of.values = std::move(expanded);
    of.indices = ByteWriter(memory_);
    return {};
}

Status UsdReader::add_curves(UsdPrim& prim, const Matrix& to_world) {
    if (prim.wrap == "periodic" || (prim.wrap != "nonperiodic" && prim.wrap != "pinned"))
        return Error{
            PLAIT_UNSUPPORTED,
            format("%s: %s: wrap of its curves is \"%s\"; known are nonperiodic and pinned, "
                   "as strands have two ends",
                   text_.file().c_str(), prim.path.c_str(), shown(prim.wrap).c_str())};
    CurveObject curves;
    if (prim.curve_type == "cubic" && prim.basis == "bezier")
        curves.basis = CurveBasis::BEZIER;
    else if (prim.curve_type == "cubic" && prim.basis == "bspline")
        curves.basis = CurveBasis::B_SPLINE;
    else if (prim.curve_type == "cubic" && prim.basis == "catmullRom")
        curves.basis = CurveBasis::CATMULL_ROM;
    else if (prim.curve_type != "linear")
        return Error{
            PLAIT_UNSUPPORTED,
            format("%s: %s: its curves have type \"%s\" and basis \"%s\"; known are linear, "
                   "and cubic of bezier, bspline and catmullRom",
                   text_.file().c_str(), prim.path.c_str(), shown(prim.curve_type).c_str(),
                   shown(prim.basis).c_str())};
    curves.ends = prim.wrap == "pinned" ? CurveEnds::OUTER : CurveEnds::INNER;
    curves.place = text_.file() + ": " + prim.path;
    for (const Primvar& of : PRIMVARS)
        if ((prim.*of.of).indices.size() > 0)
            PLAIT_TRY(expand(prim, of.name, prim.*of.of, of.width));
    curves.points = floats_of(prim.points);
    curves.widths = floats_of(prim.widths.values);
    curves.uv = floats_of(prim.uv.values);
    curves.counts = integers_of(prim.counts);
    curves.guide = integers_of(prim.guide.values);
    curves.group = integers_of(prim.group.values);
    curves.id = integers_of(prim.id.values);
    curves.guide_ids = integers_of(prim.guide_ids.values);
    curves.guide_weights = floats_of(prim.guide_weights.values);
    curves.unit = metres_per_unit_;
    curves.to_world = to_world;
    if (z_up_) {
        Matrix up; // (x, y, z) becomes (x, z, -y)
        up.m[1] = {0, 0, -1, 0};
        up.m[2] = {0, 1, 0, 0};
        curves.to_world = to_world * up;
    }
    return strands_.add(curves);
}

} // namespace plait
