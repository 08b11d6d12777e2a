// Names for documents that are the same on every machine.
#pragma once

#include "common/json_reader.hpp"

#include <cstdio>

namespace lab {

// FNV-1a of what the document says, 16 hex digits.
inline std::string hash_of(const common::Json& document) {
    uint64_t hash = 14695981039346656037u;
    for (const char c : document.dump())
        hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
    char hex[17];
    std::snprintf(hex, sizeof hex, "%016llx", static_cast<unsigned long long>(hash));
    return hex;
}

} // namespace lab
