#include "core/snapshot/snapshot_format.hpp"

#include "base/format.hpp"
#include "base/hash.hpp"
#include "core/base/ranges.hpp"
#include "core/params/params.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace plait::snapshots {
namespace {

constexpr double unit_error = 1e-2; // of a quaternion's square

} // namespace

Error malformed(const std::string& what) {
    return {PLAIT_BAD_DATA, "snapshot: " + what};
}

namespace {

struct Kind {
    const char* name;
    const char tag[5];
    uint32_t version;
    bool always; // part of every snapshot
    size_t head; // bytes, of what it begins with
};
// In the order of BlockKind.
constexpr Kind kinds[block_kinds] = {
    {"sim", "sim ", 2, true, sizeof(SavedSim)},
    {"roots", "root", 3, true, sizeof(SavedRoots)},
    {"frame", "fram", 3, true, sizeof(Frame::State)},
    {"bodies", "body", 2, true, 0},
    {"settings", "sett", 1, false, 0},
    {"hair", "hair", 1, true, 0},
    {"output", "outp", 1, false, 0},
    {"pins", "pins", 1, false, 0},
    {"wind", "wind", 1, false, sizeof(SavedWind)},
    {"wetness", "wetn", 1, false, sizeof(SavedWetness)},
    {"volume", "volu", 1, false, sizeof(SavedVolume)},
    {"contact", "cont", 1, false, 0},
    {"levels", "levl", 2, false, sizeof(SimLevels::Kept)},
};

uint32_t tag_of(const Kind& kind) {
    uint32_t tag;
    std::memcpy(&tag, kind.tag, sizeof tag);
    return tag;
}

// block_kinds where it is unknown.
size_t find_kind(uint32_t tag) {
    return static_cast<size_t>(
        std::ranges::find(kinds, tag, [](const Kind& kind) { return tag_of(kind); }) - kinds);
}

Error of_another_version(const std::string& what) {
    return {PLAIT_UNSUPPORTED, "snapshot: " + what};
}

Status check_head(const SnapshotHead& head, std::span<const unsigned char> bytes) {
    if (head.magic != magic)
        return malformed(format("begins with 0x%08x, not 0x%08x", head.magic, magic));
    if (head.version != version)
        return of_another_version(
            format("version %u, this library reads version %u", head.version, version));
    if (const uint64_t sum = checksum_of(bytes); sum != head.checksum)
        return malformed(format("its checksum is 0x%016llx, that of its %zu bytes 0x%016llx: it is "
                                "damaged or cut",
                                static_cast<unsigned long long>(head.checksum), bytes.size(),
                                static_cast<unsigned long long>(sum)));
    return {};
}

Status check_block(const BlockHead& block, size_t kind, size_t first, size_t left) {
    if (kind == block_kinds)
        return of_another_version(
            format("a block has the tag 0x%08x, which this library does not know", block.tag));
    const Kind& known = kinds[kind];
    if (block.version != known.version)
        return of_another_version(format("the block %s has version %u, this library reads version "
                                         "%u",
                                         known.name, block.version, known.version));
    if (kind < first)
        return malformed(format("the block %s is not in its place", known.name));
    if (block.bytes > left || block.bytes < known.head)
        return malformed(format("the block %s has %llu bytes, range is [%zu, %zu]", known.name,
                                static_cast<unsigned long long>(block.bytes), known.head, left));
    return {};
}

} // namespace

const char* name_of(BlockKind kind) {
    return kinds[static_cast<size_t>(kind)].name;
}

SnapshotHead head() {
    return {magic, version, 0};
}

BlockHead head_of(BlockKind kind, uint64_t bytes) {
    const Kind& known = kinds[static_cast<size_t>(kind)];
    return {tag_of(known), known.version, bytes};
}

uint64_t checksum_of(std::span<const unsigned char> bytes) {
    Hash hash;
    hash.add(bytes.data() + sizeof(SnapshotHead), bytes.size() - sizeof(SnapshotHead));
    return hash.value();
}

Result<BlockBytes> split(std::span<const unsigned char> bytes) {
    SnapshotHead begin;
    auto left = bytes;
    if (!take(left, begin))
        return malformed(format("%zu bytes, the header takes %zu", bytes.size(), sizeof begin));
    PLAIT_TRY(check_head(begin, bytes));
    BlockBytes blocks;
    size_t first = 0;
    while (!left.empty()) {
        BlockHead block;
        if (!take(left, block))
            return malformed(format("%zu bytes are left, a block takes %zu and more", left.size(),
                                    sizeof block));
        const size_t kind = find_kind(block.tag);
        PLAIT_TRY(check_block(block, kind, first, left.size()));
        blocks[kind] = left.first(block.bytes);
        left = left.subspan(block.bytes);
        first = kind + 1;
    }
    for (size_t i = 0; i < block_kinds; ++i)
        if (kinds[i].always && !blocks[i].data())
            return malformed(format("it has no block %s", kinds[i].name));
    return blocks;
}

static Status check_frame(const Frame::State& frame, float scale) {
    for (const plait_pose* pose :
         {&frame.at, &frame.target, &frame.from, &frame.to, &frame.unfelt, &frame.along})
        PLAIT_TRY(check_pose(*pose, "frame", scale));
    if (frame.known > 3 || frame.air > PLAIT_FRAME_AIR_WORLD)
        return malformed(
            format("frame.known is %u, range is [0, 3], frame.air is %u, range is [0, 2]",
                   frame.known, frame.air));
    for (const float share : {frame.felt_translation, frame.felt_rotation})
        if (!(share >= 0 && share <= 1))
            return malformed(format("the frame is felt by %g, range is [0, 1]", double(share)));
    return {};
}

