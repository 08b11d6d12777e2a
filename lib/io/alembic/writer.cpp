#include "io/alembic/writer.hpp"

#include "io/curves/number.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plait {
namespace {

constexpr uint32_t LIBRARY_VERSION = 10800; // of Alembic, whose layout this is: 1.8.0

const PropertyKind POINTS{"P", "geoScope=vtx;interpretation=point", AlembicType::ARRAY,
                          AlembicPod::F32, 3};
const PropertyKind VELOCITIES{".velocities", "interpretation=vector", AlembicType::ARRAY,
                              AlembicPod::F32, 3};
const PropertyKind COUNTS{"nVertices", "", AlembicType::ARRAY, AlembicPod::I32, 1};
const PropertyKind BASIS{"curveBasisAndType", "", AlembicType::SCALAR, AlembicPod::U8, 4};
const PropertyKind BOUNDS{".selfBnds", "interpretation=box", AlembicType::SCALAR, AlembicPod::F64,
                          6};
const PropertyKind INHERITS{".inherits", "", AlembicType::SCALAR, AlembicPod::BOOL, 1};

// Metadata of a value for each curve or for all of them.
std::string parameter(const char* scope, unsigned extent, const char* interpretation) {
    return format("arrayExtent=1;geoScope=%s%s;isGeomParam=true;podExtent=%u;podName=float32_t",
                  scope, interpretation, extent);
}

template <typename T>
std::span<const std::byte> file_bytes(std::span<const T> values, ByteVector& swapped) {
    if constexpr (std::endian::native == std::endian::little)
        return std::as_bytes(values);
    swapped.clear();
    for (const T value : values) {
        const auto word = std::bit_cast<std::array<std::byte, sizeof(T)>>(value);
        swapped.insert(swapped.end(), word.rbegin(), word.rend());
    }
    return swapped;
}

std::array<double, 6> bounds_of(std::span<const float> positions) {
    constexpr float most = std::numeric_limits<float>::max();
    float least[3] = {most, most, most}, greatest[3] = {-most, -most, -most};
    for (size_t i = 0; i + 2 < positions.size(); i += 3)
        for (size_t k = 0; k < 3; ++k) {
            least[k] = std::min(least[k], positions[i + k]);
            greatest[k] = std::max(greatest[k], positions[i + k]);
        }
    return {double(least[0]),    double(least[1]),    double(least[2]),
            double(greatest[0]), double(greatest[1]), double(greatest[2])};
}

// Whether times are start + i * step, as far as anybody can tell.
bool is_even(std::span<const double> times) {
    const double step = times.size() > 1 ? times[1] - times[0] : 1;
    for (size_t i = 0; i < times.size(); ++i)
        if (!(std::abs(times[i] - times[0] - static_cast<double>(i) * step) <= 1e-6 * step))
            return false;
    return true;
}

} // namespace

Result<std::unique_ptr<ClipWriter>> AlembicClip::create(const std::string& path,
                                                        const ClipRules& rules) {
    auto file = NewFile::create(path);
    PLAIT_TRY(file);
    std::unique_ptr<AlembicClip> clip(new AlembicClip(std::move(*file), rules));
    PLAIT_TRY(clip->out_.begin());
    return std::unique_ptr<ClipWriter>(std::move(clip));
}

Status AlembicClip::begin(const ClipShape& shape) {
    vertex_counts_.assign(shape.vertex_counts.begin(), shape.vertex_counts.end());
    append_widths(shape, widths_);
    uv_.assign(shape.uv.begin(), shape.uv.end());
    return {};
}

Status AlembicClip::add_frame(double time, std::span<const float> positions) {
    ByteVector swapped(rules_.memory);
    PLAIT_TRY(add_sample(out_, positions_, POINTS.type, file_bytes(positions, swapped),
                         positions.size() / 3));
    const auto bounds = bounds_of(positions);
    PLAIT_TRY(
        add_sample(out_, bounds_, BOUNDS.type, file_bytes<double>(std::span(bounds), swapped), 1));
    times_.push_back(time);
    return {};
}

Status AlembicClip::add_velocities(std::span<const float> velocities) {
    ByteVector swapped(rules_.memory);
    return add_sample(out_, velocities_, VELOCITIES.type, file_bytes(velocities, swapped),
                      velocities.size() / 3);
}

Status AlembicClip::add_geometry(CompoundWriter& geometry, uint32_t times, uint32_t samples) {
    ByteVector swapped(rules_.memory);
    for (PropertySamples* property : {&positions_, &velocities_, &bounds_}) {
        property->times = times;
        property->changes = samples > 1;
    }
    PLAIT_TRY(geometry.add(BOUNDS, bounds_));
    PLAIT_TRY(geometry.add(POINTS, positions_));
    PLAIT_TRY(geometry.constant(COUNTS, times, samples,
                                file_bytes<uint32_t>(std::span(vertex_counts_), swapped),
                                vertex_counts_.size()));
    const std::array<std::byte, 4> linear{std::byte{1}, {}, {}, {}};
    PLAIT_TRY(geometry.constant(BASIS, times, samples, linear));
    if (!widths_.empty())
        PLAIT_TRY(geometry.constant(
            {"width", parameter("vtx", 1, ""), AlembicType::ARRAY, AlembicPod::F32, 1}, times,
            samples, file_bytes<float>(std::span(widths_), swapped), widths_.size()));
    if (!uv_.empty())
        PLAIT_TRY(geometry.constant({"uv", parameter("uni", 2, ";interpretation=vector"),
                                     AlembicType::ARRAY, AlembicPod::F32, 2},
                                    times, samples, file_bytes<float>(std::span(uv_), swapped),
                                    uv_.size() / 2));
    if (velocities_.samples > 0)
        PLAIT_TRY(geometry.add(VELOCITIES, velocities_));
    return {};
}

