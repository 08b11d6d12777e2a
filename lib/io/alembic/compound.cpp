#include "io/alembic/compound.hpp"

#include "base/hash.hpp"

#include <algorithm>

namespace plait {
namespace {

constexpr size_t MOST_INDEXED = 254, MOST_INDEXED_SIZE = 255;

// The width of a header's numbers: 0, 1 or 2 for 1, 2 or 4 bytes.
uint32_t width_of(uint64_t most) {
    return most > 0xffff ? 2 : most > 0xff ? 1 : 0;
}

void put(ByteWriter& out, uint32_t width, uint64_t word) {
    if (width == 0)
        out.u8(static_cast<uint8_t>(word));
    else if (width == 1)
        out.u16(static_cast<uint16_t>(word));
    else
        out.u32(static_cast<uint32_t>(word));
}

SampleKey both(const SampleKey& a, const SampleKey& b) {
    std::array<std::byte, 32> bytes;
    std::ranges::copy(a, bytes.begin());
    std::ranges::copy(b, bytes.begin() + 16);
    return key_of(bytes);
}

} // namespace

// Two sums over alternate words, each of which goes into both halves of the key. Readers compare keys,
// and compute none.
SampleKey key_of(std::span<const std::byte> bytes) {
    uint64_t lane[2] = {0x9e3779b97f4a7c15u, bytes.size() ^ 0xbf58476d1ce4e5b9u};
    const auto add = [&](uint64_t& sum, uint64_t word) {
        sum = (sum ^ word) * 0xff51afd7ed558ccdu;
        sum ^= sum >> 32;
    };
    size_t at = 0;
    for (; at + 16 <= bytes.size(); at += 16) {
        uint64_t words[2];
        std::memcpy(words, bytes.data() + at, sizeof words);
        add(lane[0], words[0]);
        add(lane[1], words[1]);
    }
    uint64_t rest[2] = {};
    if (at < bytes.size())
        std::memcpy(rest, bytes.data() + at, bytes.size() - at);
    add(lane[0], rest[0]);
    add(lane[1], rest[1]);
    return std::bit_cast<SampleKey>(std::array{little_endian(mix64(lane[0] + mix64(lane[1]))),
                                               little_endian(mix64(lane[1] ^ mix64(~lane[0])))});
}

uint32_t MetadataList::index(const std::string& metadata) {
    if (metadata.empty())
        return 0;
    if (const auto found = std::ranges::find(entries_, metadata); found != entries_.end())
        return static_cast<uint32_t>(found - entries_.begin()) + 1;
    if (metadata.size() > MOST_INDEXED_SIZE || entries_.size() == MOST_INDEXED)
        return INLINE_METADATA;
    entries_.push_back(metadata);
    return static_cast<uint32_t>(entries_.size());
}

ByteVector MetadataList::bytes() const {
    ByteWriter out(std::pmr::get_default_resource());
    for (const std::string& entry : entries_) {
        out.u8(static_cast<uint8_t>(entry.size()));
        out.text(entry);
    }
    return std::move(out).take();
}

Status add_sample(OgawaWriter& out, PropertySamples& samples, AlembicType type,
                  std::span<const std::byte> bytes, size_t elements) {
    const SampleKey key = key_of(bytes);
    auto word = out.data({key, bytes});
    PLAIT_TRY(word);
    samples.words.push_back(*word);
    if (type == AlembicType::ARRAY)
        samples.words.push_back(OGAWA_DATA); // of one dimension, which the size tells
    samples.one_element = samples.one_element && elements == 1;
    samples.hash = both(samples.hash, key);
    ++samples.samples;
    return {};
}

Status CompoundWriter::constant(const PropertyKind& kind, uint32_t times, uint32_t samples,
                                std::span<const std::byte> bytes, size_t elements) {
    PropertySamples all;
    PLAIT_TRY(add_sample(out_, all, kind.type, bytes, elements));
    all.samples = samples;
    all.times = times;
    return add(kind, all);
}

Status CompoundWriter::add(const PropertyKind& kind, const PropertySamples& samples) {
    auto group = out_.group(samples.words);
    PLAIT_TRY(group);
    children_.push_back(*group);
    hash_ = both(hash_, both(key_of(std::as_bytes(std::span(kind.name))), samples.hash));
    const uint32_t metadata = metadata_.index(kind.metadata);
    const uint32_t width =
        width_of(std::max<uint64_t>({kind.metadata.size(), kind.name.size(), samples.samples}));
    const bool scalar_like = kind.type == AlembicType::SCALAR || samples.one_element;
    headers_.u32(static_cast<uint32_t>(kind.type) | (scalar_like ? 1 : 0) | width << 2 |
                 static_cast<uint32_t>(kind.pod) << 4 | (samples.times ? 0x100 : 0) |
                 (samples.same_size ? 0x400 : 0) | (samples.changes ? 0 : 0x800) |
                 kind.extent << 12 | metadata << 20);
    put(headers_, width, samples.samples);
    if (samples.times)
        put(headers_, width, samples.times);
    put(headers_, width, kind.name.size());
    headers_.text(kind.name);
    if (metadata == INLINE_METADATA) {
        put(headers_, width, kind.metadata.size());
        headers_.text(kind.metadata);
    }
    return {};
}

Status CompoundWriter::add(const std::string& name, const std::string& metadata,
                           CompoundWriter& compound) {
    auto group = compound.write();
    PLAIT_TRY(group);
    children_.push_back(*group);
    hash_ = both(hash_, both(key_of(std::as_bytes(std::span(name))), compound.hash()));
    const uint32_t index = metadata_.index(metadata);
    const uint32_t width = width_of(std::max(name.size(), metadata.size()));
    headers_.u32(width << 2 | index << 20);
    put(headers_, width, name.size());
    headers_.text(name);
    if (index == INLINE_METADATA) {
        put(headers_, width, metadata.size());
        headers_.text(metadata);
    }
    return {};
}

Result<OgawaWord> CompoundWriter::write() {
    if (!children_.empty()) {
        auto headers = out_.data({headers_.bytes()});
        PLAIT_TRY(headers);
        children_.push_back(*headers);
    }
    return out_.group(children_);
}

} // namespace plait
