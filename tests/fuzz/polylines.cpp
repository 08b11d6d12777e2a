#include "fuzz.hpp"

using namespace plait;

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const auto bytes = fuzz::bytes_of(data, size);
    auto strands = read_polylines({bytes.begin(), bytes.end()}, "memory.obj", {});
    if (strands)
        fuzz::demand_whole(*strands, size);
    return 0;
}
