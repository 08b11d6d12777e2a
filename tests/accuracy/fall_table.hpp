// How far a strand is from the fall that a table holds: a row is a moment, t and then vertices 1 to 16.
#pragma once

#include "conformance/table.hpp"
#include "stability/one_strand.hpp"

#include <cmath>
#include <limits>

namespace plait::test {

// rms distance of all vertices but the root, m; a row comes `steps` steps after the one before, the first
// after none where its t is 0. Rows after `end` are not looked at.
inline double fall_error(OneStrand& strand, const std::string& table, int steps,
                         double end = std::numeric_limits<double>::infinity()) {
    constexpr size_t vertices = 16;
    double sum = 0, count = 0;
    for (const auto& row : read_table(table)) {
        if (row[0] > end)
            break;
        for (int i = 0; i < steps && row[0] > 0; ++i)
            strand.step();
        const auto x = strand.read(PLAIT_FIELD_POSITION);
        const size_t dimensions = (row.size() - 1) / vertices;
        for (size_t i = 0; i < vertices; ++i, ++count)
            for (size_t k = 0; k < 3; ++k) {
                const double at = k < dimensions ? row[1 + dimensions * i + k] : 0;
                sum += std::pow(double(x[i + 1][k]) - at, 2);
            }
    }
    EXPECT_GE(count, 24 * vertices) << table;
    return std::sqrt(sum / count);
}

} // namespace plait::test
