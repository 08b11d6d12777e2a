// Strands that follow: what they are and what of.
#include "core/follows/bind.hpp"

#include "api/hair_frame.hpp"
#include "api/objects.hpp"
#include "api/structs.hpp"
#include "api/view.hpp"

#include <plait/plait_offline.h>

#include <cmath>

namespace plait::api {
namespace {

// Four of each strand.
Status check_count(const plait_view& view, size_t follows, const char* name) {
    if (view.count == follows)
        return {};
    return invalid(
        format("%s.count is %zu, there are %zu strands that follow", name, view.count, follows));
}

// Whose guides have how many vertices, the sim knows.
Status read_bound(const plait_view& view, std::pmr::vector<float>& to) {
    constexpr float far = 1e6f; // m
    PLAIT_TRY(copy_view(view, 3, "desc->guides_bound", to));
    for (size_t i = 0; i < to.size(); ++i)
        if (!(std::abs(to[i]) <= far))
            return invalid(format("desc->guides_bound[%zu][%zu] is %g, range is [-1e6, 1e6] m",
                                  i / 3, i % 3, double(to[i])));
    return {};
}

Status fill(FollowMap& map, const plait_follow_map_desc& desc) {
    constexpr size_t width = FollowMap::per_strand;
    const Groom& groom = desc.follows->groom;
    std::pmr::memory_resource* const memory = map.guides.get_allocator().resource();
    std::pmr::vector<uint32_t> guides(memory);
    std::pmr::vector<float> weights(memory);
    PLAIT_TRY(check_count(desc.guides, groom.shape.strands, "desc->guides"));
    PLAIT_TRY(check_count(desc.weights, groom.shape.strands, "desc->weights"));
    PLAIT_TRY(copy_view(desc.guides, width, "desc->guides", guides));
    PLAIT_TRY(copy_view(desc.weights, width, "desc->weights", weights));
    PLAIT_TRY(read_bound(desc.guides_bound, map.bound));
    map.strands.positions.assign(groom.strands.positions.begin(), groom.strands.positions.end());
    map.strands.vertex_counts.assign(groom.strands.vertex_counts.begin(),
                                     groom.strands.vertex_counts.end());
    map.max_vertices = groom.shape.max_vertices;
    map.guide_count = desc.guide_count;
    return set_guides(map, guides, weights);
}

Result<std::span<const std::byte>> field_bytes(const FollowMap& map, plait_follow_map_field field) {
    switch (field) {
    case PLAIT_FOLLOW_MAP_FIELD_GUIDES:
        return bytes_of(map.guides);
    case PLAIT_FOLLOW_MAP_FIELD_WEIGHTS:
        return bytes_of(map.weights);
    case PLAIT_FOLLOW_MAP_FIELD_STRANDS:
        return bytes_of(map.origin);
    default:
        return invalid(
            format("field is %d, range is [0, %d]", field, PLAIT_FOLLOW_MAP_FIELD_STRANDS));
    }
}

} // namespace
} // namespace plait::api

using namespace plait;

extern "C" {

void plait_follow_map_desc_init(plait_follow_map_desc* desc, size_t size) {
    api::init_struct(desc, size, plait_follow_map_desc{});
}

plait_result plait_follow_map_create(const plait_follow_map_desc* desc, plait_follow_map** out) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(out, "out"));
        plait_follow_map_desc given{};
        PLAIT_TRY(api::read_struct(desc, given, "desc"));
        PLAIT_TRY(api::need(given.follows, "desc->follows"));
        if (given.guide_count == 0)
            return api::invalid("desc->guide_count is 0, range is [1, 2^32 - 1]");
        const plait_allocator allocator = given.follows->own.allocator();
        Memory memory(allocator);
        auto handle = make_in<plait_follow_map>(&memory, allocator);
        PLAIT_TRY(api::fill(handle->map, given));
        *out = handle.release();
        return {};
    });
}

plait_result plait_groom_guides(const plait_groom* groom, size_t guides, uint64_t seed,
                                plait_groom** out, plait_follow_map** map) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(groom, "groom"));
        PLAIT_TRY(api::need(out, "out"));
        PLAIT_TRY(api::need(map, "map"));
        const plait_allocator allocator = groom->own.allocator();
        Memory memory(allocator);
        auto chosen = make_in<plait_groom>(&memory, allocator);
        auto follows = make_in<plait_follow_map>(&memory, allocator);
        PLAIT_TRY(choose_guides(groom->groom, guides, seed, chosen->groom, follows->map));
        *out = chosen.release();
        *map = follows.release();
        return {};
    });
}

plait_result plait_follow_map_bind(const plait_follow_map* map, const plait_groom* groom,
                                   const plait_roots* roots, plait_view positions,
                                   plait_follow_map** out) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(map, "map"));
        PLAIT_TRY(api::need(groom, "groom"));
        PLAIT_TRY(api::need(out, "out"));
        const plait_allocator allocator = map->own.allocator();
        Memory memory(allocator);
        auto bound = make_in<plait_follow_map>(&memory, allocator);
        api::RootsCopy copy(&bound->own);
        HairFrame frame;
        PLAIT_TRY(api::read_hair(roots, positions, groom->groom.shape.strands,
                                 groom->groom.shape.max_vertices, copy, frame));
        PLAIT_TRY(bind_map(groom->groom, map->map, copy.input(), frame, bound->map, "positions"));
        *out = bound.release();
        return {};
    });
}

plait_result plait_follow_map_read(const plait_follow_map* map, plait_follow_map_field field,
                                   void* dst, size_t* size) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(map, "map"));
        const auto bytes = api::field_bytes(map->map, field);
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

void plait_follow_map_destroy(plait_follow_map* map) {
    api::destroy(map);
}
}
