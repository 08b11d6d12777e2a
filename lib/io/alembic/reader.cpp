#include "io/alembic/reader.hpp"

#include "io/formats.hpp"

namespace plait {

Status AlembicReader::visit(const AlembicObject& object, const Matrix& to_world,
                            const std::string& path, uint32_t level) {
    if (level > MOST_LEVELS)
        return file_.bad(object.group.at,
                         format("objects lie in more than %u levels of others", MOST_LEVELS));
    return archive_.children(object, [&](const AlembicObject& child) -> Status {
        const std::string place = path + "/" + shown(child.name);
        Matrix placed = to_world;
        if (has_schema(child, "AbcGeom_Xform")) {
            auto local = read_xform(child, to_world, file_.file() + ": " + place);
            PLAIT_TRY(local);
            placed = *local;
        } else if (has_schema(child, "AbcGeom_Curve")) {
            PLAIT_TRY(read_curves(child, to_world, file_.file() + ": " + place));
        } else if (const auto schema = metadata_value(child.metadata, "schema"); !schema.empty()) {
            other_objects_.add(schema);
        } else if (metadata_value(child.metadata, "isInstance") == "1") {
            other_objects_.add("instance");
        }
        return visit(child, placed, place, level + 1);
    });
}

Result<StrandSet> AlembicReader::read(Notes& notes) {
    auto top = archive_.top();
    PLAIT_TRY(top);
    PLAIT_TRY(visit(*top, {}, "", 1));
    if (version_[0] >= 0)
        notes.add(format("Unreal's groom schema, version %" PRId64 ".%" PRId64, version_[0],
                         std::max<int64_t>(version_[1], 0)));
    auto strands = strands_.finish(file_.file(), notes);
    PLAIT_TRY(strands);
    notes.add("of its transforms and curves move and are read at their first sample", moving_);
    notes.add("properties are not read", unused_);
    notes.add("objects are not read", other_objects_);
    return strands;
}

Result<StrandSet> read_alembic(const ByteReader& file, const ReadOptions& options) {
    Notes notes;
    auto strands = AlembicReader(file, options).read(notes);
    if (options.notes)
        *options.notes = notes.take();
    return strands;
}

} // namespace plait
