#include "core/strands/settings.hpp"

#include <algorithm>

namespace plait {

std::pmr::vector<uint32_t> substeps_of(std::span<const Settings> settings,
                                       std::pmr::memory_resource* memory) {
    std::pmr::vector<uint32_t> list(memory);
    for (const Settings& strand : settings)
        if (std::ranges::find(list, strand.substeps) == list.end())
            list.push_back(strand.substeps);
    return list;
}

} // namespace plait
