// .glb by its first four bytes, else .gltf. For a line strip of no vertices assimp asks for 64 GiB:
// what is too large is refused here as by a machine that has not so much.
#include "fuzz.hpp"

#include <cstring>
#include <new>

using namespace plait;

void* operator new(size_t size, const std::nothrow_t&) noexcept {
    return size < size_t{256} << 20 ? std::malloc(size) : nullptr;
}
void* operator new(size_t size) {
    void* const memory = operator new(size, std::nothrow);
    return memory ? memory : throw std::bad_alloc();
}
void* operator new[](size_t size) {
    return operator new(size);
}
void* operator new[](size_t size, const std::nothrow_t&) noexcept {
    return operator new(size, std::nothrow);
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, size_t) noexcept {
    std::free(memory);
}
void operator delete[](void* memory) noexcept {
    std::free(memory);
}
void operator delete[](void* memory, size_t) noexcept {
    std::free(memory);
}

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const bool binary = size >= 4 && std::memcmp(data, "glTF", 4) == 0;
    try {
        auto strands = read_polylines(fuzz::bytes_of(data, size), binary ? "glb" : "gltf", {});
        if (strands) // a node of a few bytes places a whole mesh once more
            fuzz::demand_whole(*strands, SIZE_MAX);
    } catch (const std::bad_alloc&) {
        // one that assimp let through; the C face makes it PLAIT_OUT_OF_MEMORY
    }
    return 0;
}
