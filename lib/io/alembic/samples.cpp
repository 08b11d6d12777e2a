#include "io/alembic/samples.hpp"

#include "io/words.hpp"

#include <optional>

namespace plait {
namespace {

struct PodShape {
    uint32_t bytes; // 0: no integer
    bool has_sign;
};

PodShape integer_shape(AlembicPod pod) {
    switch (pod) {
    case AlembicPod::BOOL:
    case AlembicPod::U8:
        return {1, false};
    case AlembicPod::I8:
        return {1, true};
    case AlembicPod::U16:
        return {2, false};
    case AlembicPod::I16:
        return {2, true};
    case AlembicPod::U32:
        return {4, false};
    case AlembicPod::I32:
        return {4, true};
    case AlembicPod::U64:
    case AlembicPod::I64:
        return {8, true};
    default:
        return {0, false};
    }
}

Error other_type(const std::string& place, const AlembicProperty& property, const char* known) {
    return {PLAIT_UNSUPPORTED,
            format("%s: property %s has element type %u, %u of them; known is %s", place.c_str(),
                   shown(property.name).c_str(), static_cast<unsigned>(property.pod),
                   property.extent, known)};
}

} // namespace

Result<OgawaData> AlembicSamples::sample(const std::string& place, const AlembicProperty& property,
                                         uint64_t element) {
    auto data = archive_.first_sample(property);
    PLAIT_TRY(data);
    if (data->size % element != 0)
        return Error{PLAIT_BAD_DATA,
                     format("%s: property %s has %" PRIu64
                            " bytes, which is no multiple of %" PRIu64,
                            place.c_str(), shown(property.name).c_str(), data->size, element)};
    return data;
}

Result<PackedFloats> AlembicSamples::floats(const std::string& place,
                                            const AlembicProperty& property, uint32_t width) {
    if (property.type == AlembicType::COMPOUND)
        return indexed_floats(place, property, width);
    // Some programs write pairs as twice as many single values.
    if (property.pod != AlembicPod::F32 || (property.extent != width && property.extent != 1))
        return other_type(place, property, format("float32, %u of them", width).c_str());
    auto data = sample(place, property, sizeof(float) * width);
    PLAIT_TRY(data);
    return PackedFloats(archive_.bytes().data(data->at),
                        static_cast<size_t>(data->size / sizeof(float)));
}

Result<PackedFloats> AlembicSamples::indexed_floats(const std::string& place,
                                                    const AlembicProperty& compound,
                                                    uint32_t width) {
    std::optional<AlembicProperty> values, indices;
    PLAIT_TRY(archive_.properties(compound.group, [&](const AlembicProperty& property) -> Status {
        if (property.type == AlembicType::COMPOUND)
            return {};
        if (property.name == ".vals")
            values = property;
        if (property.name == ".indices")
            indices = property;
        return {};
    }));
    if (!values || !indices)
        return Error{PLAIT_BAD_DATA,
                     format("%s: property %s is a compound without .vals and .indices",
                            place.c_str(), shown(compound.name).c_str())};
    auto from = floats(place, *values, width);
    PLAIT_TRY(from);
    if (indices->pod != AlembicPod::U32)
        return other_type(place, *indices, "uint32");
    auto which = integers(place, *indices);
    PLAIT_TRY(which);
    ByteWriter out(expanded_.get_allocator().resource());
    for (size_t i = 0; i < which->size(); ++i) {
        const int64_t index = (*which)[i];
        const size_t count = from->size() / width;
        if (index < 0 || static_cast<uint64_t>(index) >= count)
            return Error{PLAIT_BAD_DATA,
                         format("%s: property %s: index %zu is %" PRId64 "; there are %zu values",
                                place.c_str(), shown(compound.name).c_str(), i, index, count)};
        for (size_t k = 0; k < width; ++k)
            out.f32((*from)[width * static_cast<size_t>(index) + k]);
    }
    const size_t count = which->size() * width;
    expanded_.push_back(std::move(out).take());
    return PackedFloats(expanded_.back().data(), count);
}

Result<PackedIntegers> AlembicSamples::integers(const std::string& place,
                                                const AlembicProperty& property) {
    const PodShape shape = integer_shape(property.pod);
    if (property.type == AlembicType::COMPOUND || shape.bytes == 0)
        return other_type(place, property, "a whole number");
    auto data = sample(place, property, shape.bytes);
    PLAIT_TRY(data);
    return PackedIntegers(archive_.bytes().data(data->at),
                          static_cast<size_t>(data->size / shape.bytes), shape.bytes,
                          shape.has_sign);
}

Result<OgawaData> AlembicSamples::doubles(const std::string& place,
                                          const AlembicProperty& property) {
    if (property.type == AlembicType::COMPOUND || property.pod != AlembicPod::F64)
        return other_type(place, property, "float64");
    return sample(place, property, sizeof(double));
}

Result<bool> AlembicSamples::is_empty(const AlembicProperty& property) {
    if (property.type == AlembicType::COMPOUND)
        return property.group.count == 0;
    auto data = archive_.first_sample(property);
    PLAIT_TRY(data);
    return data->size == 0;
}

} // namespace plait
