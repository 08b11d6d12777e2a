#include "fuzz.hpp"

using namespace plait;

// The first byte is the number of strands the skin is for, never 0; the file is the rest.
int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    if (size == 0 || data[0] == 0)
        return 0;
    StrandSet strands;
    strands.vertex_counts.assign(data[0], 0);
    if (!read_tfxbone({fuzz::bytes_of(data + 1, size - 1), "input.tfxbone"}, strands))
        return 0;
    fuzz::demand_whole(strands, size);
    for (size_t s = 0; s < strands.vertex_counts.size(); ++s) {
        const float* w = &strands.bone_weights[4 * s];
        const float sum = w[0] + w[1] + w[2] + w[3];
        fuzz::demand(sum > 0.999998f && sum < 1.000002f, "weights sum to 1");
    }
    auto written = write_tfxbone(strands);
    fuzz::demand(written.ok(), "what was read can be written");
    StrandSet again;
    again.vertex_counts = strands.vertex_counts;
    fuzz::demand(read_tfxbone({*written, "written.tfxbone"}, again).ok(), "and read again");
    fuzz::demand(again.bone_indices == strands.bone_indices, "bone indices survive");
    fuzz::demand(fuzz::same(again.bone_weights, strands.bone_weights), "bone weights survive");
    return 0;
}
