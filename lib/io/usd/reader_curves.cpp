// Properties of prims that place or make curves.
#include "io/usd/reader.hpp"

#include "io/words.hpp"

namespace plait {
namespace {

// Names that programs give them: USD's, Unreal's and Blender's.
constexpr std::string_view UV[] = {"primvars:st", "primvars:uv", "primvars:groom_root_uv",
                                   "primvars:surface_uv_coordinate"};
constexpr std::string_view UV_INDICES[] = {"primvars:st:indices", "primvars:uv:indices"};
constexpr std::string_view WIDTHS[] = {"widths", "primvars:widths", "primvars:groom_width"};

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
    if (is_one_of(name, WIDTHS))
        return floats(1, prim.widths);
    if (is_one_of(name, UV))
        return floats(2, prim.uv);
    if (is_one_of(name, UV_INDICES))
        return integers(prim.uv_indices);
    if (name == "primvars:groom_guide")
        return integers(prim.guide);
    if (name == "primvars:groom_group_id")
        return integers(prim.group);
    if (name == "primvars:groom_id")
        return integers(prim.id);
    if (name == "primvars:groom_closest_guides")
        return integers(prim.guide_ids);
    if (name == "primvars:groom_guide_weights")
        return floats(1, prim.guide_weights);
    if (name == "type" || name == "basis" || name == "wrap")
        return read_value(prim, samples, [&] {
            return take_token(prim, name == "type"    ? prim.curve_type
                                    : name == "basis" ? prim.basis
                                                      : prim.wrap);
        });
    taken = name == "extent"; // which follows from the points
    return taken ? text_.skip_value() : Status();
}

Status UsdReader::expand_uv(UsdPrim& prim) {
    const PackedIntegers indices = integers_of(prim.uv_indices);
    const PackedFloats values = floats_of(prim.uv);
    ByteWriter expanded(memory_);
    expanded.reserve(2 * sizeof(float) * indices.size());
    for (size_t i = 0; i < indices.size(); ++i) {
        const int64_t index = indices[i];
        if (index < 0 || static_cast<uint64_t>(index) >= values.size() / 2)
            return text_.bad(format("%s: index %zu of uv is %" PRId64 "; there are %zu values",
                                    prim.path.c_str(), i, index, values.size() / 2));
        for (size_t k = 0; k < 2; ++k)
            expanded.f32(values[2 * static_cast<size_t>(index) + k]);
    }
    prim.uv = std::move(expanded);
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
    if (prim.uv_indices.size() > 0)
        PLAIT_TRY(expand_uv(prim));
    curves.points = floats_of(prim.points);
    curves.widths = floats_of(prim.widths);
    curves.uv = floats_of(prim.uv);
    curves.counts = integers_of(prim.counts);
    curves.guide = integers_of(prim.guide);
    curves.group = integers_of(prim.group);
    curves.id = integers_of(prim.id);
    curves.guide_ids = integers_of(prim.guide_ids);
    curves.guide_weights = floats_of(prim.guide_weights);
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
