// Whole files: read at once, written atomically.
#pragma once

#include "io/bytes.hpp"

#include <string>

namespace plait {

// OK if `path` names a regular file; NOT_FOUND or IO otherwise.
Status check_file(const std::string& path);

// NOT_FOUND, IO (a directory, a device, a failed read).
Result<ByteVector> read_file(const std::string& path, std::pmr::memory_resource* memory);

// Writes a new file beside `path` and renames it over `path` once every byte has reached the disk:
// after a failure, or a crash, `path` is what it was.
Status write_file(const std::string& path, std::span<const std::byte> bytes);

} // namespace plait
