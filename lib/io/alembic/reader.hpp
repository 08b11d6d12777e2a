// From the objects of an Alembic archive to strands.
#pragma once

#include "io/alembic/samples.hpp"
#include "io/curves/curve_set.hpp"

namespace plait {

class AlembicReader {
  public:
    AlembicReader(const ByteReader& file, const ReadOptions& options)
        : file_(file), archive_(file), samples_(archive_, options.memory),
          strands_(options, file.size()) {}

    // BAD_DATA, UNSUPPORTED.
    Result<StrandSet> read(Notes& notes);

  private:
    static constexpr uint32_t MOST_LEVELS = 128;

    Status visit(const AlembicObject& object, const Matrix& to_world, const std::string& path,
                 uint32_t level);
    // reader_xform.cpp
    Result<Matrix> read_xform(const AlembicObject& object, const Matrix& parent,
                              const std::string& place);
    // reader_curves.cpp
    Status read_curves(const AlembicObject& object, const Matrix& to_world,
                       const std::string& place);
    Status read_property(const AlembicProperty& property, CurveObject& out);
    Status read_attribute(const AlembicProperty& property, CurveObject& out);
    Status read_basis(const AlembicProperty& property, CurveObject& out);
    Status take_version(const AlembicProperty& property, const std::string& place);
    Status note_unused(const AlembicProperty& property);

    const ByteReader& file_;
    AlembicArchive archive_;
    AlembicSamples samples_;
    StrandBuilder strands_;
    Names unused_;                        // properties
    Names other_objects_;                 // by schema
    Names moving_;                        // transforms and curves of more than one sample
    bool has_basis_ = true;               // the object in hand
    PackedFloats plain_width_, plain_uv_; // those of Alembic, in place of which Unreal's are taken
    int64_t version_[2] = {-1, -1};       // of Unreal's schema
};

} // namespace plait
