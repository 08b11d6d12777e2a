// The dynamic state as bytes: header, colliders, the settings of every strand where they have some of
// their own, the grids of colliders that are meshes, then runs of floats. Little-endian, float32
// whatever the backend computes in, so that a snapshot of one device restores on another. The header
// has a checksum of all that follows it there, which finds damage, and what a snapshot says is held
// to its range all the same: bytes that somebody made up with a checksum of their own are refused or
// harmless, too.
#include "base/format.hpp"
#include "base/hash.hpp"
#include "core/models/traits.hpp"
#include "core/params.hpp"
#include "core/sim.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace plait {

// Of a strand, as Settings has it.
struct SavedSettings {
    uint32_t model, substeps, iterations, bdf2;
};

// Of a collider that is a mesh, in the order of their slots; then come the values of its nodes, and
// the clearance of every vertex.
struct SavedMesh {
    float origin[3], edge;
    uint32_t nodes[3];
    float band;
};

struct SnapshotHeader {
    uint32_t magic;
    uint32_t version;
    uint64_t checksum; // of every byte after it
    uint64_t groom;    // its fingerprint
    uint32_t model;
    uint32_t guides;
    uint32_t row;
    uint32_t substeps;
    float step;
    uint32_t colliders; // slots, dead ones included
    double waiting;
    uint64_t steps;
    uint64_t dropped;
    plait_pose heads[4]; // at, target, from, to
    uint32_t own[4];
    uint32_t aimed;
    uint32_t kept;
    uint32_t switched; // 1: strands have settings of their own
    uint32_t pins;     // 1: they are there
    double wind_time;  // Wind::Moving
    double wind_way[3];
    float wind_jump[3];
    uint32_t unused;
};
static_assert(sizeof(SnapshotHeader) == 72 + 112 + 32 + 48);
static_assert(sizeof(Colliders::Slot) == sizeof(float) * (2 + 21 + 28),
              "no padding: slots are saved as bytes");

