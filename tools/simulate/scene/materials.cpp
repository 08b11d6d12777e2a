#include "materials.hpp"
#include "common/json_reader.hpp"
#include "read_field.hpp"

#include <algorithm>
#include <cmath>

namespace simulate {

namespace {

// Units and ranges are plait_material's.
void read_fields(JsonReader& in, plait_material& material) {
    struct Field {
        const char* key;
        float plait_material::*member;
        double least, most;
    };
    static constexpr Field fields[] = {
        {"line_density", &plait_material::line_density, 1e-9, 1e3},
        {"bend_stiffness", &plait_material::bend_stiffness, 0, 1e3},
        {"stretch_stiffness", &plait_material::stretch_stiffness, 0, 1e9},
        {"twist_stiffness", &plait_material::twist_stiffness, 0, 1e3},
        {"section_ratio", &plait_material::section_ratio, 1e-3, 1e3},
        {"curl", &plait_material::curl, 0, 4},
        {"clamp_stiffness", &plait_material::clamp_stiffness, 0, 100},
        {"drag_scale", &plait_material::drag_scale, 0, 100},
        {"friction_scale", &plait_material::friction_scale, 0, 100},
        {"groom_stiffness", &plait_material::groom_stiffness, 0, 1e6}};
    for (const Field& field : fields)
        in.number(field.key, material.*field.member, field.least, field.most);
    in.numbers("stiffness_ramp", material.stiffness_ramp, 0, 100);
    in.numbers("density_ramp", material.density_ramp, 1e-3, 1e3);
    in.numbers("groom_ramp", material.groom_ramp, 0, 100);
}

// A strand, or [first, last].
std::array<uint32_t, 2> read_range(JsonReader& in, const Json& value, const std::string& key) {
    const auto index = [&](const Json& number) {
        if (!number.is_number_integer() || number < 0 || number > 999999)
            in.fail(key, "is " + value.dump() +
                             ", neither a strand in [0,999999] nor a first and a last one");
        return number.get<uint32_t>();
    };
    if (!value.is_array())
        return {index(value), index(value)};
    if (value.size() != 2)
        in.fail(key, "is " + value.dump() + ", not a first and a last strand");
    const std::array<uint32_t, 2> range{index(value[0]), index(value[1])};
    if (range[0] > range[1])
        in.fail(key, "is " + value.dump() + ", whose first strand comes after its last");
    return range;
}

void read_strands(JsonReader& in, MaterialChoice& choice) {
    const Json* list = in.value("strands");
    if (!list)
        return;
    if (!list->is_array())
        in.fail("strands", "is " + list->dump() + ", not a list of strands and [first, last]");
    choice.strands.emplace();
    for (size_t i = 0; i < list->size(); ++i)
        choice.strands->push_back(read_range(in, (*list)[i], "strands[" + std::to_string(i) + "]"));
}

void read_roots(JsonReader& in, MaterialChoice& choice) {
    const Json* value = in.value("roots");
    if (!value)
        return;
    JsonReader roots = in.object(*value, "roots");
    RootRegion region;
    if (!roots.numbers("at", region.at, -1e6, 1e6))
        roots.fail("at", "is missing: the middle of the region, m");
    if (!roots.number("radius", region.radius, 0, 1e6))
        roots.fail("radius", "is missing: roots within it take the material, m");
    roots.finish();
    choice.roots = region;
}

// In [0, 1), the same for a strand of a material whatever else there is: splitmix64 of what it is.
double drawn(uint64_t seed, size_t material, size_t strand) {
    uint64_t z = seed * 0x9e3779b97f4a7c15u + (uint64_t{material} << 32) + strand;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

bool names(const MaterialChoice& choice, uint32_t strand, const float* root) {
    const auto holds = [&](const auto& range) { return strand >= range[0] && strand <= range[1]; };
    if (choice.strands && std::ranges::none_of(*choice.strands, holds))
        return false;
    if (!choice.roots)
        return true;
    const auto& [at, radius] = *choice.roots;
    return std::hypot(root[0] - at[0], root[1] - at[1], root[2] - at[2]) <= radius;
}

void check_strands(const MaterialChoice& choice, size_t count) {
    if (!choice.strands)
        return;
    for (const auto& [first, last] : *choice.strands)
        if (last >= count)
            throw Failure(choice.place + ".strands has " + std::to_string(last) +
                          ", the groom's strands are [0," + std::to_string(count - 1) + "]");
}

} // namespace

std::vector<MaterialChoice> read_materials(JsonReader& top, const plait_material& usual) {
    std::vector<MaterialChoice> list;
    top.each("materials", [&](JsonReader in) {
        MaterialChoice choice;
        choice.material = usual;
        if (!in.text("name", choice.name) || choice.name.empty())
            in.fail("name", "is missing: what the material is called");
        if (std::ranges::find(list, choice.name, &MaterialChoice::name) != list.end())
            in.fail("name", "is \"" + choice.name + "\", as that of a material before");
        choice.place = in.place("");
        read_fields(in, choice.material);
        read_strands(in, choice);
        read_roots(in, choice);
        in.number("share", choice.share, 0, 1);
        in.finish();
        list.push_back(std::move(choice));
    });
    return list;
}

std::vector<uint32_t> strand_materials(const std::vector<MaterialChoice>& materials,
                                       const plait_groom* groom, uint64_t seed) {
    if (materials.empty())
        return {};
    const auto positions = read_field<float>(groom, PLAIT_GROOM_FIELD_POSITIONS);
    const auto counts = read_field<uint32_t>(groom, PLAIT_GROOM_FIELD_VERTEX_COUNTS);
    std::vector<uint32_t> taken(counts.size(), static_cast<uint32_t>(materials.size()));
    for (size_t m = 0; m < materials.size(); ++m) {
        const MaterialChoice& choice = materials[m];
        check_strands(choice, counts.size());
        bool any = false;
        size_t root = 0; // a vertex
        for (uint32_t strand = 0; strand < counts.size(); root += counts[strand++]) {
            if (!names(choice, strand, &positions[3 * root]) ||
                drawn(seed, m, strand) >= double(choice.share))
                continue;
            taken[strand] = static_cast<uint32_t>(m);
            any = true;
        }
        if (!any)
            throw Failure(choice.place + " (\"" + choice.name + "\") is of no strand: none of " +
                          std::to_string(counts.size()) +
                          " is in its strands, its roots and its share");
    }
    return taken;
}

} // namespace simulate
