#include "fuzz.hpp"

using namespace plait;

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    std::string notes;
    ReadOptions options;
    options.notes = &notes;
    auto strands = read_ply({fuzz::bytes_of(data, size), "input.ply"}, options);
    if (strands)
        fuzz::demand_whole(*strands, size);
    fuzz::demand(notes.size() < 8192, "notes are sentences, not lists");
    return 0;
}
