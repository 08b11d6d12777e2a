// Every field of every parameter struct, from fields.inc, which list_fields.cmake writes from
// params.h. What the sensitivity check does to one follows from its type; exceptions by name.
#include "case.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string_view>
#include <type_traits>
#include <utility>

namespace plait::cases {
namespace {

// uint that sizes buffers, or says where in one to begin
constexpr std::string_view of_layout[] = {
    "vertex_stride", "row_stride", "tile",     "collider_count", "collider_first",
    "guide_count",   "edge_count", "capacity", "share",          "boxes",
    "components",    "axis",       "plane",    "words",          "begins",
    "mesh",          "least",      "most",     "strand_first"};
// uint that takes one of two values
constexpr std::string_view choices[] = {
    "per_root",   "accelerates", "pins",      "planes",   "hollows",      "history", "bdf2",
    "shock_form", "form",        "slot_hash", "tent",     "diffuse_rule", "field",   "pressure",
    "moves",      "carried",     "colour",    "reversed", "turbulent",    "meshes",  "wet",
    "soaked",     "shown",       "others",    "whole",    "each"};
// float4 of which w is not used
constexpr std::string_view vectors[] = {"head_from_t", "head_to_t", "t", "wind", "corner"};

template <size_t N> bool has(const std::string_view (&names)[N], std::string_view name) {
    return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

template <typename T> FieldKind kind_of(std::string_view type, std::string_view name) {
    if (std::is_same_v<std::remove_all_extents_t<T>, float>)
        return has(vectors, name) ? FieldKind::vector : FieldKind::real;
    if (has(of_layout, name) || (type == "plait_bounds_params" && name == "count"))
        return FieldKind::layout;
    return has(choices, name) ? FieldKind::choice : FieldKind::count;
}

std::map<std::string, std::vector<Field>> all_fields() {
    std::map<std::string, std::vector<Field>> all;
    std::vector<Field> fields;
#define PLAIT_FIELD(type, field)                                                                   \
    fields.push_back({#field, offsetof(type, field), sizeof(type::field) / 4,                      \
                      kind_of<decltype(type::field)>(#type, #field)});
#define PLAIT_FIELDS_OF(type) all[#type] = std::exchange(fields, {});
#include "fields.inc"
    return all;
}

} // namespace

const std::vector<Field>& fields_of(const char* params_type) {
    static const std::map<std::string, std::vector<Field>> fields = all_fields();
    static const std::vector<Field> none;
    const auto found = fields.find(params_type);
    return found == fields.end() ? none : found->second;
}

} // namespace plait::cases
