// Grooms.
#include "api/objects.hpp"
#include "api/options.hpp"
#include "api/structs.hpp"
#include "api/view.hpp"
#include "core/base/units.hpp"
#include "core/follows/follow_map.hpp"
#include "core/groom/root_ends.hpp"
#include "core/sim/import_frame.hpp"
#include "io/io.hpp"

#include <plait/plait_formats.h>

#include <cmath>
#include <memory>

namespace plait::api {
namespace {

// A per-strand field is absent or has one element per strand.
Status check_count(const plait_view& view, size_t strands, const char* name) {
    if (view.count == 0 || view.count == strands)
        return {};
    return invalid(format("%s.count is %zu, there are %zu strands", name, view.count, strands));
}

Status copy_counts(const plait_groom_desc& desc, StrandSet& set) {
    const size_t vertices = desc.positions.count;
    if (desc.vertex_counts.count == 0) {
        if (desc.vertices_per_strand == 0)
            return invalid("desc->vertices_per_strand is 0 and vertex_counts is empty, give one");
        if (vertices % desc.vertices_per_strand != 0)
            return invalid(format("desc->positions.count is %zu, not a multiple of "
                                  "vertices_per_strand, %u",
                                  vertices, desc.vertices_per_strand));
        set.vertex_counts.assign(vertices / desc.vertices_per_strand, desc.vertices_per_strand);
        return {};
    }
    PLAIT_TRY(copy_view(desc.vertex_counts, 1, "desc->vertex_counts", set.vertex_counts));
    uint64_t sum = 0;
    for (const uint32_t count : set.vertex_counts)
        sum += count;
    if (sum != vertices)
        return invalid(format("desc->vertex_counts add up to %llu, positions.count is %zu",
                              static_cast<unsigned long long>(sum), vertices));
    return {};
}

Status copy_strands(const plait_groom_desc& desc, float scale, StrandSet& set) {
    PLAIT_TRY(copy_view(desc.positions, 3, "desc->positions", set.positions));
    PLAIT_TRY(copy_counts(desc, set));
    const size_t strands = set.vertex_counts.size();
    PLAIT_TRY(check_count(desc.strand_uv, strands, "desc->strand_uv"));
    PLAIT_TRY(check_count(desc.thickness, strands, "desc->thickness"));
    PLAIT_TRY(check_count(desc.bone_indices, strands, "desc->bone_indices"));
    PLAIT_TRY(check_count(desc.bone_weights, strands, "desc->bone_weights"));
    if (desc.bone_indices.count != desc.bone_weights.count)
        return invalid(format("desc->bone_indices.count is %zu, bone_weights.count is %zu: give "
                              "both or neither",
                              desc.bone_indices.count, desc.bone_weights.count));
    PLAIT_TRY(copy_view(desc.strand_uv, 2, "desc->strand_uv", set.strand_uv));
    PLAIT_TRY(copy_view(desc.thickness, 1, "desc->thickness", set.thickness));
    PLAIT_TRY(copy_view(desc.bone_indices, 4, "desc->bone_indices", set.bone_indices));
    PLAIT_TRY(copy_view(desc.bone_weights, 4, "desc->bone_weights", set.bone_weights));
    for (float& coordinate : set.positions)
        coordinate *= scale;
    for (float& diameter : set.thickness)
        diameter *= scale;
    return {};
}

// Mends what `read` (a callable: memory, notes -> Result<StrandSet>) gives and makes the handle.
// `file`: null where strands come from memory.
template <typename Read>
Status make_groom(const plait_import_options& options, const char* file, plait_groom** out,
                  const Read& read) {
    Memory memory(options.allocator);
    auto handle = make_in<plait_groom>(&memory, options.allocator);
    auto raw = read(&memory, handle->notes);
    if (!raw)
        return raw.error();
    place_points(raw->positions, options.axes, options.pose);
    if (options.root_end == PLAIT_ROOT_END_LAST)
        turn_all_around(*raw);
    auto groom =
        build_groom(*raw, {options.policy, options.min_segment, options.resample, options.root_end},
                    &handle->own);
    if (!groom)
        return file ? Error{groom.error().code,
                            format("%s: %s", file, groom.error().message.c_str())}
                    : groom.error();
    handle->groom = std::move(*groom);
    *out = handle.release();
    return {};
}

Status load_groom(const char* path, plait_strand_part part, const plait_import_options* options,
                  plait_groom** out) {
    PLAIT_TRY(need(path, "path"));
    PLAIT_TRY(need(out, "out"));
    if (part < 0 || part > PLAIT_STRAND_PART_FOLLOWS)
        return invalid(format("part is %d, range is [0, %d]", static_cast<int>(part),
                              PLAIT_STRAND_PART_FOLLOWS));
    plait_import_options rules;
    PLAIT_TRY(read_options(options, rules));
    return make_groom(rules, path, out, [&](Memory* memory, std::string& notes) {
        return read_strands(path, {rules.scale, memory, static_cast<StrandPart>(part), &notes});
    });
}

struct Destroy {
    void operator()(plait_groom* groom) const { destroy(groom); }
};
using GroomPtr = std::unique_ptr<plait_groom, Destroy>;

Result<GroomPtr> load_part(const char* path, plait_strand_part part,
                           const plait_import_options* options) {
    plait_groom* groom = nullptr;
    PLAIT_TRY(load_groom(path, part, options, &groom));
    return GroomPtr(groom);
}

// What became of the strands that follow.
void add_notes(const Groom& follows, const std::string& notes, std::string& to) {
    const auto add = [&](const std::string& sentence) {
        if (!sentence.empty() && to.find(sentence) == std::string::npos)
            to += (to.empty() ? "" : "; ") + ("of strands that follow: " + sentence);
    };
    add(notes);
    if (const uint64_t repairs = follows.repairs.total(); repairs > 0)
        add(format("%llu repairs, the first: %s", static_cast<unsigned long long>(repairs),
                   follows.repairs.first.c_str()));
}

plait_groom_info empty_info() {
    plait_groom_info info{};
    info.likely_scale = 1;
    return info;
}

plait_groom_info describe(const Groom& groom) {
    const GroomShape& shape = groom.shape;
    plait_groom_info info{};
    info.strands = shape.strands;
    info.vertices = shape.vertices;
    info.min_vertices = shape.min_vertices;
    info.max_vertices = shape.max_vertices;
    info.has_strand_uv = !groom.strands.strand_uv.empty();
    info.has_thickness = !groom.strands.thickness.empty();
    info.bones = shape.bones;
    std::copy(shape.bounds_min.begin(), shape.bounds_min.end(), info.bounds_min);
    std::copy(shape.bounds_max.begin(), shape.bounds_max.end(), info.bounds_max);
    info.min_length = static_cast<float>(shape.min_length);
    info.mean_length = static_cast<float>(shape.mean_length);
    info.max_length = static_cast<float>(shape.max_length);
    info.likely_scale = static_cast<float>(likely_scale(shape.mean_length, shape.extent()));
    std::copy(groom.repairs.count.begin(), groom.repairs.count.end(), info.repairs);
    info.repairs_total = groom.repairs.total();
    groom.repairs.first.copy(info.first_repair, sizeof info.first_repair - 1);
    info.roots_contradicted = groom.roots_contradicted;
    info.thickness_unlikely = groom.thickness_unlikely;
    std::string warning = size_warning(shape.mean_length, shape.extent());
    if (const std::string more = groom_warning(groom); !more.empty())
        warning += (warning.empty() ? "" : "; ") + more;
    warning.copy(info.warning, sizeof info.warning - 1);
    return info;
}

Result<std::span<const std::byte>> field_bytes(const StrandSet& set, plait_groom_field field) {
    switch (field) {
    case PLAIT_GROOM_FIELD_POSITIONS:
        return bytes_of(set.positions);
    case PLAIT_GROOM_FIELD_VERTEX_COUNTS:
        return bytes_of(set.vertex_counts);
    case PLAIT_GROOM_FIELD_STRAND_UV:
        return bytes_of(set.strand_uv);
    case PLAIT_GROOM_FIELD_THICKNESS:
        return bytes_of(set.thickness);
    case PLAIT_GROOM_FIELD_BONE_INDICES:
        return bytes_of(set.bone_indices);
    case PLAIT_GROOM_FIELD_BONE_WEIGHTS:
        return bytes_of(set.bone_weights);
    case PLAIT_GROOM_FIELD_GROUP:
        return bytes_of(set.group);
    default:
        return invalid(format("field is %d, range is [0, %d]", field, PLAIT_GROOM_FIELD_GROUP));
    }
}

} // namespace
} // namespace plait::api

