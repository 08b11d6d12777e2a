#include "rows.hpp"
#include "common/json_reader.hpp"

#include "hash.hpp"

#include <filesystem>

namespace lab {

namespace {

struct Need {
    const char* name;
    const char* lacking;
    bool (*met)(const Model&);
};

constexpr Need needs[] = {
    {"bending", "does not bend", [](const Model& m) { return m.bends; }},
    {"modulus", "its stiffness has no modulus",
     [](const Model& m) { return m.bends && m.model != PLAIT_MODEL_TRESSFX; }},
    {"twist", "has no twist", [](const Model& m) { return m.twists; }},
    {"equal_masses", "has half a mass at the tip, the reference has not",
     [](const Model& m) { return !m.half_tip; }},
    {"free_tip", "holds both ends of its first segment",
     [](const Model& m) { return m.pinned == 1; }},
    {"pins", "takes no pins", [](const Model& m) { return m.pins; }},
    {"free_root", "every root is held; tests/unit/rod_energy.cpp measures its energy",
     [](const Model&) { return false; }},
    {"tip_clamp", "no tip can be clamped; tests/unit/rod_energy.cpp measures its energy",
     [](const Model&) { return false; }},
};

const Need* find_need(const std::string& name) {
    for (const Need& need : needs)
        if (name == need.name)
            return &need;
    return nullptr;
}

Variant read_variant(JsonReader in) {
    Variant variant;
    if (!in.text("name", variant.name))
        in.fail("name", "is missing");
    if (const Json* set = in.value("set"))
        variant.overrides = *set;
    in.finish();
    return variant;
}

void read_list(JsonReader& in, const char* key,
               const std::function<void(const Json&, size_t)>& each) {
    const Json* list = in.value(key);
    if (list && !list->is_array())
        in.fail(key, "is " + list->dump() + ", not a list");
    for (size_t i = 0; list && i < list->size(); ++i)
        each(*list, i);
}

Row read_row(JsonReader in, const std::filesystem::path& folder) {
    Row row;
    in.text("row", row.id);
    in.text("title", row.title);
    if (!in.text("scene", row.scene))
        in.fail("scene", "is missing: a file beside this one");
    row.scene = (folder / row.scene).string();
    read_list(in, "vary", [&](const Json& list, size_t i) {
        row.variants.push_back(read_variant(in.element(list, i, "vary")));
    });
    if (row.variants.empty())
        row.variants.emplace_back();
    read_list(in, "needs", [&](const Json& list, size_t i) {
        const std::string name = list[i].is_string() ? list[i].get<std::string>() : list[i].dump();
        if (!find_need(name))
            in.fail("needs", "has \"" + name + "\", which no model is asked for");
        row.needs.push_back(name);
    });
    if (const Json* measure = in.value("measure"))
        row.measure = *measure;
    in.flag("spread", row.spread);
    if (const Json* over = in.value("over"))
        row.over = read_variant(in.object(*over, "over"));
    if (row.over && row.spread)
        in.fail("over", "is given beside spread, which is one number of all variants");
    in.finish();
    return row;
}

} // namespace

std::string why_not(const Row& row, const Model& model) {
    for (const std::string& name : row.needs)
        if (const Need* need = find_need(name); !need->met(model))
            return need->lacking;
    return "";
}

std::vector<Row> read_rows(const std::string& file) {
    Origin origin{file, Json::object(), {}};
    const Json document = read_json(origin);
    JsonReader top(document, origin);
    std::vector<Row> rows;
    const auto folder = std::filesystem::path(file).parent_path();
    read_list(top, "rows", [&](const Json& list, size_t i) {
        rows.push_back(read_row(top.element(list, i, "rows"), folder));
    });
    top.finish();
    return rows;
}

RowScene scene_of(const Row& row, const Variant& variant) {
    Origin origin{row.scene, Json::object(), {}};
    Json document = read_json(origin);
    document.merge_patch(variant.overrides);
    document["measure"] = row.spread ? Json::array() : Json::array({row.measure});
    return {read_scene(document, origin), hash_of(document)};
}

} // namespace lab
