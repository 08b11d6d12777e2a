// TressFX skin: the names of bones, then for each strand the bones that move its root.
#include "io/formats.hpp"

#include <algorithm>
#include <cmath>

namespace plait {
namespace {

constexpr uint64_t INFLUENCES = 4;                   // per strand
constexpr uint64_t STRAND_SIZE = 4 + INFLUENCES * 8; // i32 strand, 4 x {i32 bone, f32 weight}
constexpr uint64_t BONE_SIZE = 8;                    // i32 bone, i32 length; then the name
constexpr uint32_t MAX_BONES = 1 << 20;              // written; a mistaken index costs no gigabytes

// Signed in the file; a negative count shows as one above 2^31 and fails against the file's size.
Result<uint32_t> read_count(const ByteReader& file, const char* what, uint64_t& at,
                            uint64_t element) {
    PLAIT_TRY(file.check_range(what, at, at, 1, 4));
    const uint32_t count = file.u32(at);
    PLAIT_TRY(file.check_range(what, at, at + 4, count, element));
    at += 4;
    return count;
}

// plait's bones are numbers, so the names are stepped over. Returns the number of bones.
Result<uint32_t> skip_bones(const ByteReader& file, uint64_t& at) {
    auto bones = read_count(file, "bones", at, BONE_SIZE);
    PLAIT_TRY(bones);
    if (*bones == 0)
        return file.bad(0, "number of bones is 0; allowed 1 to 2147483647");
    for (uint32_t b = 0; b < *bones; ++b) {
        PLAIT_TRY(file.check_range("bone", at, at, 1, BONE_SIZE));
        if (file.u32(at) != b)
            return file.bad(at, format("index of bone %" PRIu32 " is %" PRId32, b,
                                       static_cast<int32_t>(file.u32(at))));
        at += 4;
        auto length = read_count(file, "bone name", at, 1);
        PLAIT_TRY(length);
        at += *length;
    }
    return bones;
}

// An influence of weight 0 may name no bone (-1); it is stored as bone 0.
Result<uint32_t> read_bone(const ByteReader& file, uint64_t at, float weight, uint32_t bones) {
    const uint32_t bone = file.u32(at);
    if (bone < bones)
        return bone;
    if (weight == 0.0f)
        return uint32_t{0};
    return file.bad(at, format("bone index is %" PRId32 "; allowed 0 to %" PRIu32,
                               static_cast<int32_t>(bone), bones - 1));
}

// Files keep the four largest of possibly more weights, so a sum below 1 is usual (0.92 in AMD's
// sample): they are scaled to sum 1, unless they do to within what rounding leaves.
Status read_influences(const ByteReader& file, uint64_t at, uint32_t bones, uint32_t* indices,
                       float* weights) {
    double sum = 0;
    for (uint64_t i = 0; i < INFLUENCES; ++i) {
        const uint64_t here = at + 8 * i;
        weights[i] = file.f32(here + 4);
        if (!(weights[i] >= 0.0f && weights[i] <= 1.0f))
            return file.bad(here + 4, format("bone weight is %g; allowed 0 to 1",
                                             static_cast<double>(weights[i])));
        auto bone = read_bone(file, here, weights[i], bones);
        PLAIT_TRY(bone);
        indices[i] = *bone;
        sum += static_cast<double>(weights[i]);
    }
    if (!(sum > 0))
        return file.bad(at + 4, "the bone weights of a strand sum to 0; allowed above 0");
    if (std::abs(sum - 1) <= 1e-6)
        return {};
    for (uint64_t i = 0; i < INFLUENCES; ++i)
        weights[i] = static_cast<float>(static_cast<double>(weights[i]) / sum);
    return {};
}

} // namespace

Status read_tfxbone(const ByteReader& file, StrandSet& strands) {
    uint64_t at = 0;
    auto bones = skip_bones(file, at);
    PLAIT_TRY(bones);
    const uint64_t count_at = at;
    auto count = read_count(file, "strands", at, STRAND_SIZE);
    PLAIT_TRY(count);
    const size_t expected = strands.vertex_counts.size();
    if (*count != expected)
        return file.bad(count_at, format("number of strands is %" PRIu32 "; the strands are %zu",
                                         *count, expected));
    strands.bone_indices.resize(expected * INFLUENCES);
    strands.bone_weights.resize(expected * INFLUENCES);
    for (uint32_t s = 0; s < *count; ++s, at += STRAND_SIZE) {
        if (file.u32(at) != s)
            return file.bad(at, format("index of strand %" PRIu32 " is %" PRId32, s,
                                       static_cast<int32_t>(file.u32(at))));
        PLAIT_TRY(read_influences(file, at + 4, *bones, &strands.bone_indices[s * INFLUENCES],
                                  &strands.bone_weights[s * INFLUENCES]));
    }
    return {};
}

Result<ByteVector> write_tfxbone(const StrandSet& strands) {
    const uint32_t highest =
        *std::max_element(strands.bone_indices.begin(), strands.bone_indices.end());
    if (highest >= MAX_BONES)
        return Error{PLAIT_UNSUPPORTED, format("bone index is %" PRIu32 "; allowed 0 to %" PRIu32,
                                               highest, MAX_BONES - 1)};
    const uint32_t bones = highest + 1;
    ByteWriter out(strands.positions.get_allocator().resource());
    out.u32(bones);
    for (uint32_t b = 0; b < bones; ++b) {
        const std::string name = format("bone_%" PRIu32, b);
        out.u32(b);
        out.u32(static_cast<uint32_t>(name.size() + 1));
        out.text(name);
        out.zeros(1);
    }
    out.u32(static_cast<uint32_t>(strands.vertex_counts.size()));
    for (uint32_t s = 0; s < strands.vertex_counts.size(); ++s) {
        out.u32(s);
        for (uint64_t i = s * INFLUENCES; i < (s + 1) * INFLUENCES; ++i) {
            out.u32(strands.bone_indices[i]);
            out.f32(strands.bone_weights[i]);
        }
    }
    return std::move(out).take();
}

} // namespace plait
