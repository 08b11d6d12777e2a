// The dynamic state as bytes: blocks of the sim and of each feature, scalars first, then runs of floats.
// Little-endian, float32 whatever the backend computes in, so that a snapshot of one device restores on
// another. A checksum covers all, which finds damage, and what a snapshot says is held to its range all
// the same: bytes that somebody made up with a checksum of their own are refused or harmless, too.
#include "core/snapshot/snapshot_writer.hpp"

#include "base/hash.hpp"

#include <algorithm>
#include <cstddef>

namespace plait {

using namespace snapshots;

// What a snapshot holds of buffers; runs of one block lie one after another.
std::pmr::vector<Sim::Run> Sim::list_runs(const Saved& now) {
    const size_t vertices = layout_.guide_vertices();
    std::pmr::vector<Run> list(&context_.memory);
    const auto add = [&](BlockKind kind, const Buffer& buffer, size_t floats, Run::Of of,
                         const LaneBuffer& lanes = {}) {
        list.push_back({kind, &buffer, floats, of, lanes});
    };
    const auto all = roots_.all_poses();
    for (size_t i = 0; i < all.size(); ++i)
        if (now.roots.own[i])
            add(BlockKind::roots, all[i]->poses, size_t{8} * layout_.guides, Run::Of::poses);
    if (HeadMotion motion; motion.restore(now.roots.motion), !motion.is_on_its_way())
        for (const Buffer* poses : {&pose_was_, &pose_before_.front()})
            add(BlockKind::roots, *poses, size_t{8} * layout_.guides, Run::Of::poses);
    add(BlockKind::hair, state_.position, 4 * vertices, Run::Of::vertices);
    add(BlockKind::hair, state_.position_prev, 4 * vertices, Run::Of::histories);
    if (state_.position_prev2)
        add(BlockKind::hair, state_.position_prev2, 4 * vertices, Run::Of::histories);
    add(BlockKind::hair, state_.pose, 4 * state_.pose.count(), Run::Of::poses);
    std::pmr::vector<LaneBuffer> own(&context_.memory);
    model_->add_dynamic(own);
    for (const LaneBuffer& lanes : own)
        add(BlockKind::hair, *lanes.buffer,
            size_t{lanes.layout.strands} * lanes.layout.row * lanes.components,
            lanes.components == 4 ? Run::Of::turns : Run::Of::motion, lanes);
    if (now.is(BlockKind::output))
        add(BlockKind::output, display_.kept(), 4 * vertices, Run::Of::histories);
    if (now.is(BlockKind::pins))
        for (const Buffer* pins : {&state_.pin, &state_.pin_at, &state_.pin_to})
            add(BlockKind::pins, *pins, 4 * vertices, Run::Of::histories);
    if (now.is(BlockKind::wetness))
        for (const Buffer* wetness : {&state_.wetness_given, &state_.wetness_held})
            add(BlockKind::wetness, *wetness, layout_.guides, Run::Of::wetness);
    if (now.is(BlockKind::volume)) {
        std::pmr::vector<LaneBuffer> pushes(&context_.memory);
        model_->add_pressure(pushes);
        for (const LaneBuffer& lanes : pushes)
            add(BlockKind::volume, *lanes.buffer,
                size_t{lanes.layout.strands} * lanes.layout.row * 3, Run::Of::pushes, lanes);
        const size_t n = now.volume.nodes;
        add(BlockKind::volume, volume_.potential(), n * n * n * 2, Run::Of::pressures);
    }
    if (now.is(BlockKind::contact)) {
        std::pmr::vector<LaneBuffer> forces(&context_.memory);
        model_->add_normal_force(forces);
        for (const LaneBuffer& lanes : forces)
            add(BlockKind::contact, *lanes.buffer, size_t{lanes.layout.strands} * lanes.layout.row,
                Run::Of::pushes, lanes);
    }
    if (now.is(BlockKind::levels) && levels_->holds_rows(now.levels))
        add(BlockKind::levels, levels_->held(), size_t{4} * layout_.vertices(), Run::Of::histories);
    return list;
}

Saved Sim::saved_now() {
    Saved now{};
    const auto has = [&](BlockKind kind, bool is = true) {
        now.has[static_cast<size_t>(kind)] = is;
    };
    for (const BlockKind kind :
         {BlockKind::sim, BlockKind::roots, BlockKind::frame, BlockKind::bodies, BlockKind::hair})
        has(kind);
    now.sim = {groom_,         static_cast<uint32_t>(desc_.model),
               layout_.guides, layout_.row,
               desc_.substeps, desc_.step,
               scale_,         clock_.waiting,
               clock_.steps,   clock_.dropped,
               params_.bdf2,   uint32_t{params_.strand_contact.on}};
    const auto all = roots_.all_poses();
    for (size_t i = 0; i < all.size(); ++i) {
        const bool meant = all[i] != all[1] || roots_.aimed; // no target: nothing to keep
        now.roots.heads[i] = meant ? all[i]->head : identity_pose;
        now.roots.own[i] = meant && all[i]->own;
    }
    now.roots.aimed = roots_.aimed;
    now.roots.bends = roots_.samples();
    now.roots.motion = motion_.state();
    now.frame = frame_.state();
    const auto strands = settings();
    has(BlockKind::settings,
        std::ranges::any_of(strands, [&](const Settings& s) { return s != own_settings(); }));
    has(BlockKind::output, display_.interpolates());
    has(BlockKind::pins, bool(state_.pin));
    has(BlockKind::wind, wind_.blows());
    now.wind.time = wind_.moving.time;
    std::ranges::copy(wind_.moving.way, now.wind.way);
    std::ranges::copy(wind_.moving.jump, now.wind.jump);
    has(BlockKind::wetness, bool(state_.wetness));
    now.wetness.dried = state_.wetness ? wetness_.dried() : 0;
    has(BlockKind::volume, volume_.carries);
    has(BlockKind::contact, model_->parts() > 0);
    now.volume.nodes = params_.grid.edge_count;
    has(BlockKind::levels, levels_ != nullptr);
    now.levels = levels_ ? levels_->kept() : SimLevels::Kept{};
    return now;
}

// Lanes are saved as [strand][V][components], whatever the tile of this device is.
Status Sim::save_run(const Run& run, unsigned char* out) {
    if (!run.lanes.buffer)
        return device().read(*run.buffer, 0,
                             run.floats * sizeof(float) / run.buffer->element_size(), out);
    std::pmr::vector<float> tiled(run.buffer->count(), &context_.memory);
    PLAIT_TRY(device().read(*run.buffer, tiled.data()));
    for_each_lane_element(run.lanes.layout, run.lanes.components, [&](size_t lane, size_t plain) {
        std::memcpy(out + plain * sizeof(float), &tiled[lane], sizeof(float));
    });
    return {};
}

Status Sim::write_bodies(SnapshotWriter& to) {
    const auto count = static_cast<uint32_t>(colliders_.slots().size());
    to.put(&count, sizeof count);
    to.put_list(colliders_.slots());
    for (size_t i = 0; i < colliders_.slots().size(); ++i) {
        if (!Colliders::is_hull(colliders_.slots()[i]))
            continue;
        const Colliders::Faces& faces = colliders_.faces()[i];
        const auto of_hull = static_cast<uint32_t>(faces.size());
        to.put(&of_hull, sizeof of_hull);
        to.put_list(faces);
    }
    for (const MeshColliders::Entry& entry : meshes_.entries()) {
        const MeshField& field = *entry.field;
        SavedMesh saved{{}, field.edge, {}, field.band, entry.rules};
        std::ranges::copy(field.origin, saved.origin);
        std::ranges::copy(field.nodes, saved.nodes);
        to.put(&saved, sizeof saved);
        to.put(field.value.data(), field.count() * sizeof(float));
        to.put_list(entry.clearance);
    }
    for (size_t m = 0; m < bending_.entries().size(); ++m)
        PLAIT_TRY(write_bending(to, m));
    return {};
}

Status Sim::write_bending(SnapshotWriter& to, size_t index) {
    const BendingMeshes::Entry& mesh = bending_.entries()[index];
    const TriangleSet& surface = mesh.surface->set;
    const SavedBendingMesh saved = {static_cast<uint32_t>(surface.positions.size()),
                                    static_cast<uint32_t>(surface.triangles.size()),
                                    mesh.two_sided() ? 1u : 0u, mesh.posed ? 1u : 0u, mesh.rules};
    to.put(&saved, sizeof saved);
    to.put_list(surface.positions);
    if (mesh.posed) {
        const size_t bytes = saved.vertices * sizeof(MeshPoint);
        if (unsigned char* out = to.room(4 * bytes)) {
            const auto places = bending_.read(device(), index);
            if (!places)
                return places.error();
            for (const auto* list : {&places->at, &places->target, &places->from, &places->to}) {
                std::memcpy(out, list->data(), bytes);
                out += bytes;
            }
        }
    }
    to.put_list(surface.triangles);
    to.put_list(mesh.clearance);
    const size_t sides = mesh.two_sided() ? 4 * mesh.clearance.size() * sizeof(float) : 0;
    if (unsigned char* out = to.room(sides); out && sides > 0) {
        const auto read = bending_.read_sides(device(), index);
        if (!read)
            return read.error();
        std::memcpy(out, read->data(), sides);
    }
    return {};
}

// What a block begins with, and its runs.
Status Sim::write_snapshot(SnapshotWriter& to) {
    const Saved now = saved_now();
    const auto list = list_runs(now);
    const auto write_runs = [&](BlockKind kind) -> Status {
        for (const Run& run : list)
            if (run.kind == kind)
                if (unsigned char* out = to.room(run.floats * sizeof(float)))
                    PLAIT_TRY(save_run(run, out));
        return {};
    };
    const auto write = [&](BlockKind kind, const auto&... head) -> Status {
        if (!now.is(kind))
            return {};
        to.begin(kind);
        (to.put(&head, sizeof head), ...);
        return write_runs(kind);
    };
    PLAIT_TRY(write(BlockKind::sim, now.sim));
    PLAIT_TRY(write(BlockKind::roots, now.roots));
    PLAIT_TRY(write(BlockKind::frame, now.frame));
    to.begin(BlockKind::bodies);
    PLAIT_TRY(write_bodies(to));
    PLAIT_TRY(write(BlockKind::settings));
    if (now.is(BlockKind::settings))
        for (const Settings& s : settings()) {
            const SavedSettings saved = {s.substeps, s.iterations, s.bdf2};
            to.put(&saved, sizeof saved);
        }
    PLAIT_TRY(write(BlockKind::hair));
    PLAIT_TRY(write(BlockKind::output));
    PLAIT_TRY(write(BlockKind::pins));
    PLAIT_TRY(write(BlockKind::wind, now.wind));
    PLAIT_TRY(write(BlockKind::wetness, now.wetness));
    PLAIT_TRY(write(BlockKind::volume, now.volume));
    PLAIT_TRY(write(BlockKind::contact));
    return write(BlockKind::levels, now.levels);
}

size_t Sim::snapshot_size() {
    SnapshotWriter count(nullptr);
    (void)write_snapshot(count); // only what is read from the device can fail
    return count.end();
}

Status Sim::save(std::span<unsigned char> dst) {
    SnapshotWriter to(dst.data());
    PLAIT_TRY(write_snapshot(to));
    const uint64_t checksum = checksum_of(dst.first(to.end()));
    std::memcpy(dst.data() + offsetof(SnapshotHead, checksum), &checksum, sizeof checksum);
    return {};
}

Result<uint64_t> Sim::hash() {
    std::pmr::vector<unsigned char> bytes(snapshot_size(), &context_.memory);
    PLAIT_TRY(save(bytes));
    Hash hash;
    hash.add(bytes.data(), bytes.size());
    return hash.value();
}

} // namespace plait
