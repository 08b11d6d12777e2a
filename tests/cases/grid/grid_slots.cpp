// The one stage whose result may differ from run to run: vertices race for slots and any of them
// may win. A slot must hold one of the vertices that hash to it, or be empty if there is none.
#include "grid/grid_inputs.hpp"

#include <algorithm>
#include <cstdio>
#include <set>

namespace plait::cases {
namespace {

enum Buffers { vertex_count, position, grid_slot };

bool is_padding(const plait_grid_params& params, const Setup& setup, uint32_t item) {
    const uint32_t stride = params.vertex_stride;
    return item % stride >= setup.buffers[vertex_count].words[item / stride];
}

std::optional<uint32_t> home(const plait_grid_params& params, const Setup& setup, uint32_t item) {
    if (is_padding(params, setup, item))
        return std::nullopt;
    return voxel_of(params, &setup.buffers[position].floats[4 * size_t{item}]);
}

std::string complain(size_t slot, uint32_t found, const char* why) {
    char text[120];
    std::snprintf(text, sizeof text, "grid_slot[%zu] holds %u: %s", slot, found, why);
    return text;
}

// pcg is exact: every slot's candidates are known.
std::string compare_pcg(const plait_grid_params& params, const Setup& setup,
                        const std::vector<uint32_t>& got) {
    std::vector<std::set<uint32_t>> candidates(got.size());
    for (uint32_t item = 0; item < setup.items; ++item)
        if (const auto voxel = home(params, setup, item))
            candidates[size_t{*voxel} * params.capacity + pcg_slot_of(params, item)].insert(item);
    for (size_t slot = 0; slot < got.size(); ++slot) {
        if (candidates[slot].empty() != (got[slot] == PLAIT_SLOT_EMPTY))
            return complain(slot, got[slot], "filled where no vertex hashes to it, or empty");
        if (!candidates[slot].empty() && !candidates[slot].count(got[slot]))
            return complain(slot, got[slot], "that vertex does not hash to it");
    }
    return "";
}

// The thesis hash is noise of the device's float32 fmod and cos, so only voxels can be compared:
// what a slot holds lives in its voxel, and a voxel is empty exactly if no vertex lives in it.
std::string compare_thesis(const plait_grid_params& params, const Setup& setup,
                           const std::vector<uint32_t>& got) {
    std::set<uint32_t> inhabited, found;
    for (uint32_t item = 0; item < setup.items; ++item)
        if (const auto voxel = home(params, setup, item))
            inhabited.insert(*voxel);
    for (size_t slot = 0; slot < got.size(); ++slot) {
        if (got[slot] == PLAIT_SLOT_EMPTY)
            continue;
        const auto voxel = static_cast<uint32_t>(slot / params.capacity);
        if (got[slot] >= setup.items || home(params, setup, got[slot]) != voxel)
            return complain(slot, got[slot], "that vertex is not in this voxel");
        found.insert(voxel);
    }
    return found == inhabited ? "" : "grid_slot: an inhabited voxel has no vertex in its slots";
}

// The parameters the comparison expects are those of the expected run.
std::string compare_slots(const Setup& setup, const Outputs&, const Outputs& got) {
    const auto params = setup.params_as<plait_grid_params>();
    return params.slot_hash == PLAIT_SLOT_HASH_PCG
               ? compare_pcg(params, setup, got[grid_slot].words)
               : compare_thesis(params, setup, got[grid_slot].words);
}

} // namespace

Case grid_slots_case() {
    Case result = {PLAIT_STAGE_grid_slots,
                   {},
                   {},
                   {"h", "tent", "diffuse_rule", "diffuse_ratio", "diffuse_factor", "diffuse_floor",
                    "position.w"},
                   {{"grid_slot", compare_slots}}};
    for (GridHair hair : make_grid_hair())
        for (uint32_t hash : {PLAIT_SLOT_HASH_PCG, PLAIT_SLOT_HASH_THESIS}) {
            hair.params.slot_hash = hash;
            Setup setup = hair.setup();
            setup.name += hash == PLAIT_SLOT_HASH_PCG ? ", pcg" : ", thesis";
            setup.items = hair.vertices();
            const size_t slots = size_t{hair.voxels()} * hair.params.capacity;
            setup.buffers = {uints(hair.vertex_count), float4s(hair.position),
                             uints(std::vector<uint32_t>(slots, PLAIT_SLOT_EMPTY)), uints({7})};
            result.setups.push_back(setup);
        }
    return result;
}

} // namespace plait::cases