namespace {

constexpr uint32_t magic = 0x74696c70; // "plit"
constexpr uint32_t version = 6;

// Of a position (m) or a velocity (m/s): a head and a groom may be 1e6 m away each.
constexpr float largest = 4e6f;
constexpr double unit_error = 1e-2; // of a quaternion's square

Error malformed(const std::string& what) {
    return {PLAIT_BAD_DATA, "snapshot: " + what};
}

Status check_pose(const plait_pose& pose, const char* name) {
    const auto checked = checked_pose(pose, name);
    return checked ? Status{} : malformed(checked.error().message);
}

uint64_t checksum_of(std::span<const unsigned char> bytes) {
    constexpr size_t first = offsetof(SnapshotHeader, checksum) + sizeof(uint64_t);
    Hash hash;
    hash.add(bytes.data() + first, bytes.size() - first);
    return hash.value();
}

// What can be told before anything in it is believed.
Status check_whole(const SnapshotHeader& h, std::span<const unsigned char> bytes) {
    if (h.magic != magic)
        return malformed(format("begins with 0x%08x, not 0x%08x", h.magic, magic));
    if (h.version != version)
        return Error{
            PLAIT_UNSUPPORTED,
            format("snapshot: version %u, this library reads version %u", h.version, version)};
    if (const uint64_t sum = checksum_of(bytes); sum != h.checksum)
        return malformed(format("its checksum is 0x%016llx, that of its %zu bytes 0x%016llx: it is "
                                "damaged or cut",
                                static_cast<unsigned long long>(h.checksum), bytes.size(),
                                static_cast<unsigned long long>(sum)));
    return {};
}

Status check_header(const SnapshotHeader& h) {
    if (!(std::abs(h.waiting) <= 2))
        return malformed(format("%g s wait for a step, range is [-2, 2]", h.waiting));
    for (size_t i = 0; i < 4; ++i) {
        PLAIT_TRY(check_pose(h.heads[i], "head"));
        if (h.own[i] > 1)
            return malformed(format("own[%zu] is %u, range is [0, 1]", i, h.own[i]));
    }
    if (!(h.wind_time >= 0 && h.wind_time <= 1e12))
        return malformed(format("wind_time is %g s, range is [0, 1e12]", h.wind_time));
    for (size_t i = 0; i < 3; ++i)
        if (!(std::abs(h.wind_way[i]) <= 1e15 && std::abs(h.wind_jump[i]) <= 1e6f))
            return malformed(format("wind_way[%zu] is %g m, wind_jump[%zu] %g m/s, ranges are "
                                    "[-1e15, 1e15] and [-1e6, 1e6]",
                                    i, h.wind_way[i], i, double(h.wind_jump[i])));
    if (h.unused != 0)
        return malformed(format("unused is %u, not 0", h.unused));
    if (h.aimed > 1 || h.kept > 1 || h.switched > 1 || h.pins > 1)
        return malformed(
            format("aimed is %u, kept is %u, switched is %u, pins is %u, range is [0, 1]", h.aimed,
                   h.kept, h.switched, h.pins));
    return {};
}

// All but kind, friction and poses is as create_mesh() makes it.
Status check_mesh_slot(const Colliders::Slot& slot) {
    plait_collider_mesh_desc desc{};
    desc.cells = 8;
    desc.friction = slot.friction;
    PLAIT_TRY(check_mesh_collider(desc));
    Colliders::Slot bare = slot;
    for (float* vector : {bare.a, bare.b, bare.normal, bare.half_extents})
        std::fill_n(vector, 3, 0.0f);
    bare.radius_a = bare.radius_b = bare.rounding = 0;
    std::copy_n(identity_pose.q, 4, bare.orientation);
    if (std::memcmp(&bare, &slot, sizeof slot) != 0)
        return Error{PLAIT_INVALID_ARGUMENT, "is a mesh, and has a shape besides"};
    return {};
}

Status check_slot(const Colliders::Slot& slot, size_t index) {
    if (slot.alive > 1)
        return malformed(format("collider %zu: alive is %u, range is [0, 1]", index, slot.alive));
    if (!slot.alive) {
        Colliders::Slot gone{};
        gone.generation = slot.generation;
        if (std::memcmp(&gone, &slot, sizeof slot) != 0)
            return malformed(format("collider %zu is gone, but not all of it is zero", index));
        return {};
    }
    const bool mesh = Colliders::is_mesh(slot);
    if (const auto status =
            mesh ? check_mesh_slot(slot) : check_collider(Colliders::shape_of(slot));
        !status)
        return malformed(format("collider %zu: %s", index, status.error().message.c_str()));
    for (const plait_pose* pose : {&slot.at, &slot.target, &slot.from, &slot.to})
        PLAIT_TRY(check_pose(*pose, "collider"));
    return {};
}

// Colliders, as a snapshot holds them from `from` on.
Result<std::pmr::vector<Colliders::Slot>>
saved_slots(const SnapshotHeader& h, const unsigned char* from, std::pmr::memory_resource* memory) {
    std::pmr::vector<Colliders::Slot> slots(h.colliders, memory);
    if (!slots.empty())
        std::memcpy(slots.data(), from, slots.size() * sizeof slots[0]);
    for (size_t i = 0; i < slots.size(); ++i)
        PLAIT_TRY(check_slot(slots[i], i));
    return slots;
}

float float_at(const unsigned char* bytes, size_t index) {
    float value;
    std::memcpy(&value, bytes + sizeof value * index, sizeof value);
    return value;
}

Error outside(const char* name, size_t index, double value, const char* range) {
    return malformed(format("%s[%zu] is %g, range is %s", name, index, value, range));
}

Status check_range(const unsigned char* bytes, size_t index, const char* name) {
    if (const float value = float_at(bytes, index); !(std::abs(value) <= largest))
        return outside(name, index, double(value), "[-4e6, 4e6]");
    return {};
}

Status check_turn(const unsigned char* bytes, size_t first, const char* name, bool blended) {
    double square = 0;
    for (size_t i = first; i < first + 4; ++i)
        square += double(float_at(bytes, i)) * double(float_at(bytes, i));
    if (blended && !(square <= 1 + unit_error))
        return outside(name, first / 4, square, "[0, 1.01] (square of a quaternion)");
    if (!blended && !(std::abs(square - 1) <= unit_error))
        return outside(name, first / 4, square, "1 +- 0.01 (square of a quaternion)");
    return {};
}

// One mesh from `from` on, which it moves on; `vertices`: [guides][V].
Result<MeshColliders::Entry> saved_mesh(uint32_t slot, size_t vertices,
                                        std::span<const unsigned char>& from,
                                        std::pmr::memory_resource* memory) {
    SavedMesh saved;
    if (from.size() < sizeof saved)
        return malformed(format("collider %u: it ends before its mesh", slot));
    std::memcpy(&saved, from.data(), sizeof saved);
    from = from.subspan(sizeof saved);
    uint64_t count = 1;
    for (const uint32_t nodes : saved.nodes) {
        if (nodes < 2 || nodes > 1024)
            return malformed(format("collider %u: %u nodes, range is [2, 1024]", slot, nodes));
        count *= nodes;
    }
    const uint64_t floats = count + vertices;
    if (from.size() / sizeof(float) < floats)
        return malformed(format("collider %u: %llu numbers of a mesh, %zu bytes are left", slot,
                                static_cast<unsigned long long>(floats), from.size()));
    for (size_t i = 0; i < floats; ++i)
        PLAIT_TRY(check_range(from.data(), i, "mesh"));
    for (size_t i = 0; i < 3; ++i)
        if (!(std::abs(saved.origin[i]) <= largest))
            return outside("origin", i, double(saved.origin[i]), "[-4e6, 4e6]");
    for (const float size : {saved.edge, saved.band})
        if (!(size > 0 && size <= largest))
            return outside("mesh edge", slot, double(size), "(0, 4e6]");
    MeshColliders::Entry entry{slot, MeshField(memory), std::pmr::vector<float>(vertices, memory)};
    std::copy_n(saved.origin, 3, entry.field.origin.begin());
    std::copy_n(saved.nodes, 3, entry.field.nodes.begin());
    entry.field.edge = saved.edge;
    entry.field.band = saved.band;
    entry.field.value.resize(count);
    std::memcpy(entry.field.value.data(), from.data(), count * sizeof(float));
    from = from.subspan(count * sizeof(float));
    std::memcpy(entry.clearance.data(), from.data(), vertices * sizeof(float));
    from = from.subspan(vertices * sizeof(float));
    return entry;
}

Result<MeshColliders::Entries> saved_meshes(std::span<const Colliders::Slot> slots, size_t vertices,
                                            std::span<const unsigned char>& from,
                                            std::pmr::memory_resource* memory) {
    MeshColliders::Entries list(memory);
    for (uint32_t i = 0; i < slots.size(); ++i) {
        if (!Colliders::is_mesh(slots[i]))
            continue;
        auto entry = saved_mesh(i, vertices, from, memory);
        if (!entry)
            return entry.error();
        list.push_back(std::move(*entry));
    }
    return list;
}

std::array<bool, 4> owned(const SnapshotHeader& h) {
    return {h.own[0] != 0, h.own[1] != 0, h.own[2] != 0, h.own[3] != 0};
}

} // namespace