using namespace plait;

extern "C" {

void plait_groom_desc_init(plait_groom_desc* desc, size_t size) {
    api::init_struct(desc, size, plait_groom_desc{});
}

void plait_groom_info_init(plait_groom_info* info, size_t size) {
    api::init_struct(info, size, api::empty_info());
}

plait_result plait_groom_create(const plait_groom_desc* desc, const plait_import_options* options,
                                plait_groom** out) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(out, "out"));
        plait_groom_desc given{};
        PLAIT_TRY(api::read_struct(desc, given, "desc"));
        plait_import_options rules;
        PLAIT_TRY(api::read_options(options, rules));
        return api::make_groom(rules, nullptr, out,
                               [&](Memory* memory, std::string&) -> Result<StrandSet> {
                                   StrandSet set(memory);
                                   PLAIT_TRY(api::copy_strands(given, rules.scale, set));
                                   return set;
                               });
    });
}

plait_result plait_groom_load(const char* path, const plait_import_options* options,
                              plait_groom** out) {
    return api::guard(__func__,
                      [&] { return api::load_groom(path, PLAIT_STRAND_PART_ALL, options, out); });
}

plait_result plait_groom_load_part(const char* path, plait_strand_part part,
                                   const plait_import_options* options, plait_groom** out) {
    return api::guard(__func__, [&] { return api::load_groom(path, part, options, out); });
}

