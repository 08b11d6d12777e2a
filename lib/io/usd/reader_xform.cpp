// Transforms of prims: operations by their names, in the order that xformOpOrder gives.
#include "io/usd/reader.hpp"

#include "io/words.hpp"

namespace plait {
namespace {

constexpr std::string_view RESET = "!resetXformStack!", INVERT = "!invert!", PREFIX = "xformOp:";

// What stands between the prefix and a suffix: rotateXYZ of xformOp:rotateXYZ:pivot.
std::string_view kind_of(std::string_view operation) {
    operation.remove_prefix(PREFIX.size());
    return operation.substr(0, operation.find(':'));
}

// Turns about one axis or, in the order of their letters, about three.
Matrix rotations(std::string_view axes, const double* degrees) {
    Matrix all;
    for (const char axis : axes) {
        const double angle = axes.size() == 1 ? degrees[0] : degrees[axis - 'X'];
        all = all * rotation(axis == 'X', axis == 'Y', axis == 'Z', angle);
    }
    return all;
}

// Of a unit quaternion w, x, y, z.
Matrix orientation(const double* q) {
    const double w = q[0], x = q[1], y = q[2], z = q[3], n = w * w + x * x + y * y + z * z;
    Matrix r;
    if (n == 0)
        return r;
    r.m[0] = {1 - 2 * (y * y + z * z) / n, 2 * (x * y + w * z) / n, 2 * (x * z - w * y) / n, 0};
    r.m[1] = {2 * (x * y - w * z) / n, 1 - 2 * (x * x + z * z) / n, 2 * (y * z + w * x) / n, 0};
    r.m[2] = {2 * (x * z + w * y) / n, 2 * (y * z - w * x) / n, 1 - 2 * (x * x + y * y) / n, 0};
    return r;
}

bool is_rotation(std::string_view kind) {
    constexpr std::string_view known[] = {"rotateX",   "rotateY",   "rotateZ",
                                          "rotateXYZ", "rotateXZY", "rotateYXZ",
                                          "rotateYZX", "rotateZXY", "rotateZYX"};
    return std::ranges::find(known, kind) != std::end(known);
}

// The number of values that an operation takes; 0: it is not known.
size_t value_count(std::string_view kind) {
    if (kind == "transform")
        return 16;
    if (kind == "orient")
        return 4;
    if (kind == "translate" || kind == "scale")
        return 3;
    return !is_rotation(kind) ? 0 : kind.size() == 7 ? 1 : 3;
}

Matrix matrix_of(std::string_view kind, const double* v) {
    if (kind == "translate")
        return translation(v[0], v[1], v[2]);
    if (kind == "scale")
        return scaling(v[0], v[1], v[2]);
    if (kind == "orient")
        return orientation(v);
    if (kind != "transform")
        return rotations(kind.substr(6), v);
    Matrix matrix;
    for (size_t i = 0; i < 16; ++i)
        matrix.m[i / 4][i % 4] = v[i];
    return matrix;
}

} // namespace

Result<Matrix> UsdReader::transform_of(const UsdPrim& prim) const {
    Matrix local, parent = prim.to_world;
    for (const std::string& entry : prim.operations) {
        if (entry == RESET) {
            parent = {};
            continue;
        }
        const bool invert = entry.starts_with(INVERT);
        const std::string name = entry.substr(invert ? INVERT.size() : 0);
        const auto found = prim.operands.find(name);
        const size_t count = name.starts_with(PREFIX) ? value_count(kind_of(name)) : 0;
        if (count == 0 || found == prim.operands.end() || found->second.count != count)
            return text_.bad(
                format("%s: operation \"%s\" has %zu values; allowed are operations of USD "
                       "in front of the prims that they move, with 3, 1, 4 or 16",
                       prim.path.c_str(), shown(name).c_str(),
                       found == prim.operands.end() ? 0 : found->second.count));
        const Matrix one = matrix_of(kind_of(name), found->second.values.data());
        local = (invert ? one.inverse() : one) * local;
    }
    return local * parent;
}

} // namespace plait
