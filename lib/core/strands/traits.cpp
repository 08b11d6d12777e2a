#include "core/strands/traits.hpp"

#include "base/format.hpp"

#include <vector>

namespace plait {

std::string list_models(bool ModelTraits::*has) {
    std::vector<std::string> names;
    for (const ModelTraits& row : model_table)
        if (row.*has)
            names.push_back(format("%s (%d)", row.name, row.model));
    std::string list;
    for (size_t i = 0; i < names.size(); ++i)
        list += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
    return list;
}

} // namespace plait
