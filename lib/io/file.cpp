#include "io/file.hpp"

#include "base/path.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <random>
#include <system_error>
#include <utility>
#include <vector>

#if defined(__unix__) || defined(__APPLE__)
#include <unistd.h>
#elif defined(_WIN32)
#include <fcntl.h>
#include <io.h>
#include <sys/stat.h>
#endif

namespace plait {
namespace {

namespace fs = std::filesystem;

struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Close>;

Error failure(const std::string& path, const char* doing, const std::error_code& why) {
    const bool absent = why == std::errc::no_such_file_or_directory;
    return {absent ? PLAIT_NOT_FOUND : PLAIT_IO,
            format("%s: %s: %s", path.c_str(), doing, why.message().c_str())};
}

Error failure(const std::string& path, const char* doing, int code) {
    return failure(path, doing, std::error_code(code, std::generic_category()));
}

// Flushes the bytes from this process to the disk.
bool flush_to_disk(std::FILE* file) {
    if (std::fflush(file) != 0)
        return false;
#if defined(__unix__) || defined(__APPLE__)
    return fsync(fileno(file)) == 0;
#elif defined(_WIN32)
    return _commit(_fileno(file)) == 0;
#else
    return true;
#endif
}

std::FILE* open_to_read(const std::string& path) {
#ifdef _WIN32
    return _wfopen(native_path(path).c_str(), L"rb");
#else
    return std::fopen(path.c_str(), "rb");
#endif
}

// A new file; an error where there is one of that name.
std::FILE* open_new(const std::string& path) {
#ifdef _WIN32 // whose older C library knows no mode "x"
    const int made = _wopen(native_path(path).c_str(), _O_CREAT | _O_EXCL | _O_BINARY | _O_RDWR,
                            _S_IREAD | _S_IWRITE);
    return made < 0 ? nullptr : _fdopen(made, "w+b");
#else
    return std::fopen(path.c_str(), "w+bx");
#endif
}

int seek_to(std::FILE* file, uint64_t offset) {
#ifdef _WIN32
    return _fseeki64(file, static_cast<int64_t>(offset), SEEK_SET);
#else
    return fseeko(file, static_cast<off_t>(offset), SEEK_SET);
#endif
}

// A name in the same directory, hence on the same disk, that no other writer has.
std::string temporary_name(const std::string& path) {
    std::random_device random;
    return format("%s.%08x.tmp", path.c_str(), random());
}

} // namespace

Status check_file(const std::string& path) {
    std::error_code error;
    const fs::file_status status = fs::status(native_path(path), error);
    if (status.type() == fs::file_type::not_found)
        return Error{PLAIT_NOT_FOUND, format("%s: there is no such file", path.c_str())};
    if (error)
        return failure(path, "cannot look at it", error);
    if (status.type() != fs::file_type::regular)
        return Error{PLAIT_IO, format("%s: is %s, not a regular file", path.c_str(),
                                      fs::is_directory(status) ? "a directory" : "special")};
    return {};
}

Result<ByteVector> read_file(const std::string& path, std::pmr::memory_resource* memory) {
    PLAIT_TRY(check_file(path));
    std::error_code error;
    const uintmax_t size = fs::file_size(native_path(path), error);
    if (error)
        return failure(path, "cannot get its size", error);
    File file(open_to_read(path));
    if (!file)
        return failure(path, "cannot open", errno);
    ByteVector bytes(static_cast<size_t>(size), memory);
    const size_t got = std::fread(bytes.data(), 1, bytes.size(), file.get());
    if (std::ferror(file.get()))
        return failure(path, "cannot read", errno);
    bytes.resize(got); // it may have been cut since its size was asked for
    return bytes;
}

Result<NewFile> NewFile::create(const std::string& path) {
    std::string temporary = temporary_name(path);
    std::FILE* const file = open_new(temporary);
    if (!file)
        return failure(path, "cannot make a file beside it", errno);
    return NewFile(path, std::move(temporary), file);
}

NewFile::NewFile(NewFile&& other) noexcept
    : path_(std::move(other.path_)), temporary_(std::move(other.temporary_)),
      file_(std::exchange(other.file_, nullptr)), size_(other.size_) {
    other.temporary_.clear();
}

NewFile::~NewFile() {
    if (file_)
        std::fclose(file_);
    std::error_code error;
    if (!temporary_.empty())
        fs::remove(native_path(temporary_), error);
}

Status NewFile::write(std::span<const std::byte> bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size())
        return failure(path_, "cannot write", errno);
    size_ += bytes.size();
    return {};
}

Status NewFile::patch(uint64_t offset, std::span<const std::byte> bytes) {
    if (seek_to(file_, offset) != 0 ||
        std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size() ||
        seek_to(file_, size_) != 0)
        return failure(path_, "cannot write", errno);
    return {};
}

Status NewFile::copy_to(NewFile& other) {
    if (seek_to(file_, 0) != 0)
        return failure(path_, "cannot read", errno);
    std::vector<std::byte> piece(1 << 20);
    for (uint64_t left = size_; left > 0;) {
        const size_t count =
            std::fread(piece.data(), 1, std::min<uint64_t>(left, piece.size()), file_);
        if (count == 0)
            return failure(path_, "cannot read", errno);
        PLAIT_TRY(other.write(std::span(piece).first(count)));
        left -= count;
    }
    if (seek_to(file_, size_) != 0)
        return failure(path_, "cannot read", errno);
    return {};
}

Status NewFile::commit() {
    if (!flush_to_disk(file_))
        return failure(path_, "cannot write", errno);
    if (std::fclose(std::exchange(file_, nullptr)) != 0)
        return failure(path_, "cannot write", errno);
    std::error_code error;
    fs::rename(native_path(temporary_), native_path(path_), error);
    if (error)
        return failure(path_, "cannot put the new file in its place", error);
    temporary_.clear();
    return {};
}

Status write_file(const std::string& path, std::span<const std::byte> bytes) {
    auto file = NewFile::create(path);
    PLAIT_TRY(file);
    PLAIT_TRY(file->write(bytes));
    return file->commit();
}

} // namespace plait
