#include "io/alembic/ogawa.hpp"

namespace plait {
namespace {

constexpr std::string_view OGAWA = "Ogawa", HDF5 = "\x89HDF\r\n\x1a\n";

} // namespace

Result<OgawaGroup> OgawaFile::root() const {
    if (file_.size() >= HDF5.size() && file_.view(0, HDF5.size()) == HDF5)
        return Error{
            PLAIT_UNSUPPORTED,
            format("%s: is Alembic in HDF5, which is not read; \"abcconvert -toOgawa IN OUT\" "
                   "of Alembic makes a file that is",
                   file_.file().c_str())};
    PLAIT_TRY(file_.check_range("header", 0, 0, OGAWA_HEADER_SIZE, 1));
    if (file_.view(0, OGAWA.size()) != OGAWA)
        return file_.bad(0, "signature is not Ogawa");
    if (const uint8_t closed = file_.u8(OGAWA_CLOSED_AT); closed != 0xff)
        return file_.bad(OGAWA_CLOSED_AT, format("the mark of a closed file is %u; allowed is 255: "
                                                 "its writer did not end",
                                                 closed));
    if (const unsigned version = file_.u8(6) << 8 | file_.u8(7); version != 1)
        return file_.bad(6, format("version of Ogawa is %u; allowed is 1", version));
    return group_at(OGAWA_ROOT_AT, file_.u64(OGAWA_ROOT_AT), "root group");
}

Result<OgawaGroup> OgawaFile::group_at(uint64_t field, uint64_t at, const char* what) const {
    if (at == 0)
        return OgawaGroup{};
    PLAIT_TRY(file_.check_range(what, field, at, 8, 1));
    const uint64_t count = file_.u64(at);
    PLAIT_TRY(file_.check_range(what, at, at + 8, count, 8));
    return OgawaGroup{at, count};
}

Status OgawaFile::check_child(const OgawaGroup& parent, uint64_t index, const char* what,
                              bool is_data) const {
    if (index >= parent.count)
        return file_.bad(parent.at, format("%s is child %" PRIu64 " of a group that has %" PRIu64,
                                           what, index, parent.count));
    if (((word(parent, index) & OGAWA_DATA) != 0) != is_data)
        return file_.bad(parent.at + 8 + 8 * index,
                         format("%s is %s; allowed is %s", what, is_data ? "a group" : "data",
                                is_data ? "data" : "a group"));
    return {};
}

Result<OgawaGroup> OgawaFile::group(const OgawaGroup& parent, uint64_t index,
                                    const char* what) const {
    PLAIT_TRY(check_child(parent, index, what, false));
    return group_at(parent.at + 8 + 8 * index, word(parent, index), what);
}

Result<OgawaData> OgawaFile::data(const OgawaGroup& parent, uint64_t index,
                                  const char* what) const {
    PLAIT_TRY(check_child(parent, index, what, true));
    const uint64_t field = parent.at + 8 + 8 * index, at = word(parent, index) & ~OGAWA_DATA;
    if (at == 0)
        return OgawaData{};
    PLAIT_TRY(file_.check_range(what, field, at, 8, 1));
    const uint64_t size = file_.u64(at);
    PLAIT_TRY(file_.check_range(what, at, at + 8, size, 1));
    return OgawaData{at + 8, size};
}

} // namespace plait
