#include "disturb.hpp"

#include <algorithm>
#include <cstring>
#include <sstream>

namespace plait::conformance {
namespace {

using cases::Case;
using cases::Field;
using cases::FieldKind;
using cases::Outputs;
using cases::Setup;

struct BufferComponents {
    const char* argument;
    const char* components;
};
constexpr BufferComponents all_buffers[] = {
#define PLAIT_BUFFER(name, when, extent, components) {#name, components},
#include <plait/buffers.def>
};

// Components in the order they lie in, "-" for one that no stage may read, "a/b" for one that is b
// in the last row.
std::vector<std::string> words_of(const char* argument) {
    const auto found = std::find_if(
        std::begin(all_buffers), std::end(all_buffers),
        [&](const BufferComponents& l) { return std::strcmp(l.argument, argument) == 0; });
    std::istringstream text(found == std::end(all_buffers) ? "" : found->components);
    std::vector<std::string> words;
    for (std::string word; text >> word;)
        words.push_back(word);
    return words;
}

std::vector<plait_stage_arg> buffers_of(plait_stage stage) {
    const plait_stage_info& info = *plait_stage_describe(stage);
    std::vector<plait_stage_arg> buffers(info.args, info.args + info.arg_count);
    std::erase_if(buffers,
                  [](const plait_stage_arg& arg) { return arg.access == PLAIT_ACCESS_LOCAL; });
    return buffers;
}

// Floats of one strand, if the component is a coordinate of positions in world or rest space, of
// which the stage reads more than the root.
size_t row_of(const Setup& setup, const Case& stage_case, const Component& component) {
    const bool strands =
        component.name.compare(0, 8, "position") == 0 ||
        (component.name.compare(0, 5, "rest.") == 0 &&
         plait_stage_describe(stage_case.stage)->space != PLAIT_SPACE_LANES &&
         stage_case.stage != PLAIT_STAGE_skin && stage_case.stage != PLAIT_STAGE_skin_mesh);
    uint32_t stride; // the first field of every parameter struct but two, or one of its own
    size_t at = 0;
    for (const Field& field : cases::fields_of(plait_stage_describe(stage_case.stage)->params_type))
        if (std::strcmp(field.name, "row_stride") == 0)
            at = field.offset;
    std::memcpy(&stride, setup.params.data() + at, sizeof stride);
    return strands ? size_t{4} * stride : 0;
}

// Whether float `i` of a buffer of lanes is in these rows of its strand.
bool is_in(const Setup& setup, const Component& component, size_t i) {
    if (component.rows == Rows::all)
        return true;
    uint32_t stride; // the first field of every parameter struct of a stage over lanes
    std::memcpy(&stride, setup.params.data(), sizeof stride);
    const bool last = i / component.period % stride + 1 == stride;
    return last == (component.rows == Rows::last);
}

} // namespace

void disturb(Setup& setup, const Field& field, size_t word) {
    std::byte* at = setup.params.data() + field.offset + 4 * word;
    if (field.kind == FieldKind::real || field.kind == FieldKind::vector) {
        float value;
        std::memcpy(&value, at, sizeof value);
        value *= 1.01f;
        std::memcpy(at, &value, sizeof value);
        return;
    }
    uint32_t value;
    std::memcpy(&value, at, sizeof value);
    value = field.kind == FieldKind::choice ? value ^ 1u : value + 1;
    std::memcpy(at, &value, sizeof value);
}

std::vector<Component> components_of(const Case& stage_case) {
    std::vector<Component> components;
    const auto buffers = buffers_of(stage_case.stage);
    for (size_t i = 0; i < buffers.size(); ++i) {
        if (buffers[i].element == PLAIT_ELEMENT_UINT || buffers[i].access == PLAIT_ACCESS_WRITE)
            continue;
        const auto words = words_of(buffers[i].name);
        for (size_t place = 0; place < words.size(); ++place)
            if (const std::string& word = words[place]; word != "-") {
                const auto add = [&](const std::string& name, Rows rows) {
                    components.push_back(
                        {std::string(buffers[i].name) + "." + name, i, place, words.size(), rows});
                };
                const size_t slash = word.find('/');
                add(word.substr(0, slash),
                    slash == std::string::npos ? Rows::all : Rows::all_but_last);
                if (slash != std::string::npos)
                    add(word.substr(slash + 1), Rows::last);
            }
    }
    return components;
}

bool has(const std::vector<std::string>& names, const std::string& component) {
    return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
        return component == name || component.rfind(name + ".", 0) == 0;
    });
}

bool disturb(Setup& setup, const Case& stage_case, const Component& component) {
    std::vector<float>& floats = setup.buffers[component.buffer].floats;
    const std::vector<float> before = floats;
    const size_t row = row_of(setup, stage_case, component);
    const bool flag = has(stage_case.flags, component.name);
    const size_t items = has(stage_case.ratios, component.name) ? 2 : 1;
    for (size_t i = component.place; i < floats.size(); i += items * component.period) {
        if (!is_in(setup, component, i))
            continue;
        const float about = row > 0 ? before[i / row * row + component.place] : 0;
        floats[i] = flag ? (before[i] == 0 ? 1.0f : 0.0f) : about + (before[i] - about) * 1.01f;
    }
    return !floats.empty() && // bit for bit, as some are NaN
           std::memcmp(floats.data(), before.data(), 4 * floats.size()) != 0;
}

void forgive(const Case& stage_case, const Setup& original, const Setup& disturbed,
             const Outputs& expected, Outputs& got) {
    const auto buffers = buffers_of(stage_case.stage);
    for (size_t i = 0; i < got.size(); ++i)
        for (size_t k = 0; k < got[i].floats.size(); ++k) {
            const float given = disturbed.buffers[i].floats[k];
            if (buffers[i].access == PLAIT_ACCESS_READ ||
                (given != original.buffers[i].floats[k] && got[i].floats[k] == given))
                got[i].floats[k] = expected[i].floats[k];
        }
}

} // namespace plait::conformance
