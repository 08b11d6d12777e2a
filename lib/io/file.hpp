// Whole files: read at once, written atomically.
#pragma once

#include "io/bytes.hpp"

#include <cstdio>
#include <string>

namespace plait {

// OK if `path` names a regular file; NOT_FOUND or IO otherwise.
Status check_file(const std::string& path);

// NOT_FOUND, IO (a directory, a device, a failed read).
Result<ByteVector> read_file(const std::string& path, std::pmr::memory_resource* memory);

// A file that is written beside its place and put there by commit(): until then, and after a failure or a
// crash, `path` is what it was. Not committed: removed.
class NewFile {
  public:
    // IO, NOT_FOUND (of its folder).
    static Result<NewFile> create(const std::string& path);
    NewFile(NewFile&& other) noexcept;
    NewFile& operator=(NewFile&&) = delete;
    ~NewFile();

    const std::string& path() const { return path_; }
    uint64_t size() const { return size_; } // written so far
    Status write(std::span<const std::byte> bytes);
    // Overwrites what was written at `offset`.
    Status patch(uint64_t offset, std::span<const std::byte> bytes);
    // Writes all of it to `other`, too.
    Status copy_to(NewFile& other);
    // Flushes every byte to the disk and renames the file to `path`.
    Status commit();

  private:
    NewFile(std::string path, std::string temporary, std::FILE* file)
        : path_(std::move(path)), temporary_(std::move(temporary)), file_(file) {}

    std::string path_, temporary_;
    std::FILE* file_;
    uint64_t size_ = 0;
};

// Writes a new file beside `path` and renames it over `path` once every byte has reached the disk:
// after a failure, or a crash, `path` is what it was.
Status write_file(const std::string& path, std::span<const std::byte> bytes);

} // namespace plait
