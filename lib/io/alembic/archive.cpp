#include "io/alembic/archive.hpp"

#include <algorithm>

namespace plait {
namespace {

constexpr uint64_t KEY_SIZE = 16;       // before each sample, a hash of it
constexpr uint64_t SMALLEST_HEADER = 4; // bytes

} // namespace

std::string_view metadata_value(std::string_view metadata, std::string_view key) {
    while (!metadata.empty()) {
        const std::string_view entry = metadata.substr(0, metadata.find(';'));
        if (entry.starts_with(key) && entry.substr(key.size()).starts_with('='))
            return entry.substr(key.size() + 1);
        metadata.remove_prefix(std::min(entry.size() + 1, metadata.size()));
    }
    return {};
}

bool has_schema(const AlembicObject& object, std::string_view schema) {
    const std::string_view has = metadata_value(object.metadata, "schema");
    return has.starts_with(schema) && has.substr(schema.size()).starts_with("_v");
}

// Children of the root: version, version of the library, top object, metadata of the archive, times,
// metadata that headers name by index.
Result<AlembicObject> AlembicArchive::top() {
    auto root = ogawa_.root();
    PLAIT_TRY(root);
    auto version = ogawa_.data(*root, 0, "version");
    PLAIT_TRY(version);
    if (version->size != 4 || file_.u32(version->at) != 0)
        return file_.bad(version->at,
                         format("version is %" PRIu32 " in %" PRIu64 " bytes; allowed is 0 in 4",
                                version->size < 4 ? 0 : file_.u32(version->at), version->size));
    auto metadata = ogawa_.data(*root, 5, "indexed metadata");
    PLAIT_TRY(metadata);
    metadata_ = *metadata;
    auto group = ogawa_.group(*root, 2, "top object");
    PLAIT_TRY(group);
    AlembicObject object;
    object.group = *group;
    return object;
}

Result<AlembicArchive::Headers> AlembicArchive::headers_of(const OgawaGroup& group, uint64_t behind,
                                                           const char* what) const {
    if (group.count == 0 || !ogawa_.is_data(group, group.count - 1))
        return Headers{}; // without children of its kind
    auto data = ogawa_.data(group, group.count - 1, what);
    PLAIT_TRY(data);
    if (data->size < behind)
        return data->size == 0
                   ? Result<Headers>(Headers{})
                   : file_.bad(data->at,
                               format("%s have %" PRIu64 " bytes; at least %" PRIu64 " are needed",
                                      what, data->size, behind));
    return Headers{data->at, data->at + data->size - behind};
}

// Each takes some of the file's bytes, so that more of them means groups that are their own parents.
Status AlembicArchive::count_header(uint64_t at) {
    if (++headers_read_ <= file_.size() / SMALLEST_HEADER)
        return {};
    return file_.bad(at, format("header %" PRIu64 " is more than the file's %" PRIu64
                                " bytes hold: groups contain themselves",
                                headers_read_, file_.size()));
}

Status AlembicArchive::take_word(Headers& headers, uint32_t width, const char* what,
                                 uint32_t& word) const {
    if (headers.end - headers.at < width)
        return file_.bad(headers.at,
                         format("%s: %u bytes do not fit in the headers, which end at byte "
                                "%" PRIu64,
                                what, width, headers.end));
    word = width == 1   ? file_.u8(headers.at)
           : width == 2 ? file_.u16(headers.at)
                        : file_.u32(headers.at);
    headers.at += width;
    return {};
}

// A size of `width` bytes and as many characters.
Status AlembicArchive::take_text(Headers& headers, uint32_t width, const char* what,
                                 std::string_view& text) const {
    const uint64_t field = headers.at;
    uint32_t size = 0;
    PLAIT_TRY(take_word(headers, width, what, size));
    if (size > headers.end - headers.at)
        return file_.bad(field, format("%s has %" PRIu32 " bytes; allowed are 0 to %" PRIu64, what,
                                       size, headers.end - headers.at));
    text = file_.view(headers.at, size);
    headers.at += size;
    return {};
}

Status AlembicArchive::indexed(uint64_t at, uint32_t index, std::string_view& metadata) const {
    uint64_t next = metadata_.at;
    const uint64_t end = metadata_.at + metadata_.size;
    for (uint32_t i = 0; i < index; ++i) {
        if (next >= end || file_.u8(next) > end - next - 1)
            return file_.bad(at, format("index of metadata is %u; the archive has %u", index, i));
        metadata = file_.view(next + 1, file_.u8(next));
        next += 1 + metadata.size();
    }
    return {};
}

Status AlembicArchive::next_object(Headers& headers, const AlembicObject& parent, uint64_t index,
                                   AlembicObject& out) {
    const uint64_t field = headers.at;
    PLAIT_TRY(count_header(field));
    PLAIT_TRY(take_text(headers, 4, "object name", out.name));
    uint32_t metadata = 0;
    PLAIT_TRY(take_word(headers, 1, "index of metadata", metadata));
    if (metadata == INLINE_METADATA)
        PLAIT_TRY(take_text(headers, 4, "object metadata", out.metadata));
    else
        PLAIT_TRY(indexed(field, metadata, out.metadata));
    auto group = ogawa_.group(parent.group, index, "object");
    PLAIT_TRY(group);
    out.group = *group;
    return {};
}

// Bits of a property's header: type 0-1, width of its numbers 2-3, element type 4-7, has a time sampling
// 8, says which samples changed first and last 9, constant 11, extent 12-19, index of metadata 20-27.
Status AlembicArchive::next_property(Headers& headers, const OgawaGroup& compound, uint64_t index,
                                     AlembicProperty& out) {
    const uint64_t field = headers.at;
    PLAIT_TRY(count_header(field));
    uint32_t info = 0;
    PLAIT_TRY(take_word(headers, 4, "property header", info));
    const uint32_t hint = info >> 2 & 3, type = info & 3;
    if (hint > 2)
        return file_.bad(field,
                         format("width of the property's numbers is %u; allowed 0 to 2", hint));
    const uint32_t width = 1u << hint;
    out.type = type == 0   ? AlembicType::COMPOUND
               : type == 1 ? AlembicType::SCALAR
                           : AlembicType::ARRAY;
    if (out.type != AlembicType::COMPOUND)
        PLAIT_TRY(take_values(headers, info, out));
    PLAIT_TRY(take_text(headers, width, "property name", out.name));
    const uint32_t metadata = info >> 20 & 0xff;
    if (metadata == INLINE_METADATA)
        PLAIT_TRY(take_text(headers, width, "property metadata", out.metadata));
    else
        PLAIT_TRY(indexed(field, metadata, out.metadata));
    auto group = ogawa_.group(compound, index, "property");
    PLAIT_TRY(group);
    out.group = *group;
    return {};
}

Status AlembicArchive::take_values(Headers& headers, uint32_t info, AlembicProperty& out) const {
    const uint64_t field = headers.at - 4;
    const uint32_t pod = info >> 4 & 15, width = 1u << (info >> 2 & 3);
    if (pod > static_cast<uint32_t>(AlembicPod::WSTRING))
        return file_.bad(field, format("element type is %u; allowed 0 to 13", pod));
    out.pod = static_cast<AlembicPod>(pod);
    out.extent = info >> 12 & 0xff;
    PLAIT_TRY(take_word(headers, width, "number of samples", out.samples));
    uint32_t first_changed = info & 0x800 ? 0 : 1, last_changed = 0, times = 0;
    if (info & 0x200) {
        PLAIT_TRY(take_word(headers, width, "first changed sample", first_changed));
        PLAIT_TRY(take_word(headers, width, "last changed sample", last_changed));
    }
    if (info & 0x100)
        PLAIT_TRY(take_word(headers, width, "time sampling", times));
    out.constant = out.samples < 2 || first_changed == 0;
    return {};
}

Result<OgawaData> AlembicArchive::first_sample(const AlembicProperty& property) const {
    if (property.samples == 0)
        return OgawaData{};
    auto data = ogawa_.data(property.group, 0, "first sample");
    PLAIT_TRY(data);
    if (data->size < KEY_SIZE)
        return data->size == 0 ? data
                               : file_.bad(data->at, format("a sample has %" PRIu64
                                                            " bytes; its key alone has 16",
                                                            data->size));
    return OgawaData{data->at + KEY_SIZE, data->size - KEY_SIZE};
}

} // namespace plait
