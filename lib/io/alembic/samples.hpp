// First samples of properties, as arrays of known types.
#pragma once

#include "io/alembic/archive.hpp"
#include "io/curves/packed.hpp"

#include <deque>

namespace plait {

class AlembicSamples {
  public:
    AlembicSamples(AlembicArchive& archive, std::pmr::memory_resource* memory)
        : archive_(archive), expanded_(memory) {}

    // float32, elements of `width` values. Of a compound: what its `.indices` choose of its `.vals`.
    // `place` names the object. BAD_DATA, UNSUPPORTED (another type).
    Result<PackedFloats> floats(const std::string& place, const AlembicProperty& property,
                                uint32_t width);
    Result<PackedIntegers> integers(const std::string& place, const AlembicProperty& property);
    // float64; `at`(i) of what is returned.
    Result<OgawaData> doubles(const std::string& place, const AlembicProperty& property);
    // Whether there is nothing to read.
    Result<bool> is_empty(const AlembicProperty& property);
    // Arrays so far are no longer used.
    void clear() { expanded_.clear(); }

  private:
    Result<OgawaData> sample(const std::string& place, const AlembicProperty& property,
                             uint64_t element);
    Result<PackedFloats> indexed_floats(const std::string& place, const AlembicProperty& compound,
                                        uint32_t width);

    AlembicArchive& archive_;
    std::pmr::deque<ByteVector> expanded_;
};

} // namespace plait
