// What Alembic keeps in Ogawa: objects, their properties, the samples of these. Names and metadata are
// views of the file's bytes.
#pragma once

#include "io/alembic/ogawa.hpp"

#include <string_view>

namespace plait {

enum class AlembicType : uint32_t { COMPOUND = 0, SCALAR = 1, ARRAY = 2 };

// In a header, in place of an index of the archive's list of metadata: they follow.
constexpr uint32_t INLINE_METADATA = 0xff;

// The element types that curves use; the others are only named.
enum class AlembicPod : uint32_t {
    BOOL = 0,
    U8 = 1,
    I8 = 2,
    U16 = 3,
    I16 = 4,
    U32 = 5,
    I32 = 6,
    U64 = 7,
    I64 = 8,
    F16 = 9,
    F32 = 10,
    F64 = 11,
    STRING = 12,
    WSTRING = 13
};

struct AlembicObject {
    std::string_view name, metadata;
    OgawaGroup group;
};

struct AlembicProperty {
    std::string_view name, metadata;
    AlembicType type = AlembicType::COMPOUND;
    AlembicPod pod = AlembicPod::BOOL;
    uint32_t extent = 0; // values of an element
    uint32_t samples = 0;
    bool constant = true; // all samples are the first
    OgawaGroup group;
};

// The value of a key in metadata, "key=value;key=value"; "" if there is none.
std::string_view metadata_value(std::string_view metadata, std::string_view key);

// Whether an object has the schema, of any version: "AbcGeom_Curve".
bool has_schema(const AlembicObject& object, std::string_view schema);

class AlembicArchive {
  public:
    explicit AlembicArchive(const ByteReader& file) : file_(file), ogawa_(file) {}

    Result<AlembicObject> top();
    const ByteReader& bytes() const { return file_; }
    const OgawaFile& ogawa() const { return ogawa_; }

    // Calls `visit(const AlembicObject&)`, which returns a Status, for each child.
    template <typename Visit> Status children(const AlembicObject& object, const Visit& visit) {
        auto headers = headers_of(object.group, 32, "object headers");
        PLAIT_TRY(headers);
        for (uint64_t i = 1; headers->at < headers->end; ++i) {
            AlembicObject child;
            PLAIT_TRY(next_object(*headers, object, i, child));
            PLAIT_TRY(visit(child));
        }
        return {};
    }
    // The same with `visit(const AlembicProperty&)`.
    template <typename Visit> Status properties(const OgawaGroup& compound, const Visit& visit) {
        auto headers = headers_of(compound, 0, "property headers");
        PLAIT_TRY(headers);
        for (uint64_t i = 0; headers->at < headers->end; ++i) {
            AlembicProperty property;
            PLAIT_TRY(next_property(*headers, compound, i, property));
            PLAIT_TRY(visit(property));
        }
        return {};
    }
    Result<OgawaGroup> properties_of(const AlembicObject& object) const {
        return ogawa_.group(object.group, 0, "properties");
    }
    // Of the first sample, without its key; of none no bytes.
    Result<OgawaData> first_sample(const AlembicProperty& property) const;

  private:
    struct Headers {
        uint64_t at = 0, end = 0;
    };

    Result<Headers> headers_of(const OgawaGroup& group, uint64_t behind, const char* what) const;
    Status next_object(Headers& headers, const AlembicObject& parent, uint64_t index,
                       AlembicObject& out);
    Status next_property(Headers& headers, const OgawaGroup& compound, uint64_t index,
                         AlembicProperty& out);
    Status take_values(Headers& headers, uint32_t info, AlembicProperty& out) const;
    Status take_text(Headers& headers, uint32_t width, const char* what,
                     std::string_view& text) const;
    Status take_word(Headers& headers, uint32_t width, const char* what, uint32_t& word) const;
    Status indexed(uint64_t at, uint32_t index, std::string_view& metadata) const;
    Status count_header(uint64_t at);

    const ByteReader& file_;
    OgawaFile ogawa_;
    OgawaData metadata_;
    uint64_t headers_read_ = 0;
};

} // namespace plait
