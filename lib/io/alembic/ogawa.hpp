// Ogawa, the container of Alembic files: a tree of groups, whose leaves are data. A group is a count and
// as many words, the positions of its children; data is a size and as many bytes.
#pragma once

#include "io/bytes.hpp"

namespace plait {

// A child that is data has this bit in its word; nothing else in it: no bytes. A group of word 0 has no
// children.
inline constexpr uint64_t OGAWA_DATA = uint64_t{1} << 63;
inline constexpr uint64_t OGAWA_HEADER_SIZE = 16, OGAWA_ROOT_AT = 8, OGAWA_CLOSED_AT = 5;

struct OgawaGroup {
    uint64_t at = 0; // of its count
    uint64_t count = 0;
};

struct OgawaData {
    uint64_t at = 0; // of its first byte
    uint64_t size = 0;
};

// Every range that is handed out lies inside the file.
class OgawaFile {
  public:
    explicit OgawaFile(const ByteReader& file) : file_(file) {}
    const ByteReader& bytes() const { return file_; }

    // BAD_DATA, UNSUPPORTED (HDF5).
    Result<OgawaGroup> root() const;
    // BAD_DATA: there is no such child, or it is of the other kind. `what` names it.
    Result<OgawaGroup> group(const OgawaGroup& parent, uint64_t index, const char* what) const;
    Result<OgawaData> data(const OgawaGroup& parent, uint64_t index, const char* what) const;
    bool is_data(const OgawaGroup& parent, uint64_t index) const {
        return index < parent.count && (word(parent, index) & OGAWA_DATA) != 0;
    }

  private:
    uint64_t word(const OgawaGroup& parent, uint64_t index) const {
        return file_.u64(parent.at + 8 + 8 * index);
    }
    Status check_child(const OgawaGroup& parent, uint64_t index, const char* what,
                       bool is_data) const;
    Result<OgawaGroup> group_at(uint64_t field, uint64_t at, const char* what) const;

    const ByteReader& file_;
};

} // namespace plait
