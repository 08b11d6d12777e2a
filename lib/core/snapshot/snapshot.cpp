// The dynamic state as bytes: header, colliders, the settings of every strand where they have some of
// their own, the faces of hulls, the grids of colliders that are meshes, then runs of floats.
// Little-endian, float32 whatever the backend computes in, so that a snapshot of one device restores on
// another. The header has a checksum of all that follows it there, which finds damage, and what a
// snapshot says is held to its range all the same: bytes that somebody made up with a checksum of their
// own are refused or harmless, too.
#include "core/snapshot/snapshot_format.hpp"

#include "base/format.hpp"
#include "base/hash.hpp"
#include "core/params/params.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace plait {

using namespace snapshots;

namespace {

constexpr float most_potential = 1e30f;

std::array<bool, 5> owned(const SnapshotHeader& h) {
    return {h.own[0] != 0, h.own[1] != 0, h.own[2] != 0, h.own[3] != 0, h.own[4] != 0};
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
    if (h.motion == static_cast<uint32_t>(Motion::as_before) ||
        h.motion == static_cast<uint32_t>(Motion::unknown))
        for (const Buffer* poses : {&pose_was_, &pose_before_.front()})
            list.push_back({poses, size_t{8} * layout_.guides, Block::Of::poses, {}});
    const auto own_poses = owned(h); // of roots
    for (size_t i = 0; i < own_poses.size(); ++i)
        if (own_poses[i])
            list.push_back(
                {&roots_.all_poses()[i]->poses, size_t{8} * layout_.guides, Block::Of::poses, {}});
    if (h.pins)
        for (const Buffer* pins : {&state_.pin, &state_.pin_at, &state_.pin_to})
            list.push_back({pins, 4 * vertices, Block::Of::histories, {}});
    if (h.wet)
        for (const Buffer* wetness : {&state_.wetness_given, &state_.wetness_held})
            list.push_back({wetness, layout_.guides, Block::Of::wetness, {}});
    if (h.volume > 0) {
        std::pmr::vector<LaneBuffer> pushes(&context_.memory);
        model_->add_pressure(pushes);
        for (const LaneBuffer& lanes : pushes)
            list.push_back({lanes.buffer, size_t{lanes.layout.strands} * lanes.layout.row * 3,
                            Block::Of::pushes, lanes});
        list.push_back({&volume_.potential(),
                        size_t{h.volume} * h.volume * h.volume * 2,
                        Block::Of::pressures,
                        {}});
    }
    return list;
}

// The blocks of a snapshot whose strands may have other settings than the sim's have now: those of
// the lanes come part by part; first those that are always there, x, v, q and q before, then BDF2's x
// and v where the part steps by it.
std::pmr::vector<Sim::Block> Sim::saved_blocks(const SnapshotHeader& h,
                                               std::span<const Settings> strands) {
    auto list = blocks(h);
    if (std::ranges::equal(strands, settings()))
        return list;
    const auto is_lane = [](const Block& block) {
        return block.lanes.buffer != nullptr && block.of != Block::Of::pushes;
    };
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
    h.wet = state_.wetness ? 1 : 0;
    h.dried = state_.wetness ? wetness_.dried() : 0;
    h.volume = volume_.carries ? desc_.params.grid_edge_count : 0;
    h.bends = roots_.samples();
    h.motion = static_cast<uint32_t>(motion_);
    h.told = told_;
    h.waited = waited_;
    h.first_aim = first_aim_;
    h.frame = frame_.state();
    h.placed[0] = placed_from_;
    h.placed[1] = placed_to_;
    h.scale = scale_;
    const auto strands = settings();
    h.switched =
        std::ranges::any_of(strands, [&](const Settings& s) { return s != own_settings(); });
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
    for (size_t i = 0; i < colliders_.slots().size(); ++i)
        if (Colliders::is_hull(colliders_.slots()[i]))
            bytes += sizeof(uint32_t) + colliders_.faces()[i].size() * sizeof(HullFace);
    for (const MeshColliders::Entry& mesh : meshes_.entries())
        bytes += sizeof(SavedMesh) + (mesh.field.count() + mesh.clearance.size()) * sizeof(float);
    for (const BendingMeshes::Entry& mesh : bending_.entries())
        bytes += sizeof(SavedBendingMesh) +
                 mesh.surface.positions.size() * sizeof(MeshPoint) * (mesh.posed ? 5 : 1) +
                 mesh.surface.triangles.size() * sizeof(Triangle) +
                 mesh.clearance.size() * sizeof(float) * (mesh.two_sided ? 5 : 1);
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
            const SavedSettings saved = {s.substeps, s.iterations, s.bdf2};
            put(&saved, sizeof saved);
        }
    for (size_t i = 0; i < colliders_.slots().size(); ++i) {
        if (!Colliders::is_hull(colliders_.slots()[i]))
            continue;
        const Colliders::Faces& faces = colliders_.faces()[i];
        const auto count = static_cast<uint32_t>(faces.size());
        put(&count, sizeof count);
        put(faces.data(), faces.size() * sizeof(HullFace));
    }
    for (const auto& [slot, field, clearance] : meshes_.entries()) {
        SavedMesh saved{{}, field.edge, {}, field.band};
        std::ranges::copy(field.origin, saved.origin);
        std::ranges::copy(field.nodes, saved.nodes);
        put(&saved, sizeof saved);
        put(field.value.data(), field.count() * sizeof(float));
        put(clearance.data(), clearance.size() * sizeof(float));
    }
    const auto put_list = [&](const auto& list) { put(list.data(), list.size() * sizeof list[0]); };
    for (size_t m = 0; m < bending_.entries().size(); ++m) {
        const BendingMeshes::Entry& mesh = bending_.entries()[m];
        const SavedBendingMesh saved = {static_cast<uint32_t>(mesh.surface.positions.size()),
                                        static_cast<uint32_t>(mesh.surface.triangles.size()),
                                        mesh.two_sided ? 1u : 0u, mesh.posed ? 1u : 0u};
        put(&saved, sizeof saved);
        put_list(mesh.surface.positions);
        if (mesh.posed) {
            const auto places = bending_.read(device(), m);
            if (!places)
                return places.error();
            for (const auto* list : {&places->at, &places->target, &places->from, &places->to})
                put_list(*list);
        }
        put_list(mesh.surface.triangles);
        put_list(mesh.clearance);
        const auto sides = bending_.read_sides(device(), m);
        if (!sides)
            return sides.error();
        put(sides->data(), sides->size() * sizeof(float));
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
    SettingsList list(layout_.guides, own_settings(), &context_.memory);
    if (!h.switched)
        return list;
    for (size_t i = 0; i < list.size(); ++i) {
        SavedSettings saved;
        std::memcpy(&saved, from + i * sizeof saved, sizeof saved);
        plait_strand_settings settings = default_strand_settings();
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
        return malformed("switched is 1, strands of model 0 have no settings");
    if (h.step != desc_.step || h.substeps != desc_.substeps)
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("the snapshot has steps of %g s in %u substeps, the sim %g s in %u",
                            double(h.step), h.substeps, double(desc_.step), desc_.substeps)};
    return {};
}

// What a kernel can take: positions and velocities at hand, turns that are turns, masses as they
// are.
Status Sim::check_block(const Block& block, const unsigned char* from, float scale) const {
    const char* name = block.buffer->name();
    const bool poses = block.of == Block::Of::poses, turns = block.of == Block::Of::turns;
    if (block.of == Block::Of::pressures) {
        for (size_t i = 0; i < block.floats; ++i)
            if (const float value = float_at(from, i); !(std::abs(value) <= most_potential))
                return outside("volume_potential", i, double(value), "[-1e30, 1e30]");
        return {};
    }
    if (block.of == Block::Of::wetness) {
        for (size_t i = 0; i < block.floats; ++i)
            if (const float value = float_at(from, i); !(value >= 0 && value <= 1))
                return outside("wetness", i, double(value), "[0, 1]");
        return {};
    }
    for (size_t i = 0; i < block.floats; i += 4) {
        if (turns || (poses && i % 8 == 0)) {
            PLAIT_TRY(check_turn(from, i, name, block.lanes.blended));
            continue;
        }
        for (size_t k = i; k < std::min(i + 4, block.floats); ++k)
            PLAIT_TRY(check_range(from, k, name, scale));
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
        all[i]->given = 0;
    }
    roots_.aimed = h.aimed != 0;
    roots_.restore_samples(h.bends);
    motion_ = static_cast<Motion>(h.motion);
    told_ = h.told != 0;
    waited_ = h.waited != 0;
    first_aim_ = h.first_aim != 0;
    begun_ = true;
    frame_.restore(h.frame);
    placed_from_ = h.placed[0];
    placed_to_ = h.placed[1];
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
        const bool fits = block.of != Block::Of::pressures || block.buffer->count() == block.floats;
        if (*block.buffer && fits) // this sim may do without
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
    auto faces = saved_faces(*slots, left, &context_.memory);
    if (!faces)
        return faces.error();
    auto meshes = saved_meshes(*slots, layout_.guide_vertices(), left, &context_.memory);
    if (!meshes)
        return meshes.error();
    auto bending = saved_bending(*slots, layout_.guide_vertices(), left, &context_.memory);
    if (!bending)
        return bending.error();
    if ((!meshes->empty() || !bending->empty()) && desc_.model == PLAIT_MODEL_TRESSFX)
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
        PLAIT_TRY(check_block(block, at, h.scale));
        at += block.floats * sizeof(float);
    }
    if (*strands != settings())
        PLAIT_TRY(set_settings(*strands));
    if (!h.wet)
        close_wetness();
    else if (!state_.wetness)
        PLAIT_TRY(open_wetness());
    PLAIT_TRY(open_scale(h.scale));
    schedule_.clear();
    if (h.kept && desc_.interpolate_output == 2 && !display_.interpolates()) {
        PLAIT_TRY(display_.interpolate(device(), schedule_, layout_, state_));
        PLAIT_TRY(submit());
    }
    const auto list = blocks(h);
    PLAIT_TRY(take_meshes(std::move(*meshes), std::move(*bending)));
    PLAIT_TRY(colliders_.assign(device(), *slots, std::move(*faces), h.scale));
    scale_ = display_.scale = h.scale;
    bending_.rescale(h.scale);
    PLAIT_TRY(restore_roots(h));
    if (!h.pins)
        PLAIT_TRY(clear_pins(device(), layout_, state_, &context_.memory));
    PLAIT_TRY(restore_blocks(list, from));
    if (h.wet)
        PLAIT_TRY(wetness_.resume(device(), state_, h.dried, &context_.memory));
    clock_.waiting = h.waiting;
    clock_.steps = h.steps;
    clock_.dropped = h.dropped;
    if (wind_.blows()) { // this sim may do without
        wind_.moving.time = h.wind_time;
        std::ranges::copy(h.wind_way, wind_.moving.way.begin());
        std::ranges::copy(h.wind_jump, wind_.moving.jump.begin());
    }
    volume_.carries = volume_ && h.volume == desc_.params.grid_edge_count;
    append_motion_of_substeps(pose_before_[0], {substeps_.data(), 1});
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
