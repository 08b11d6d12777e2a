#include "cache.hpp"
#include "common.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>

namespace simulate {

namespace {

constexpr char magic[8] = {'P', 'L', 'A', 'I', 'T', 'T', 'R', 'J'};
constexpr size_t pose_floats = 7;

size_t floats_of(const CacheHeader& header) { // a frame
    return pose_floats + 3 * size_t{header.strands} * header.row;
}

File open(const std::string& path, const char* mode) {
    File file(std::fopen(path.c_str(), mode));
    if (!file)
        throw Failure(path + ": " + std::strerror(errno));
    return file;
}

uint64_t size_of(std::FILE* file) {
    std::fseek(file, 0, SEEK_END);
    const long size = std::ftell(file);
    std::fseek(file, 0, SEEK_SET);
    return static_cast<uint64_t>(size);
}

} // namespace

CacheWriter::CacheWriter(const std::string& path, std::span<const uint32_t> vertex_count,
                         uint32_t row, uint32_t frames_planned, float rate)
    : path_(path), file_(open(path, "wb")) {
    CacheHeader header{{},   1, static_cast<uint32_t>(vertex_count.size()), row, frames_planned,
                       rate, 0};
    std::memcpy(header.magic, magic, sizeof magic);
    write(&header, sizeof header);
    write(vertex_count.data(), vertex_count.size_bytes());
    packed_.resize(floats_of(header));
}

CacheWriter::CacheWriter(const std::string& path, const CacheHeader& header, uint32_t frames)
    : path_(path) {
    std::error_code error;
    std::filesystem::resize_file(path,
                                 sizeof header + sizeof(uint32_t) * uint64_t{header.strands} +
                                     frames * sizeof(float) * floats_of(header),
                                 error);
    if (error)
        throw Failure(path + ": " + error.message());
    file_ = open(path, "ab");
    packed_.resize(floats_of(header));
}

void CacheWriter::write(const void* data, size_t size) {
    if (std::fwrite(data, 1, size, file_.get()) != size)
        throw Failure(path_ + ": " + std::strerror(errno));
}

void CacheWriter::append(const Shot& shot) {
    std::memcpy(packed_.data(), &shot.head, sizeof shot.head);
    for (size_t vertex = 0; 4 * vertex < shot.positions.size(); ++vertex)
        std::memcpy(&packed_[pose_floats + 3 * vertex], &shot.positions[4 * vertex],
                    3 * sizeof(float));
    write(packed_.data(), packed_.size() * sizeof(float));
    if (std::fflush(file_.get()) != 0)
        throw Failure(path_ + ": " + std::strerror(errno));
}

CacheReader::CacheReader(const std::string& path) : path_(path), file_(open(path, "rb")) {
    const uint64_t size = size_of(file_.get());
    read_exactly(&header_, sizeof header_);
    if (std::memcmp(header_.magic, magic, sizeof magic) != 0 || header_.version != 1)
        throw Failure(path + ": not a trajectory of version 1");
    const uint64_t counts = sizeof(uint32_t) * uint64_t{header_.strands};
    if (header_.strands == 0 || header_.row < 2 || header_.row > 256 || !(header_.rate > 0.0f) ||
        size < sizeof header_ + counts)
        throw Failure(path + ": header of " + std::to_string(header_.strands) + " strands x " +
                      std::to_string(header_.row) + " at " + std::to_string(header_.rate) +
                      " Hz in " + std::to_string(size) + " bytes");
    vertex_count_.resize(header_.strands);
    read_exactly(vertex_count_.data(), counts);
    for (const uint32_t count : vertex_count_)
        if (count > header_.row)
            throw Failure(path + ": a strand of " + std::to_string(count) +
                          " vertices in rows of " + std::to_string(header_.row));
    frames_ = static_cast<uint32_t>((size - sizeof header_ - counts) / frame_size());
}

size_t CacheReader::frame_size() const {
    return sizeof(float) * floats_of(header_);
}

void CacheReader::read_exactly(void* data, size_t size) {
    if (std::fread(data, 1, size, file_.get()) != size)
        throw Failure(path_ + ": ends early");
}

Shot CacheReader::read(uint32_t frame) {
    if (frame >= frames_)
        throw Failure(path_ + ": frame " + std::to_string(frame) + " of " +
                      std::to_string(frames_));
    const size_t start =
        sizeof header_ + sizeof(uint32_t) * vertex_count_.size() + frame * frame_size();
    std::fseek(file_.get(), static_cast<long>(start), SEEK_SET);
    packed_.resize(frame_size() / sizeof(float));
    read_exactly(packed_.data(), frame_size());
    const size_t vertices = size_t{header_.strands} * header_.row;
    positions_.assign(4 * vertices, 1.0f);
    for (size_t vertex = 0; vertex < vertices; ++vertex)
        std::memcpy(&positions_[4 * vertex], &packed_[pose_floats + 3 * vertex], 3 * sizeof(float));
    Shot shot{frame,      static_cast<float>(frame) / header_.rate, {}, positions_, vertex_count_,
              header_.row};
    std::memcpy(&shot.head, packed_.data(), sizeof shot.head);
    return shot;
}

} // namespace simulate