// What a snapshot holds, in its order.
std::pmr::vector<Sim::Block> Sim::blocks(const SnapshotHeader& h) {
    const size_t vertices = layout_.guide_vertices();
    std::pmr::vector<Block> list(&context_.memory);
    list.push_back({&state_.position, 4 * vertices, Block::Of::vertices, {}});
    list.push_back({&state_.position_prev, 4 * vertices, Block::Of::histories, {}});
    if (state_.position_prev2)
        list.push_back({&state_.position_prev2, 4 * vertices, Block::Of::histories, {}});
    list.push_back({&state_.pose, 4 * state_.pose.count(), Block::Of::poses, {}});
    std::pmr::vector<LaneBuffer> own(&context_.memory);
    model_->add_dynamic(own);
    for (const LaneBuffer& lanes : own)
        list.push_back({lanes.buffer,
                        size_t{lanes.layout.strands} * lanes.layout.row * lanes.components,
                        lanes.components == 4 ? Block::Of::turns : Block::Of::motion, lanes});
    if (h.kept) // the step before the last
        list.push_back({&display_.kept(), 4 * vertices, Block::Of::histories, {}});
    const auto own_poses = owned(h); // of roots
    for (size_t i = 0; i < own_poses.size(); ++i)
        if (own_poses[i])
            list.push_back(
                {&roots_.all_poses()[i]->poses, size_t{8} * layout_.guides, Block::Of::poses, {}});
    if (h.pins)
        for (const Buffer* pins : {&state_.pin, &state_.pin_at, &state_.pin_to})
            list.push_back({pins, 4 * vertices, Block::Of::histories, {}});
    return list;
}

