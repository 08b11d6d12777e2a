#include "fuzz.hpp"

using namespace plait;

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    auto strands = read_polylines(fuzz::bytes_of(data, size), "obj", {});
    if (strands)
        fuzz::demand_whole(*strands, size);
    return 0;
}
