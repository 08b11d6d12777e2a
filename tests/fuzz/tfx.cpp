#include "fuzz.hpp"

using namespace plait;

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    auto strands = read_tfx({fuzz::bytes_of(data, size), "input.tfx"}, {});
    if (!strands)
        return 0;
    fuzz::demand_whole(*strands, size);
    auto written = write_tfx(*strands);
    fuzz::demand(written.ok(), "what was read can be written");
    auto again = read_tfx({*written, "written.tfx"}, {});
    fuzz::demand(again.ok(), "what was written can be read");
    fuzz::demand(again->vertex_counts == strands->vertex_counts, "vertex counts survive");
    fuzz::demand(fuzz::same(again->positions, strands->positions), "positions survive");
    fuzz::demand(fuzz::same(again->strand_uv, strands->strand_uv), "UV survives");
    fuzz::demand(fuzz::same(again->thickness, strands->thickness), "thickness survives");
    return 0;
}
