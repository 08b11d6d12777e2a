#include "io/alembic/ogawa_writer.hpp"

namespace plait {
namespace {

std::array<std::byte, 8> bytes_of(uint64_t word) {
    return std::bit_cast<std::array<std::byte, 8>>(little_endian(word));
}

} // namespace

Status OgawaWriter::begin() {
    ByteWriter header(std::pmr::get_default_resource());
    header.text("Ogawa");
    header.u8(0); // not closed yet
    header.u8(0);
    header.u8(1); // version
    header.u64(0);
    return file_.write(header.bytes());
}

Result<OgawaWord> OgawaWriter::data(std::initializer_list<std::span<const std::byte>> parts) {
    uint64_t size = 0;
    for (const auto& part : parts)
        size += part.size();
    if (size == 0)
        return OGAWA_DATA;
    const uint64_t at = file_.size();
    PLAIT_TRY(file_.write(bytes_of(size)));
    for (const auto& part : parts)
        PLAIT_TRY(file_.write(part));
    return at | OGAWA_DATA;
}

Result<OgawaWord> OgawaWriter::group(std::span<const OgawaWord> children) {
    if (children.empty())
        return OgawaWord{0};
    const uint64_t at = file_.size();
    PLAIT_TRY(file_.write(bytes_of(children.size())));
    for (const OgawaWord child : children)
        PLAIT_TRY(file_.write(bytes_of(child)));
    return at;
}

Status OgawaWriter::end(OgawaWord root) {
    PLAIT_TRY(file_.patch(OGAWA_ROOT_AT, bytes_of(root)));
    const std::byte closed{0xff};
    return file_.patch(OGAWA_CLOSED_AT, {&closed, 1});
}

} // namespace plait
