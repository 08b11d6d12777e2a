#include "fuzz.hpp"

using namespace plait;

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    auto strands = read_hair({fuzz::bytes_of(data, size), "input.hair"}, {});
    if (!strands)
        return 0;
    fuzz::demand_whole(*strands, size);
    auto written = write_hair(*strands);
    if (!written) // strands of more than 65536 vertices, by the header's default
        return 0;
    auto again = read_hair({*written, "written.hair"}, {});
    fuzz::demand(again.ok(), "what was written can be read");
    fuzz::demand(again->vertex_counts == strands->vertex_counts, "vertex counts survive");
    fuzz::demand(fuzz::same(again->positions, strands->positions), "positions survive");
    fuzz::demand(again->thickness.size() == strands->thickness.size(), "thickness survives");
    return 0;
}
