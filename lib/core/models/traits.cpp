#include "core/models/traits.hpp"

#include "base/format.hpp"

#include <iterator>
#include <vector>

namespace plait {
namespace {

// model, name, stage, iterations, bdf2, switches, bends, flat, stretches, halves_tip
constexpr ModelTraits table[] = {
    {PLAIT_MODEL_TRESSFX, "tressfx", PLAIT_STAGE_COUNT, 0, 0, false, false, false, false, false},
    {PLAIT_MODEL_CHAIN, "chain", PLAIT_STAGE_chain, 1, 0, true, false, false, false, false},
    {PLAIT_MODEL_COSSERAT, "cosserat", PLAIT_STAGE_cosserat, 3, 0, true, true, false, true, true},
    {PLAIT_MODEL_ROD, "rod", PLAIT_STAGE_rod, 1, 0, true, true, true, true, true},
    {PLAIT_MODEL_ARTICULATED, "articulated", PLAIT_STAGE_articulated, 1, 1, true, true, true, false,
     true},
};

constexpr bool in_order() {
    for (size_t i = 0; i < std::size(table); ++i)
        if (static_cast<size_t>(table[i].model) != i)
            return false;
    return true;
}
static_assert(in_order());

} // namespace

std::span<const ModelTraits> all_models() {
    return table;
}

std::string list_models(bool ModelTraits::*has) {
    std::vector<std::string> names;
    for (const ModelTraits& row : table)
        if (row.*has)
            names.push_back(format("%s (%d)", row.name, row.model));
    std::string list;
    for (size_t i = 0; i < names.size(); ++i)
        list += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
    return list;
}

} // namespace plait