// An object without children.
Result<OgawaWord> AlembicClip::write_object(const std::string& schema, CompoundWriter& properties,
                                            SampleKey& hash) {
    CompoundWriter all(out_, metadata_);
    PLAIT_TRY(all.add(".geom", schema, properties));
    auto group = all.write();
    PLAIT_TRY(group);
    const SampleKey none{};
    auto headers = out_.data({all.hash(), none});
    PLAIT_TRY(headers);
    hash = all.hash();
    return out_.group(std::array{*group, *headers});
}

// The header of a child: its name, the index of its metadata; behind all of them hashes.
static ByteVector child_header(const std::string& name, uint32_t metadata, const SampleKey& own,
                               const SampleKey& below) {
    ByteWriter header(std::pmr::get_default_resource());
    header.u32(static_cast<uint32_t>(name.size()));
    header.text(name);
    header.u8(static_cast<uint8_t>(metadata));
    header.add(own);
    header.add(below);
    return std::move(header).take();
}

Result<OgawaWord> AlembicClip::write_transform(OgawaWord child, uint32_t times,
                                               const SampleKey& below) {
    CompoundWriter transform(out_, metadata_);
    const std::byte inherits{1};
    PLAIT_TRY(
        transform.constant(INHERITS, times, std::max(1u, positions_.samples), {&inherits, 1}));
    CompoundWriter all(out_, metadata_);
    PLAIT_TRY(all.add(".xform", "schema=AbcGeom_Xform_v3", transform));
    auto properties = all.write();
    PLAIT_TRY(properties);
    const uint32_t curves = metadata_.index("schema=AbcGeom_Curve_v2;schemaBaseType=AbcGeom_"
                                            "GeomBase_v1;schemaObjTitle=AbcGeom_Curve_v2:.geom");
    auto headers = out_.data({child_header("strands", curves, all.hash(), below)});
    PLAIT_TRY(headers);
    return out_.group(std::array{*properties, child, *headers});
}

ByteVector AlembicClip::time_samplings(uint32_t samples) const {
    ByteWriter out(rules_.memory);
    const auto even = [&](uint32_t most, double step, double start) {
        out.u32(most);
        out.f64(step);
        out.u32(1);
        out.f64(start);
    };
    even(rules_.moves ? 0 : samples, 1, 0); // that of what does not move
    if (!rules_.moves)
        return std::move(out).take();
    if (is_even(times_)) {
        even(samples, times_.size() > 1 ? times_[1] - times_[0] : 1 / rules_.frames_per_second,
             times_[0]);
        return std::move(out).take();
    }
    out.u32(samples);
    out.f64(std::numeric_limits<double>::max() / 32); // stands for: the times themselves
    out.u32(samples);
    for (const double time : times_)
        out.f64(time);
    return std::move(out).take();
}

Result<OgawaWord> AlembicClip::write_root(OgawaWord top) {
    ByteWriter version(rules_.memory), library(rules_.memory);
    version.u32(0);
    library.u32(LIBRARY_VERSION);
    const std::string about = format("FramesPerTimeUnit=%s;_ai_Application=plait %d.%d.%d",
                                     number_text(rules_.frames_per_second).c_str(),
                                     PLAIT_VERSION_MAJOR, PLAIT_VERSION_MINOR, PLAIT_VERSION_PATCH);
    std::vector<OgawaWord> children;
    const auto add = [&](std::span<const std::byte> bytes) -> Status {
        auto word = out_.data({bytes});
        PLAIT_TRY(word);
        children.push_back(*word);
        return {};
    };
    PLAIT_TRY(add(version.bytes()));
    PLAIT_TRY(add(library.bytes()));
    children.push_back(top);
    PLAIT_TRY(add(std::as_bytes(std::span(about))));
    PLAIT_TRY(add(time_samplings(positions_.samples)));
    PLAIT_TRY(add(metadata_.bytes()));
    return out_.group(children);
}

Status AlembicClip::commit() {
    const uint32_t times = rules_.moves ? 1 : 0;
    CompoundWriter geometry(out_, metadata_);
    PLAIT_TRY(add_geometry(geometry, times, positions_.samples));
    SampleKey hash{};
    auto curves =
        write_object("schema=AbcGeom_Curve_v2;schemaBaseType=AbcGeom_GeomBase_v1", geometry, hash);
    PLAIT_TRY(curves);
    auto transform = write_transform(*curves, times, hash);
    PLAIT_TRY(transform);
    const uint32_t schema =
        metadata_.index("schema=AbcGeom_Xform_v3;schemaObjTitle=AbcGeom_Xform_v3:.xform");
    auto headers = out_.data({child_header("hair", schema, hash, hash)});
    PLAIT_TRY(headers);
    auto top = out_.group(std::array{OgawaWord{0}, *transform, *headers});
    PLAIT_TRY(top);
    auto root = write_root(*top);
    PLAIT_TRY(root);
    PLAIT_TRY(out_.end(*root));
    return file_.commit();
}

} // namespace plait
