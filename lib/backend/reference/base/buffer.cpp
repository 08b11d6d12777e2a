#include "backend/reference/base/buffer.hpp"

#include <algorithm>
#include <limits>

namespace plait::reference {
namespace {

// Contents are undefined until written: make reading them show.
constexpr double unwritten_float = std::numeric_limits<double>::quiet_NaN();
constexpr uint32_t unwritten_uint = 0xcdcdcdcdu;

void load(double& to, const float* from) {
    to = *from;
}
void load(uint32_t& to, const uint32_t* from) {
    to = *from;
}
void load(Vec4& to, const float* from) {
    to = Eigen::Map<const Eigen::Vector4f>(from).cast<double>();
}

void store(float* to, double from) {
    *to = static_cast<float>(from);
}
void store(uint32_t* to, uint32_t from) {
    *to = from;
}
void store(float* to, const Vec4& from) {
    Eigen::Map<Eigen::Vector4f>{to} = from.cast<float>();
}

// What one element looks like to the caller: `width` scalars of type Scalar.
template <typename T> struct Outside {
    using Scalar = float;
    static constexpr size_t width = 1;
};
template <> struct Outside<Vec4> {
    using Scalar = float;
    static constexpr size_t width = 4;
};
template <> struct Outside<uint32_t> {
    using Scalar = uint32_t;
    static constexpr size_t width = 1;
};

} // namespace

Buffer::Storage Buffer::make_storage(const plait_buffer_desc& desc,
                                     std::pmr::memory_resource* memory) {
    switch (desc.element) {
    case PLAIT_ELEMENT_FLOAT4:
        return std::pmr::vector<Vec4>(desc.count, Vec4::Constant(unwritten_float), memory);
    case PLAIT_ELEMENT_UINT:
        return std::pmr::vector<uint32_t>(desc.count, unwritten_uint, memory);
    default:
        return std::pmr::vector<double>(desc.count, unwritten_float, memory);
    }
}

Buffer::Buffer(const plait_buffer_desc& desc, std::pmr::memory_resource* memory)
    : name_(desc.name ? desc.name : "unnamed", memory), storage_(make_storage(desc, memory)) {}

size_t Buffer::size() const {
    return std::visit([](const auto& elements) { return elements.size(); }, storage_);
}

void Buffer::write(size_t first, size_t count, const void* src) {
    std::visit(
        [=](auto& elements) {
            using Form = Outside<typename std::decay_t<decltype(elements)>::value_type>;
            const auto* from = static_cast<const typename Form::Scalar*>(src);
            for (size_t i = 0; i < count; ++i)
                load(elements[first + i], from + i * Form::width);
        },
        storage_);
}

void Buffer::read(size_t first, size_t count, void* dst) const {
    std::visit(
        [=](const auto& elements) {
            using Form = Outside<typename std::decay_t<decltype(elements)>::value_type>;
            auto* to = static_cast<typename Form::Scalar*>(dst);
            for (size_t i = 0; i < count; ++i)
                store(to + i * Form::width, elements[first + i]);
        },
        storage_);
}

} // namespace plait::reference
