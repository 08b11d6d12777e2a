// Transforms: operations, each with its values, the last of which a point meets first.
#include "io/alembic/reader.hpp"

#include <optional>

namespace plait {
namespace {

enum Operation { SCALE, TRANSLATE, ROTATE, MATRIX, ROTATE_X, ROTATE_Y, ROTATE_Z, OPERATIONS };

constexpr size_t VALUES[OPERATIONS] = {3, 3, 4, 16, 1, 1, 1};

Matrix matrix_of(size_t operation, const double* v) {
    Matrix matrix;
    switch (operation) {
    case SCALE:
        return scaling(v[0], v[1], v[2]);
    case TRANSLATE:
        return translation(v[0], v[1], v[2]);
    case ROTATE:
        return rotation(v[0], v[1], v[2], v[3]);
    case ROTATE_X:
        return rotation(1, 0, 0, v[0]);
    case ROTATE_Y:
        return rotation(0, 1, 0, v[0]);
    case ROTATE_Z:
        return rotation(0, 0, 1, v[0]);
    default:
        for (size_t i = 0; i < 16; ++i)
            matrix.m[i / 4][i % 4] = v[i];
        return matrix;
    }
}

} // namespace

Result<Matrix> AlembicReader::read_xform(const AlembicObject& object, const Matrix& parent,
                                         const std::string& place) {
    std::optional<AlembicProperty> operations, values, inherits;
    auto properties = archive_.properties_of(object);
    PLAIT_TRY(properties);
    PLAIT_TRY(archive_.properties(*properties, [&](const AlembicProperty& schema) -> Status {
        if (schema.name != ".xform" || schema.type != AlembicType::COMPOUND)
            return {};
        return archive_.properties(schema.group, [&](const AlembicProperty& property) -> Status {
            if (property.name == ".ops")
                operations = property;
            if (property.name == ".vals")
                values = property;
            if (property.name == ".inherits")
                inherits = property;
            return {};
        });
    }));
    Matrix base = parent;
    if (inherits) {
        auto inherit = samples_.integers(place, *inherits);
        PLAIT_TRY(inherit);
        if (inherit->size() == 1 && (*inherit)[0] == 0)
            base = {};
    }
    if (!operations || !values)
        return base;
    auto codes = samples_.integers(place, *operations);
    PLAIT_TRY(codes);
    auto data = samples_.doubles(place, *values);
    PLAIT_TRY(data);
    if (!values->constant)
        moving_.add(object.name);
    Matrix local;
    uint64_t left = data->size / 8, at = data->at;
    for (size_t i = 0; i < codes->size(); ++i) {
        const auto operation = static_cast<size_t>((*codes)[i]) >> 4;
        if (operation >= OPERATIONS || VALUES[operation] > left)
            return Error{PLAIT_BAD_DATA,
                         format("%s: operation %zu of the transform is %zu, with %" PRIu64
                                " values left; allowed are 0 to 6, which take 3, 3, 4, 16, 1, 1, 1",
                                place.c_str(), i, operation, left)};
        double taken[16];
        for (size_t k = 0; k < VALUES[operation]; ++k, at += 8, --left)
            taken[k] = file_.f64(at);
        local = matrix_of(operation, taken) * local;
    }
    return local * base;
}

} // namespace plait
