#include "fuzz.hpp"

using namespace plait;

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    std::string notes;
    ReadOptions options;
    options.notes = &notes;
    auto strands = read_usd({fuzz::bytes_of(data, size), "input.usda"}, options);
    if (strands)
        fuzz::demand_whole_curves(*strands, size);
    fuzz::demand(notes.size() < 8192, "notes are sentences, not lists");
    return 0;
}
