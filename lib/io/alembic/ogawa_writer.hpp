// Writes Ogawa from the leaves up: each group after its children.
#pragma once

#include "io/alembic/ogawa.hpp"
#include "io/file.hpp"

#include <array>
#include <initializer_list>
#include <vector>

namespace plait {

// The word of a child in its group.
using OgawaWord = uint64_t;

class OgawaWriter {
  public:
    explicit OgawaWriter(NewFile& file) : file_(file) {}

    Status begin(); // the header
    // Data made of parts, one after the other.
    Result<OgawaWord> data(std::initializer_list<std::span<const std::byte>> parts);
    Result<OgawaWord> group(std::span<const OgawaWord> children);
    Status end(OgawaWord root);

  private:
    NewFile& file_;
};

} // namespace plait
