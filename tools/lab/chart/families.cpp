#include "chart.hpp"

#include "common/json_reader.hpp"
#include "metrics/metrics.hpp"
#include "references/continuum.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <sstream>

namespace lab {

namespace {

constexpr const char* every_model = "models"; // of the library, in each of its settings

// "rod 4x2 BDF2", or "verlet auto": with as many substeps as it needs.
Method read_method(JsonReader& in, const Json& text) {
    const std::string method = text.is_string() ? text.get<std::string>() : text.dump();
    std::istringstream words(method);
    std::string model, setting, scheme;
    words >> model >> setting >> scheme;
    const Model* known = find_model(model);
    Setting s{0, 1, scheme == "BDF2"};
    const bool fine = (setting == "auto" && known && known->longest_step) ||
                      std::sscanf(setting.c_str(), "%ux%u", &s.substeps, &s.iterations) == 2;
    if (!known || !fine || (!scheme.empty() && !s.bdf2))
        in.fail("methods", "has \"" + method + "\", which is none like \"rod 4x2 BDF2\"");
    return {known, s};
}

std::vector<uint32_t> read_segments(JsonReader& in, const Json& list) {
    const auto has_places = [](const Json& n) {
        return n.is_number_unsigned() && n > 0 && n < 256 && n.get<uint32_t>() % places == 0;
    };
    if (!list.is_array() || !std::all_of(list.begin(), list.end(), has_places))
        in.fail("segments", "is " + list.dump() + ", not a list of multiples of " +
                                std::to_string(places) + " below 256");
    return list.get<std::vector<uint32_t>>();
}

// A list of methods, or the name of one of the table's lists.
std::vector<Method> read_methods(JsonReader& in, const Json& given, const Json& lists) {
    const Json* list = &given;
    if (given.is_string()) {
        const auto named = lists.find(given.get<std::string>());
        if (named == lists.end())
            in.fail("methods", "is " + given.dump() + ", none of the lists that are named above");
        list = &*named;
    }
    if (!list->is_array())
        in.fail("methods", "is " + list->dump() + ", not a list");
    std::vector<Method> methods;
    for (const Json& text : *list) {
        if (text != every_model) {
            methods.push_back(read_method(in, text));
            continue;
        }
        const auto all = methods_of({}, false, true);
        methods.insert(methods.end(), all.begin(), all.end());
    }
    return methods;
}

Family read_family(JsonReader in, const std::filesystem::path& folder, const Json& lists) {
    Family family;
    if (!in.text("name", family.name))
        in.fail("name", "is missing: of the files it makes");
    in.text("title", family.title);
    if (!in.text("scene", family.scene))
        in.fail("scene", "is missing: a file beside this one");
    family.scene = (folder / family.scene).string();
    if (const Json* set = in.value("set"))
        family.overrides = *set;
    if (const Json* needs = in.value("needs"))
        family.needs = needs->get<std::vector<std::string>>();
    if (const Json* segments = in.value("segments"))
        family.segments = read_segments(in, *segments);
    if (const Json* methods = in.value("methods"))
        family.methods = read_methods(in, *methods, lists);
    if (in.text("metric", family.metric) && !is_metric(family.metric))
        in.fail("metric", "is \"" + family.metric + "\", none of " + metric_list());
    in.finish();
    return family;
}

} // namespace

std::vector<Family> read_families(const std::string& file) {
    Origin origin{file, Json::object(), {}};
    const Json document = read_json(origin);
    JsonReader top(document, origin);
    std::vector<Family> families;
    const Json* list = top.value("charts");
    if (!list || !list->is_array())
        top.fail("charts", "is missing or no list");
    const Json* named = top.value("methods");
    if (named && !named->is_object())
        top.fail("methods", "is " + named->dump() + ", not lists by their names");
    const Json lists = named ? *named : Json::object();
    for (size_t i = 0; i < list->size(); ++i)
        families.push_back(read_family(top.element(*list, i, "charts"),
                                       std::filesystem::path(file).parent_path(), lists));
    top.finish();
    return families;
}

} // namespace lab
