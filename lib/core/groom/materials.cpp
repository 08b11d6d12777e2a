#include "core/groom/materials.hpp"

#include "core/base/ranges.hpp"

namespace plait {

plait_material default_material() {
    return {sizeof(plait_material), 5e-6f,        4.7e-9f, 0, 0, 1,           1, 1,
            {1, 1, 1, 1},           {1, 1, 1, 1}, 1,       1, 0, {1, 1, 1, 1}};
}

Status check_material(const plait_material& s) {
    PLAIT_RANGE(line_density, double(1e-9f), 1e3);
    PLAIT_RANGE(bend_stiffness, 0, 1e3);
    PLAIT_RANGE(stretch_stiffness, 0, 1e9);
    PLAIT_RANGE(twist_stiffness, 0, 1e3);
    PLAIT_RANGE(section_ratio, double(1e-3f), 1e3);
    PLAIT_RANGE(curl, 0, 4);
    PLAIT_RANGE(clamp_stiffness, 0, 100);
    for (const float& knot : s.stiffness_ramp)
        PLAIT_TRY(check_range(format("stiffness_ramp[%td]", &knot - s.stiffness_ramp).c_str(),
                              double(knot), 0, 100));
    for (const float& knot : s.density_ramp)
        PLAIT_TRY(check_range(format("density_ramp[%td]", &knot - s.density_ramp).c_str(),
                              double(knot), double(1e-3f), 1e3));
    PLAIT_RANGE(drag_scale, 0, 100);
    PLAIT_RANGE(friction_scale, 0, 100);
    PLAIT_RANGE(groom_stiffness, 0, 1e6);
    for (const float& knot : s.groom_ramp)
        PLAIT_TRY(check_range(format("groom_ramp[%td]", &knot - s.groom_ramp).c_str(), double(knot),
                              0, 100));
    return {};
}

namespace {

Status check_indices(const StrandMaterials& materials, size_t guides) {
    if (materials.of.size() != guides)
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("strand_material.count is %zu, the groom has %zu strands",
                            materials.of.size(), guides)};
    for (size_t i = 0; i < guides; ++i)
        if (const uint32_t index = materials.of[i]; index >= materials.table.size())
            return Error{PLAIT_INVALID_ARGUMENT,
                         format("strand_material[%zu] is %u, range is [0, %zu]", i, index,
                                materials.table.size() - 1)};
    return {};
}

} // namespace

Status check_materials(const StrandMaterials& materials, size_t guides) {
    for (size_t i = 0; i < materials.table.size(); ++i)
        if (const Status status = check_material(materials.table[i]); !status)
            return Error{status.error().code,
                         format("materials[%zu].%s", i, status.error().message.c_str())};
    return materials.of.empty() && materials.table.size() == 1 ? Status{}
                                                               : check_indices(materials, guides);
}

} // namespace plait
