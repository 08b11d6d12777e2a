// The header of PLY: elements, each with so many properties.
#pragma once

#include "io/bytes.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace plait {

enum class PlyFormat { TEXT, LITTLE, BIG };

struct PlyType {
    uint32_t bytes = 0;
    bool has_sign = false, is_float = false;
};

struct PlyProperty {
    std::string_view name;
    PlyType type;
    PlyType count; // of a list; of one value 0 bytes
    bool is_list() const { return count.bytes > 0; }
};

struct PlyElement {
    std::string_view name;
    uint64_t count = 0;
    std::vector<PlyProperty> properties;
};

struct PlyHeader {
    PlyFormat format = PlyFormat::TEXT;
    std::vector<PlyElement> elements;
    uint64_t end = 0; // where the values begin
};

// BAD_DATA (line, word, what is allowed).
Result<PlyHeader> read_ply_header(const ByteReader& file);

} // namespace plait