// The blocks of a snapshot whose strands may have other settings than the sim's have now: those of
// the lanes come part by part; first those that every model has, x, v, q and q before, then BDF2's x
// and v where the part steps by it.
std::pmr::vector<Sim::Block> Sim::saved_blocks(const SnapshotHeader& h,
                                               std::span<const Settings> strands) {
    auto list = blocks(h);
    if (std::ranges::equal(strands, settings()))
        return list;
    const auto is_lane = [](const Block& block) { return block.lanes.buffer != nullptr; };
    const auto first = std::ranges::find_if(list, is_lane);
    const auto last = std::find_if_not(first, list.end(), is_lane);
    std::pmr::vector<Block> saved(list.begin(), first, &context_.memory);
    std::pmr::vector<PartShape> parts(&context_.memory);
    model_->list_parts(strands, parts);
    for (const PartShape& part : parts) {
        const std::ptrdiff_t own = part.settings.bdf2_of(desc_.params) ? 6 : 4;
        for (std::ptrdiff_t i = 0; i < own; ++i) {
            saved.push_back(first[i % 4]);
            saved.back().floats = size_t{part.strands} * part.row * saved.back().lanes.components;
        }
    }
    saved.insert(saved.end(), last, list.end());
    return saved;
}

SnapshotHeader Sim::snapshot_header() {
    SnapshotHeader h{};
    h.magic = magic;
    h.version = version;
    h.groom = groom_;
    h.model = static_cast<uint32_t>(desc_.model);
    h.guides = layout_.guides;
    h.row = layout_.row;
    h.substeps = desc_.substeps;
    h.step = desc_.step;
    h.colliders = static_cast<uint32_t>(colliders_.slots().size());
    h.waiting = clock_.waiting;
    h.steps = clock_.steps;
    h.dropped = clock_.dropped;
    h.aimed = roots_.aimed;
    h.kept = display_.interpolates();
    h.pins = state_.pin ? 1 : 0;
    h.wind_time = wind_.moving.time;
    std::ranges::copy(wind_.moving.way, h.wind_way);
    std::ranges::copy(wind_.moving.jump, h.wind_jump);
    const auto strands = settings();
    h.switched = std::ranges::any_of(
        strands, [&](const Settings& s) { return s != own_settings(desc_.model); });
    const auto all = roots_.all_poses();
    for (size_t i = 0; i < all.size(); ++i) {
        const bool meant = all[i] != all[1] || roots_.aimed; // no target: nothing to keep
        h.heads[i] = meant ? all[i]->head : identity_pose;
        h.own[i] = meant && all[i]->own;
    }
    return h;
}

// Of all that stands before the meshes and the blocks.
size_t Sim::snapshot_bytes(const SnapshotHeader& h) const {
    const size_t bytes = sizeof h + h.colliders * sizeof(Colliders::Slot);
    return h.switched ? bytes + layout_.guides * sizeof(SavedSettings) : bytes;
}

size_t Sim::snapshot_size() {
    const SnapshotHeader h = snapshot_header();
    size_t bytes = snapshot_bytes(h);
    for (const MeshColliders::Entry& mesh : meshes_.entries())
        bytes += sizeof(SavedMesh) + (mesh.field.count() + mesh.clearance.size()) * sizeof(float);
    for (const Block& block : blocks(h))
        bytes += block.floats * sizeof(float);
    return bytes;
}

Status Sim::save(std::span<unsigned char> dst) {
    const SnapshotHeader h = snapshot_header();
    unsigned char* out = dst.data();
    const auto put = [&](const void* data, size_t size) {
        if (size > 0)
            std::memcpy(out, data, size);
        out += size;
    };
    put(&h, sizeof h);
    put(colliders_.slots().data(), colliders_.slots().size_bytes());
    if (h.switched)
        for (const Settings& s : settings()) {
            const SavedSettings saved = {static_cast<uint32_t>(s.model), s.substeps, s.iterations,
                                         s.bdf2};
            put(&saved, sizeof saved);
        }
    for (const auto& [slot, field, clearance] : meshes_.entries()) {
        SavedMesh saved{{}, field.edge, {}, field.band};
        std::ranges::copy(field.origin, saved.origin);
        std::ranges::copy(field.nodes, saved.nodes);
        put(&saved, sizeof saved);
        put(field.value.data(), field.count() * sizeof(float));
        put(clearance.data(), clearance.size() * sizeof(float));
    }
    for (const Block& block : blocks(h)) {
        PLAIT_TRY(save_block(block, out));
        out += block.floats * sizeof(float);
    }
    const uint64_t checksum = checksum_of(dst);
    std::memcpy(dst.data() + offsetof(SnapshotHeader, checksum), &checksum, sizeof checksum);
    return {};
}