plait_result plait_groom_load_guides(const char* path, const plait_import_options* options,
                                     plait_groom** guides, plait_follow_map** map) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(guides, "guides"));
        PLAIT_TRY(api::need(map, "map"));
        auto kept = api::load_part(path, PLAIT_STRAND_PART_GUIDES, options);
        PLAIT_TRY(kept);
        const auto follows = api::load_part(path, PLAIT_STRAND_PART_FOLLOWS, options);
        PLAIT_TRY(follows);
        const plait_allocator allocator = (*kept)->own.allocator();
        Memory memory(allocator);
        auto made = make_in<plait_follow_map>(&memory, allocator);
        const Status named = follow_named((*kept)->groom, (*follows)->groom, made->map);
        if (!named)
            return Error{named.error().code, format("%s: %s", path, named.error().message.c_str())};
        api::add_notes((*follows)->groom, (*follows)->notes, (*kept)->notes);
        *guides = kept->release();
        *map = made.release();
        return {};
    });
}

plait_result plait_groom_read_notes(const plait_groom* groom, char* dst, size_t* size) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(groom, "groom"));
        const auto wanted = api::wants_bytes(dst, size, groom->notes.size() + 1);
        PLAIT_TRY(wanted);
        if (*wanted)
            std::memcpy(dst, groom->notes.c_str(), groom->notes.size() + 1);
        return {};
    });
}

plait_result plait_groom_save(const plait_groom* groom, const char* path) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(groom, "groom"));
        PLAIT_TRY(api::need(path, "path"));
        return write_strands(path, groom->groom.strands);
    });
}

plait_result plait_groom_describe(const plait_groom* groom, plait_groom_info* out) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(groom, "groom"));
        PLAIT_TRY(api::check_output(out, "out"));
        api::write_struct(out, api::describe(groom->groom));
        return {};
    });
}

plait_result plait_groom_read(const plait_groom* groom, plait_groom_field field, void* dst,
                              size_t* size) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(groom, "groom"));
        const auto bytes = api::field_bytes(groom->groom.strands, field);
        if (!bytes)
            return bytes.error();
        const auto wanted = api::wants_bytes(dst, size, bytes->size());
        if (!wanted)
            return wanted.error();
        if (*wanted && !bytes->empty())
            std::memcpy(dst, bytes->data(), bytes->size());
        return {};
    });
}

void plait_groom_destroy(plait_groom* groom) {
    api::destroy(groom);
}
}
