// From the prims of a USD stage, as its one layer of text has them, to strands.
#pragma once

#include "io/curves/curve_set.hpp"
#include "io/usd/text.hpp"

#include <array>
#include <deque>
#include <map>

namespace plait {

// Values of curves or points; of their indices, where there are any, as many as there are of these.
struct UsdPrimvar {
    explicit UsdPrimvar(std::pmr::memory_resource* memory) : values(memory), indices(memory) {}
    ByteWriter values, indices;
};

// What the properties of one prim say.
struct UsdPrim {
    explicit UsdPrim(std::pmr::memory_resource* memory)
        : points(memory), counts(memory), widths(memory), uv(memory), guide(memory), group(memory),
          id(memory), guide_ids(memory), guide_weights(memory) {}

    std::string type, path;
    Matrix to_world; // of its parents
    // of its transform
    std::vector<std::string> operations; // in order, the last of which a point meets first
    struct Operand {
        std::array<double, 16> values{};
        size_t count = 0;
    };
    std::map<std::string, Operand> operands; // by the operation's name
    // of curves
    std::string curve_type = "cubic", basis = "bezier", wrap = "nonperiodic"; // USD's defaults
    ByteWriter points, counts;
    UsdPrimvar widths, uv, guide, group, id, guide_ids, guide_weights;
};

class UsdReader {
  public:
    UsdReader(std::string_view text, const std::string& file, const ReadOptions& options)
        : text_(text, file), memory_(options.memory), strands_(options, text.size()) {}

    // BAD_DATA, UNSUPPORTED.
    Result<StrandSet> read(Notes& notes);

  private:
    static constexpr uint32_t MOST_LEVELS = 128, MOST_OPERATIONS = 64;

    Status read_stage();
    Status read_up_axis();
    Status read_prim(const Matrix& to_world, const std::string& path, uint32_t level);
    Status skip_over(const std::string& path);
    Status read_body(UsdPrim& prim, uint32_t level);
    Status read_prim_metadata(const std::string& path, bool& active);
    Status read_property(UsdPrim& prim, std::string_view type);
    template <typename Parse>
    Status read_value(const UsdPrim& prim, bool samples, const Parse& parse);
    // reader_curves.cpp
    Status take_property(UsdPrim& prim, std::string_view name, bool samples, bool& taken);
    Status take_curves(UsdPrim& prim, std::string_view name, bool samples, bool& taken);
    Status take_token(const UsdPrim& prim, std::string& to);
    Status take_order(UsdPrim& prim);
    Status add_curves(UsdPrim& prim, const Matrix& to_world);
    Status expand(const UsdPrim& prim, std::string_view name, UsdPrimvar& of, size_t width);
    // reader_xform.cpp
    Result<Matrix> transform_of(const UsdPrim& prim) const;

    UsdText text_;
    std::pmr::memory_resource* memory_;
    StrandBuilder strands_;
    double metres_per_unit_ = 0.01; // USD's default
    bool says_unit_ = false, says_up_ = false, z_up_ = false;
    Names unused_, other_prims_, moving_, composed_;
};

} // namespace plait
