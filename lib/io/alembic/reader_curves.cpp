// The properties of an object with curves.
#include "io/alembic/reader.hpp"

#include "io/words.hpp"

namespace plait {
namespace {

// What follows from the points.
constexpr std::string_view DERIVED[] = {".selfBnds", ".childBnds"};

} // namespace

Status AlembicReader::note_unused(const AlembicProperty& property) {
    auto empty = samples_.is_empty(property);
    PLAIT_TRY(empty);
    if (!*empty)
        unused_.add(property.name);
    return {};
}

Status AlembicReader::read_basis(const AlembicProperty& property, CurveObject& out) {
    auto values = samples_.integers(out.place, property);
    PLAIT_TRY(values);
    if (values->size() != 4)
        return Error{PLAIT_BAD_DATA, format("%s: curveBasisAndType has %zu values; allowed are 4",
                                            out.place.c_str(), values->size())};
    const int64_t type = (*values)[0], wrap = (*values)[1], basis = (*values)[2];
    if (wrap != 0)
        return Error{PLAIT_UNSUPPORTED, format("%s: its curves are closed (wrap is %" PRId64
                                               "); strands have two ends (0)",
                                               out.place.c_str(), wrap)};
    if (type == 1)
        return {};
    has_basis_ = basis != 0;
    if (type != 0 || basis < 0 || basis > 3)
        return Error{PLAIT_UNSUPPORTED,
                     format("%s: its curves have type %" PRId64 " and basis %" PRId64
                            "; known are type 1 (linear) and type 0 (cubic) of basis 1 (Bezier), 2 "
                            "(B-spline) and 3 (Catmull-Rom), or without basis (0) but with knots",
                            out.place.c_str(), type, basis)};
    out.basis = basis == 1   ? CurveBasis::BEZIER
                : basis == 3 ? CurveBasis::CATMULL_ROM
                             : CurveBasis::B_SPLINE;
    return {};
}

template <typename T> static Status keep(Result<T> from, T& to) {
    PLAIT_TRY(from);
    to = *from;
    return {};
}

Status AlembicReader::read_property(const AlembicProperty& property, CurveObject& out) {
    const std::string_view name = property.name;
    if (property.type != AlembicType::COMPOUND && !property.constant && name == "P")
        moving_.add(std::string_view(out.place).substr(file_.file().size() + 2));
    if (name == "P")
        return keep(samples_.floats(out.place, property, 3), out.points);
    if (name == "nVertices")
        return keep(samples_.integers(out.place, property), out.counts);
    if (name == "width")
        return keep(samples_.floats(out.place, property, 1), plain_width_);
    if (name == "uv")
        return keep(samples_.floats(out.place, property, 2), plain_uv_);
    if (name == ".knots")
        return keep(samples_.floats(out.place, property, 1), out.knots);
    if (name == ".orders")
        return {}; // linear and cubic curves have two and four
    if (name == "curveBasisAndType")
        return read_basis(property, out);
    if (name == ".arbGeomParams" && property.type == AlembicType::COMPOUND)
        return archive_.properties(property.group, [&](const AlembicProperty& attribute) {
            return read_attribute(attribute, out);
        });
    if (is_one_of(name, DERIVED))
        return {};
    return note_unused(property);
}

Status AlembicReader::take_version(const AlembicProperty& property, const std::string& place) {
    auto version = samples_.integers(place, property);
    PLAIT_TRY(version);
    if (!version->empty())
        version_[property.name.ends_with("minor")] = (*version)[0];
    return {};
}

// Unreal's, in whose names all begin with groom_, and which win over Alembic's.
Status AlembicReader::read_attribute(const AlembicProperty& property, CurveObject& out) {
    const std::string_view name = property.name;
    if (name == "groom_width")
        return keep(samples_.floats(out.place, property, 1), out.widths);
    if (name == "groom_root_uv")
        return keep(samples_.floats(out.place, property, 2), out.uv);
    if (name == "groom_guide")
        return keep(samples_.integers(out.place, property), out.guide);
    if (name == "groom_group_id")
        return keep(samples_.integers(out.place, property), out.group);
    if (name == "groom_id")
        return keep(samples_.integers(out.place, property), out.id);
    if (name == "groom_closest_guides")
        return keep(samples_.integers(out.place, property), out.guide_ids);
    if (name == "groom_guide_weights")
        return keep(samples_.floats(out.place, property, StrandSet::guides_of_file),
                    out.guide_weights);
    if (name == "groom_version_major" || name == "groom_version_minor")
        return take_version(property, out.place);
    return note_unused(property);
}

Status AlembicReader::read_curves(const AlembicObject& object, const Matrix& to_world,
                                  const std::string& place) {
    samples_.clear();
    plain_width_ = plain_uv_ = {};
    has_basis_ = true;
    CurveObject curves;
    curves.place = place;
    curves.to_world = to_world;
    auto properties = archive_.properties_of(object);
    PLAIT_TRY(properties);
    PLAIT_TRY(archive_.properties(*properties, [&](const AlembicProperty& schema) -> Status {
        if (schema.name != ".geom" || schema.type != AlembicType::COMPOUND)
            return {};
        return archive_.properties(schema.group, [&](const AlembicProperty& property) {
            return read_property(property, curves);
        });
    }));
    if (!has_basis_ && curves.knots.empty())
        return Error{PLAIT_UNSUPPORTED, place +
                                            ": its curves are cubic, of basis 0 (none) and without "
                                            "knots; known are 1 (Bezier), 2 (B-spline) and 3 "
                                            "(Catmull-Rom)"};
    if (curves.basis != CurveBasis::B_SPLINE && !curves.knots.empty()) {
        unused_.add(".knots");
        curves.knots = {};
    }
    if (curves.widths.empty())
        curves.widths = plain_width_;
    if (curves.uv.empty())
        curves.uv = plain_uv_;
    return strands_.add(curves);
}

} // namespace plait
