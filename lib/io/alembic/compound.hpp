// Properties and objects of Alembic as they are written.
#pragma once

#include "io/alembic/archive.hpp"
#include "io/alembic/ogawa_writer.hpp"

#include <string>
#include <vector>

namespace plait {

// 128 bits of some bytes, the same for the same bytes.
using SampleKey = std::array<std::byte, 16>;
SampleKey key_of(std::span<const std::byte> bytes);

// Metadata that headers name by index.
class MetadataList {
  public:
    uint32_t index(const std::string& metadata); // of "" 0
    ByteVector bytes() const;

  private:
    std::vector<std::string> entries_;
};

// What a property is, beside its samples.
struct PropertyKind {
    std::string name;
    std::string metadata;
    AlembicType type = AlembicType::SCALAR;
    AlembicPod pod = AlembicPod::U8;
    uint32_t extent = 1;
};

// The samples that a property has so far.
struct PropertySamples {
    std::vector<OgawaWord> words; // of a scalar one for each stored sample, of an array two
    uint32_t samples = 0;
    bool changes = false;  // false: the first sample is all of them
    bool same_size = true; // of all samples
    bool one_element = true;
    uint32_t times = 0; // time sampling
    SampleKey hash{};   // of all samples
};

// Collects the properties of one compound, then writes it.
class CompoundWriter {
  public:
    CompoundWriter(OgawaWriter& out, MetadataList& metadata)
        : out_(out), metadata_(metadata), headers_(std::pmr::get_default_resource()) {}

    // A property with one value for all samples.
    Status constant(const PropertyKind& kind, uint32_t times, uint32_t samples,
                    std::span<const std::byte> bytes, size_t elements = 1);
    Status add(const PropertyKind& kind, const PropertySamples& samples);
    Status add(const std::string& name, const std::string& metadata, CompoundWriter& compound);
    Result<OgawaWord> write();
    const SampleKey& hash() const { return hash_; }

  private:
    OgawaWriter& out_;
    MetadataList& metadata_;
    std::vector<OgawaWord> children_;
    ByteWriter headers_;
    SampleKey hash_{};
};

// Writes one sample and enters it.
Status add_sample(OgawaWriter& out, PropertySamples& samples, AlembicType type,
                  std::span<const std::byte> bytes, size_t elements);

} // namespace plait
