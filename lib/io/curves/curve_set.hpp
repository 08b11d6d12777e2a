// Curves of the objects of a file, as it gives them, become strands.
#pragma once

#include "io/curves/cubic.hpp"
#include "io/curves/matrix.hpp"
#include "io/curves/notes.hpp"
#include "io/curves/packed.hpp"
#include "io/io.hpp"

#include <string>

namespace plait {

// One object with curves. Its arrays live as long as the file's bytes. `uv` and `width` are of the whole
// object, of each curve or of each point, by their number; empty: not given.
struct CurveObject {
    std::string place; // "a.abc: /hair/strands", for messages
    CurveBasis basis = CurveBasis::LINEAR;
    CurveEnds ends = CurveEnds::INNER;
    Matrix to_world;
    double unit = 1;       // m, of points and widths, beside ReadOptions.scale
    PackedIntegers counts; // points of each curve
    PackedFloats points;   // 3 each
    PackedFloats widths;   // diameters
    PackedFloats uv;       // 2 each
    PackedFloats knots;    // of B-splines, four more than points for each curve; or empty
    PackedIntegers guide;  // of the object or each curve: whether it is a guide; or empty
    PackedIntegers group;  // of the object or each curve, or empty
    PackedIntegers id;     // of each curve, or empty
    // Of each curve what it follows: 3 ids of guides and their weights; or both empty.
    PackedIntegers guide_ids;
    PackedFloats guide_weights;
};

class StrandBuilder {
  public:
    StrandBuilder(const ReadOptions& options, uint64_t file_size)
        : options_(options), strands_(options.memory), budget_(file_size) {}

    // BAD_DATA (place, curve, value, range), UNSUPPORTED.
    Status add(const CurveObject& object);
    // BAD_DATA: none. What is to be known of them goes to `notes`.
    Result<StrandSet> finish(const std::string& file, Notes& notes);

  private:
    Status check(const CurveObject& object);
    Status check_curve(const CurveObject& object, size_t curve, size_t first, size_t points) const;
    Status add_points(const CurveObject& object, size_t curve, size_t first, size_t points);
    Status read_knots(const CurveObject& object, size_t curve, size_t first, size_t points);
    bool is_wanted(const CurveObject& object, size_t curve);
    void push(const CurveObject& object, const CurvePoint& point);
    void count_groups(const CurveObject& object);
    Status check_guides(const CurveObject& object) const;
    Status add_names(const CurveObject& object, size_t curve);
    template <typename T>
    void drop_partial(const char* what, size_t width, std::pmr::vector<T>& values, Notes& notes);

    const ReadOptions& options_;
    StrandSet strands_;
    std::vector<CurvePoint> curve_; // in hand
    std::vector<double> knots_;
    uint64_t budget_; // bytes of points that the file's size accounts for
    uint64_t taken_ = 0;
    uint64_t curves_ = 0, guides_ = 0; // of the file
    uint64_t cubic_ = 0, sharp_spans_ = 0;
    uint64_t objects_ = 0;
    bool says_guides_ = false, says_what_follows_ = false;
    Names groups_;
    int64_t last_group_ = -1;
};

} // namespace plait
