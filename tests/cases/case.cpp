#include "case.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace plait::cases {
namespace {

constexpr float unwritten = -12345.0f;

std::string describe(const char* argument, size_t element, size_t lane, double got, double expected,
                     double tolerance) {
    char text[200];
    std::snprintf(text, sizeof text, "%s[%zu].%c is %.9g, expected %.9g, off by %.2g, allowed %.2g",
                  argument, element, "xyzw"[lane], got, expected, std::abs(got - expected),
                  tolerance);
    return text;
}

bool close(double got, double expected, double tolerance) {
    if (std::isnan(expected))
        return std::isnan(got);
    return got == expected || std::abs(got - expected) <= tolerance;
}

std::string compare_elements(const char* argument, const Array& expected, const Array& got,
                             double tolerance) {
    const size_t lanes = expected.element == PLAIT_ELEMENT_FLOAT4 ? 4 : 1;
    for (size_t i = 0; i < expected.floats.size(); ++i)
        if (!close(got.floats[i], expected.floats[i], tolerance))
            return describe(argument, i / lanes, i % lanes, got.floats[i], expected.floats[i],
                            tolerance);
    for (size_t i = 0; i < expected.words.size(); ++i)
        if (got.words[i] != expected.words[i])
            return describe(argument, i, 0, got.words[i], expected.words[i], 0);
    return "";
}

std::vector<const char*> argument_names(plait_stage stage) {
    const plait_stage_info* info = plait_stage_describe(stage);
    std::vector<const char*> names;
    for (uint32_t i = 0; i < info->arg_count; ++i)
        if (info->args[i].access != PLAIT_ACCESS_LOCAL)
            names.push_back(info->args[i].name);
    return names;
}

Array make(plait_element element, std::vector<float> values) {
    Array array;
    array.element = element;
    array.floats = std::move(values);
    return array;
}

} // namespace

size_t Array::count() const {
    if (element == PLAIT_ELEMENT_UINT)
        return words.size();
    return element == PLAIT_ELEMENT_FLOAT4 ? floats.size() / 4 : floats.size();
}

Array floats(std::vector<float> values) {
    return make(PLAIT_ELEMENT_FLOAT, std::move(values));
}
Array float4s(std::vector<float> values) {
    return make(PLAIT_ELEMENT_FLOAT4, std::move(values));
}

Array uints(std::vector<uint32_t> values) {
    Array array;
    array.element = PLAIT_ELEMENT_UINT;
    array.words = std::move(values);
    return array;
}

Array lane_floats(std::vector<float> values, uint32_t components) {
    Array array = floats(std::move(values));
    array.components = components;
    return array;
}

Array null_array() {
    Array array;
    array.null = true;
    return array;
}

Array unwritten_floats(size_t count) {
    return floats(std::vector<float>(count, unwritten));
}
Array unwritten_float4s(size_t count) {
    return float4s(std::vector<float>(4 * count, unwritten));
}

std::string compare(const Case& stage_case, const Setup& setup, const Outputs& expected,
                    const Outputs& got) {
    const auto names = argument_names(stage_case.stage);
    for (size_t i = 0; i < names.size(); ++i) {
        const auto own = stage_case.compare.find(names[i]);
        const auto tolerance = stage_case.tolerance.find(names[i]);
        const std::string difference =
            own != stage_case.compare.end()
                ? own->second(setup, expected, got)
                : compare_elements(names[i], expected[i], got[i],
                                   tolerance != stage_case.tolerance.end() ? tolerance->second : 0);
        if (!difference.empty())
            return setup.name + ": " + difference;
    }
    return "";
}

} // namespace plait::cases