// The settings of every strand, as a snapshot says from `from` on; the sim's own where it says
// nothing.
Result<SettingsList> Sim::saved_settings(const SnapshotHeader& h, const unsigned char* from) const {
    SettingsList list(layout_.guides, own_settings(desc_.model), &context_.memory);
    if (!h.switched)
        return list;
    for (size_t i = 0; i < list.size(); ++i) {
        SavedSettings saved;
        std::memcpy(&saved, from + i * sizeof saved, sizeof saved);
        plait_strand_settings settings = default_strand_settings();
        std::memcpy(&settings.model, &saved.model, sizeof saved.model); // it may be any number
        settings.substeps = saved.substeps;
        settings.iterations = saved.iterations;
        settings.bdf2 = saved.bdf2;
        if (const auto status = check_strand_settings(settings); !status)
            return malformed(format("strand %zu: %s", i, status.error().message.c_str()));
        list[i] = make_settings(settings, desc_.substeps);
    }
    return list;
}

// A snapshot is of the same groom, model and step; parameters and the rest may differ.
Status Sim::check_fits(const SnapshotHeader& h) const {
    if (h.guides != layout_.guides || h.row != layout_.row)
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("the snapshot is of %u guides of %u vertices, the sim has %u of %u",
                            h.guides, h.row, layout_.guides, layout_.row)};
    if (h.groom != groom_)
        return Error{
            PLAIT_INVALID_ARGUMENT,
            format("the snapshot is of another groom: its fingerprint is 0x%016llx, that of "
                   "the sim's 0x%016llx",
                   static_cast<unsigned long long>(h.groom),
                   static_cast<unsigned long long>(groom_))};
    if (h.model != static_cast<uint32_t>(desc_.model))
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("the snapshot is of model %u, the sim's is %d", h.model, desc_.model)};
    if (h.switched && desc_.model == PLAIT_MODEL_TRESSFX)
        return malformed("switched is 1, strands of model 0 do not switch");
    if (h.step != desc_.step || h.substeps != desc_.substeps)
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("the snapshot has steps of %g s in %u substeps, the sim %g s in %u",
                            double(h.step), h.substeps, double(desc_.step), desc_.substeps)};
    return {};
}

// What a kernel can take: positions and velocities at hand, turns that are turns, masses as they
// are.
Status Sim::check_block(const Block& block, const unsigned char* from) const {
    const char* name = block.buffer->name();
    const bool poses = block.of == Block::Of::poses, turns = block.of == Block::Of::turns;
    for (size_t i = 0; i < block.floats; i += 4) {
        if (turns || (poses && i % 8 == 0)) {
            PLAIT_TRY(check_turn(from, i, name, block.lanes.blended));
            continue;
        }
        for (size_t k = i; k < std::min(i + 4, block.floats); ++k)
            PLAIT_TRY(check_range(from, k, name));
        const auto vertex = static_cast<uint32_t>(i / 4 % layout_.row);
        const float mass = vertex < model_->pinned_vertices() ? 0.0f : 1.0f;
        if (block.of == Block::Of::vertices && float_at(from, i + 3) != mass)
            return outside(name, i + 3, double(float_at(from, i + 3)),
                           "the vertex' inverse mass, 0 at what the root holds, else 1");
    }
    return {};
}

// Leaves the buffers of roots' own poses to be filled from the snapshot.
Status Sim::restore_roots(const SnapshotHeader& h) {
    const auto own = owned(h);
    if (std::find(own.begin(), own.end(), true) != own.end())
        PLAIT_TRY(roots_.make_buffers(device()));
    const auto all = roots_.all_poses();
    for (size_t i = 0; i < all.size(); ++i) {
        all[i]->head = h.heads[i];
        all[i]->own = own[i];
    }
    roots_.aimed = h.aimed != 0;
    return roots_.clear_buffers(device());
}

// Lanes are saved as [strand][V][components], whatever the tile of this device is.
Status Sim::save_block(const Block& block, unsigned char* out) {
    if (!block.lanes.buffer)
        return device().read(*block.buffer, 0,
                             block.floats * sizeof(float) / block.buffer->element_size(), out);
    std::pmr::vector<float> tiled(block.buffer->count(), &context_.memory);
    PLAIT_TRY(device().read(*block.buffer, tiled.data()));
    for_each_lane_element(block.lanes.layout, block.lanes.components,
                          [&](size_t lane, size_t plain) {
                              std::memcpy(out + plain * sizeof(float), &tiled[lane], sizeof(float));
                          });
    return {};
}

