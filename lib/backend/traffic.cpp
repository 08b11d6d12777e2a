// What a stage has to move through memory, from stages.def and the sizes of its buffers.
#include <plait/plait_backend.h>

#include <algorithm>
#include <string_view>

namespace {

struct Hair {
    uint64_t strands, vertices; // that the items are of; 0: items are not of hair
};

Hair hair_of(const plait_stage_info& stage, uint64_t items, uint64_t row) {
    switch (stage.space) {
    case PLAIT_SPACE_VERTEX:
        return {(items + row - 1) / row, items};
    case PLAIT_SPACE_STRAND:
    case PLAIT_SPACE_STRAND_GROUP:
    case PLAIT_SPACE_LANES:
        return {items, items * row};
    default:
        return {0, 0};
    }
}

// Elements of a grid's buffer that one vertex touches.
uint64_t grid_elements_per_vertex(std::string_view name) {
    return name == "grid_sum" ? 8 * PLAIT_SUM_STRIDE : 1; // eight nodes
}

// Buffers may be larger than a stage's part of them: they hold other strands, too, and a grid has
// voxels without hair.
uint64_t touched(const plait_stage_arg& arg, const Hair& hair, uint64_t elements) {
    const std::string_view name = arg.name;
    if (hair.vertices == 0)
        return elements;
    if (name.starts_with("grid_"))
        return std::min(elements, hair.vertices * grid_elements_per_vertex(name));
    if (arg.element == PLAIT_ELEMENT_REAL || name.starts_with("lane_"))
        return std::min(elements, hair.vertices * PLAIT_LANE_MATERIAL_COMPONENTS); // the most
    if (name == "vertex_count")
        return std::min(elements, hair.strands);
    // Of a strand there are at most four elements beside those of its vertices: bones.
    return std::min(elements, std::max(hair.vertices, 4 * hair.strands));
}

} // namespace

extern "C" uint64_t plait_stage_traffic(plait_stage stage, uint32_t item_count,
                                        uint32_t vertices_per_strand, const size_t* elements) {
    const plait_stage_info* info = plait_stage_describe(stage);
    if (!info)
        return 0;
    const Hair hair = hair_of(*info, item_count, std::max(vertices_per_strand, 1u));
    uint64_t bytes = 0;
    for (uint32_t i = 0; i < info->arg_count; ++i) {
        const plait_stage_arg& arg = info->args[i];
        if (arg.access == PLAIT_ACCESS_LOCAL)
            continue;
        const uint64_t width = arg.element == PLAIT_ELEMENT_FLOAT4 ? 16 : 4;
        const uint64_t ways = arg.access == PLAIT_ACCESS_READWRITE ? 2 : 1;
        bytes += width * ways * touched(arg, hair, *elements++);
    }
    return bytes;
}