static Status check_roots(const SavedRoots& r, float scale) {
    for (size_t i = 0; i < std::size(r.heads); ++i) {
        PLAIT_TRY(check_pose(r.heads[i], "head", scale));
        if (r.own[i] > 1)
            return malformed(format("own[%zu] is %u, range is [0, 1]", i, r.own[i]));
    }
    const HeadMotion::State& m = r.motion;
    for (const plait_pose& pose : {m.put_from, m.put_to})
        PLAIT_TRY(check_pose(pose, "put", scale));
    if (r.aimed > 1 || m.told > 1 || m.waited > 1 || m.first_aim > 1)
        return malformed(format("aimed is %u, told is %u, waited is %u, first_aim is %u, range is "
                                "[0, 1]",
                                r.aimed, m.told, m.waited, m.first_aim));
    if (r.bends > 2 || m.known > 3 || m.begun > 2)
        return malformed(format("bends is %u, known is %u, begun is %u, ranges are [0, 2], [0, 3] "
                                "and [0, 2]",
                                r.bends, m.known, m.begun));
    return {};
}

static Status check_wind(const SavedWind& wind) {
    if (!(wind.time >= 0 && wind.time <= 1e12))
        return malformed(format("wind.time is %g s, range is [0, 1e12]", wind.time));
    for (size_t i = 0; i < 3; ++i)
        if (!(std::abs(wind.way[i]) <= 1e15 && std::abs(wind.jump[i]) <= 1e6f))
            return malformed(format("wind.way[%zu] is %g m, wind.jump[%zu] %g m/s, ranges are "
                                    "[-1e15, 1e15] and [-1e6, 1e6]",
                                    i, wind.way[i], i, double(wind.jump[i])));
    if (wind.zero != 0)
        return malformed(format("wind.zero is %u, and not 0", wind.zero));
    return {};
}

Result<Saved> take_saved(BlockBytes& blocks) {
    Saved saved{};
    const auto of = [&](BlockKind kind) -> std::span<const unsigned char>& {
        return blocks[static_cast<size_t>(kind)];
    };
    for (size_t i = 0; i < block_kinds; ++i)
        saved.has[i] = blocks[i].data() != nullptr;
    take(of(BlockKind::sim), saved.sim); // split() has looked at their sizes
    take(of(BlockKind::roots), saved.roots);
    take(of(BlockKind::frame), saved.frame);
    take(of(BlockKind::wind), saved.wind);
    take(of(BlockKind::wetness), saved.wetness);
    take(of(BlockKind::volume), saved.volume);
    take(of(BlockKind::levels), saved.levels);
    const SavedSim& sim = saved.sim;
    if (const auto status = plait::check_range("scale", double(sim.scale), 1e-3f, 1e3); !status)
        return malformed(status.error().message);
    if (!(std::abs(sim.waiting) <= 2))
        return malformed(format("%g s wait for a step, range is [-2, 2]", sim.waiting));
    if ((sim.bdf2 > 1 && sim.bdf2 != PLAIT_BDF2_OF_MODEL) || sim.strand_contact > 1)
        return malformed(
            format("bdf2 is %u, range is [0, 1] or the model's own, strand_contact is %u, "
                   "range is [0, 1]",
                   sim.bdf2, sim.strand_contact));
    PLAIT_TRY(check_roots(saved.roots, sim.scale));
    PLAIT_TRY(check_frame(saved.frame, sim.scale));
    PLAIT_TRY(snapshots::check_wind(saved.wind));
    if (!(saved.wetness.dried >= 0 && saved.wetness.dried <= 1e12))
        return malformed(format("dried is %g, range is [0, 1e12]", saved.wetness.dried));
    if (saved.is(BlockKind::volume) && (saved.volume.nodes < 1 || saved.volume.nodes > 64))
        return malformed(format("volume.nodes is %u, range is [1, 64]", saved.volume.nodes));
    if (!(saved.levels.blend >= 0 && saved.levels.blend <= 5 && saved.levels.since >= -1 &&
          saved.levels.since <= 1e12))
        return malformed(
            format("levels blend for %g s since %g s, ranges are [0, 5] and [-1, 1e12]",
                   double(saved.levels.blend), saved.levels.since));
    if (!(saved.levels.next_blend >= 0 && saved.levels.next_blend <= 5 && saved.levels.due <= 1))
        return malformed(
            format("levels are to blend for %g s, due is %u, ranges are [0, 5] and [0, 1]",
                   double(saved.levels.next_blend), saved.levels.due));
    return saved;
}

Status check_pose(plait_pose pose, const char* name, float scale) {
    rescale(pose, std::min(1.0, double(scale)));
    const auto checked = checked_pose(pose, name);
    return checked ? Status{} : malformed(checked.error().message);
}

float float_at(const unsigned char* bytes, size_t index) {
    float value;
    std::memcpy(&value, bytes + sizeof value * index, sizeof value);
    return value;
}

Error outside(const char* name, size_t index, double value, const char* range) {
    return malformed(format("%s[%zu] is %g, range is %s", name, index, value, range));
}

Status check_range(const unsigned char* bytes, size_t index, const char* name, float scale) {
    if (const float value = float_at(bytes, index);
        !(std::abs(value) * std::min(1.0f, scale) <= largest))
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

} // namespace plait::snapshots