Status Sim::restore_block(const Block& block, const unsigned char* from) {
    if (!block.lanes.buffer)
        return device().write(*block.buffer, 0,
                              block.floats * sizeof(float) / block.buffer->element_size(), from);
    std::pmr::vector<float> tiled(block.buffer->count(), &context_.memory);
    PLAIT_TRY(device().read(*block.buffer, tiled.data()));
    for_each_lane_element(
        block.lanes.layout, block.lanes.components, [&](size_t lane, size_t plain) {
            std::memcpy(&tiled[lane], from + plain * sizeof(float), sizeof(float));
        });
    return device().write(*block.buffer, tiled.data());
}

Status Sim::restore_blocks(std::span<const Block> list, const unsigned char* from) {
    for (const Block& block : list) {
        if (*block.buffer) // this sim may do without
            PLAIT_TRY(restore_block(block, from));
        from += block.floats * sizeof(float);
    }
    return {};
}

// Everything is checked before anything changes.
Status Sim::restore(std::span<const unsigned char> src) {
    SnapshotHeader h;
    if (src.size() < sizeof h)
        return malformed(format("%zu bytes, the header takes %zu", src.size(), sizeof h));
    std::memcpy(&h, src.data(), sizeof h);
    PLAIT_TRY(check_whole(h, src));
    PLAIT_TRY(check_header(h));
    PLAIT_TRY(check_fits(h));
    if (src.size() < snapshot_bytes(h))
        return malformed(
            format("%zu bytes, its header says %zu and more", src.size(), snapshot_bytes(h)));
    const unsigned char* from = src.data() + sizeof h;
    const auto slots = saved_slots(h, from, &context_.memory);
    if (!slots)
        return slots.error();
    from += slots->size() * sizeof(Colliders::Slot);
    const auto strands = saved_settings(h, from);
    if (!strands)
        return strands.error();
    from += h.switched ? layout_.guides * sizeof(SavedSettings) : 0;
    auto left = src.subspan(static_cast<size_t>(from - src.data()));
    auto meshes = saved_meshes(*slots, layout_.guide_vertices(), left, &context_.memory);
    if (!meshes)
        return meshes.error();
    if (!meshes->empty() && desc_.model == PLAIT_MODEL_TRESSFX)
        return malformed("colliders are meshes, which strands of model 0 do not meet");
    from = left.data();
    const auto saved = saved_blocks(h, *strands);
    auto bytes = static_cast<size_t>(from - src.data());
    for (const Block& block : saved)
        bytes += block.floats * sizeof(float);
    if (src.size() != bytes)
        return malformed(format("%zu bytes, its header says %zu", src.size(), bytes));
    const unsigned char* at = from;
    for (const Block& block : saved) {
        PLAIT_TRY(check_block(block, at));
        at += block.floats * sizeof(float);
    }
    if (*strands != settings())
        PLAIT_TRY(set_settings(*strands));
    const auto list = blocks(h);
    schedule_.clear();
    PLAIT_TRY(take_meshes(std::move(*meshes)));
    PLAIT_TRY(colliders_.assign(device(), *slots));
    PLAIT_TRY(restore_roots(h));
    if (!h.pins)
        PLAIT_TRY(clear_pins(device(), layout_, state_, &context_.memory));
    PLAIT_TRY(restore_blocks(list, from));
    clock_.waiting = h.waiting;
    clock_.steps = h.steps;
    clock_.dropped = h.dropped;
    if (wind_.blows()) { // this sim may do without
        wind_.moving.time = h.wind_time;
        std::ranges::copy(h.wind_way, wind_.moving.way.begin());
        std::ranges::copy(h.wind_jump, wind_.moving.jump.begin());
    }
    if (!h.kept)
        display_.append_step_before(schedule_, layout_, state_);
    append_shown();
    return submit();
}

Result<uint64_t> Sim::hash() {
    std::pmr::vector<unsigned char> bytes(snapshot_size(), &context_.memory);
    PLAIT_TRY(save(bytes));
    Hash hash;
    hash.add(bytes.data(), bytes.size());
    return hash.value();
}

} // namespace plait
