#include "core/strand_contact/pairs.hpp"

#include <algorithm>
#include <vector>

namespace plait {
namespace {

// Cells each way. They repeat: far segments in one of them are looked at and left out.
constexpr uint32_t edge_count = 32;
constexpr uint32_t cells = edge_count * edge_count * edge_count;
constexpr uint32_t cells_of_block = PLAIT_PAIR_BLOCK * PLAIT_PAIR_BLOCK * PLAIT_PAIR_BLOCK;

// Strands stretch under load, and by float32.
constexpr float stretched = 1.1f;

// Edge of a cell over the longest segment. In larger ones more segments are looked at that are far, in
// smaller ones there are more cells; between 0.7 and 1 the time is the same.
constexpr float cell_edge = 0.8f;

// Longest segments by which two may come nearer in a fixed step without one passing unseen.
constexpr float room = 0.5f;

void clear(Schedule& schedule, const Buffer& buffer) {
    schedule.add(PLAIT_STAGE_grid_clear, static_cast<uint32_t>(buffer.count()),
                 plait_grid_clear_params{0}, {&buffer});
}

} // namespace

uint32_t Pairs::group_width(const plait_device_info& device) {
    return std::min(device.max_group_size, device.lanes > 1 ? 16u : 256u);
}

Result<Pairs> Pairs::create(Device& device, const Params& params, const Layout& layout,
                            float longest_segment) {
    Pairs pairs;
    pairs.longest_segment_ = longest_segment;
    if (!params.strand_contact.on)
        return pairs;
    const size_t vertices = layout.guide_vertices(), kept = PLAIT_PAIR_COUNT * vertices;
    constexpr auto u32 = PLAIT_ELEMENT_UINT;
    PairBuffers& b = pairs.buffers_;
    PLAIT_TRY(device.create(b.cell_count, u32, cells, "cell_count"));
    PLAIT_TRY(device.create(b.cell_end, u32, cells, "cell_end"));
    PLAIT_TRY(device.create(b.cell_moves, u32, cells / cells_of_block, "cell_moves"));
    PLAIT_TRY(device.create(b.cell_segment, u32, vertices, "cell_segment"));
    const std::vector<float> lines(PLAIT_PAIR_COMPONENTS * (vertices + PLAIT_PAIR_PADDING));
    PLAIT_TRY(device.create(b.cell_line, PLAIT_ELEMENT_FLOAT, lines.size(), "cell_line"));
    PLAIT_TRY(device.write(b.cell_line, lines.data()));
    PLAIT_TRY(device.create(b.segment, u32, kept, "pair_segment"));
    PLAIT_TRY(device.create(b.offset, PLAIT_ELEMENT_FLOAT, kept, "pair_offset"));
    PLAIT_TRY(device.create(b.dropped, u32, 1, "pair_dropped"));
    const uint32_t none = 0;
    PLAIT_TRY(device.write(b.dropped, &none));
    return pairs;
}

void Pairs::append(Schedule& schedule, const Step& step) const {
    const PairBuffers& b = buffers_;
    const State& state = step.state;
    const uint32_t vertices = step.layout.guide_vertices();
    const plait_pair_params search{step.layout.row,
                                   edge_count,
                                   cell_edge * longest_segment_,
                                   stretched * longest_segment_,
                                   2 * step.params.strand_contact.radius,
                                   room * longest_segment_,
                                   static_cast<float>(step.substeps)};
    clear(schedule, b.cell_count);
    clear(schedule, b.cell_moves);
    clear(schedule, b.dropped);
    schedule.add(
        PLAIT_STAGE_contact_pair_count, vertices, search,
        {&state.vertex_count, &state.position, &state.position_prev, &b.cell_count, &b.cell_moves});
    schedule.add(PLAIT_STAGE_contact_pair_scan, 1, plait_contact_pair_scan_params{edge_count},
                 {&b.cell_count, &b.cell_end}, group_width(step.device));
    schedule.add(PLAIT_STAGE_contact_pair_fill, vertices, search,
                 {&state.vertex_count, &state.position, &state.position_prev, &b.cell_end,
                  &b.cell_segment, &b.cell_line});
    schedule.add(PLAIT_STAGE_contact_pair_find, vertices, search,
                 {&state.vertex_count, &state.rest, &b.cell_end, &b.cell_segment, &b.cell_line,
                  &b.cell_moves, &b.segment, &b.offset, &b.dropped});
}

void Pairs::fill(Schedule& schedule, const Part& part, const State& state, float friction,
                 Doors& doors) const {
    if (!buffers() || !part.plane)
        return;
    schedule.add(PLAIT_STAGE_strand_contact, part.lanes.strands,
                 plait_strand_contact_params{part.lanes.row, part.lanes.tile, part.row_stride,
                                             doors.plane ? 1u : 0u, friction},
                 {&part.strand, &part.vertex_count, &part.rest, &part.pose, &state.position,
                  &state.position_prev, &buffers_.segment, &buffers_.offset, &part.x, &part.plane},
                 part.lanes.row);
    doors.strand = true;
}

} // namespace plait
