#include "common/params_list.hpp"

#include "common/failure.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <iterator>
#include <string>

namespace common {

namespace {

std::string text_of(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", number);
    return text;
}

// Of one component.
std::string text_of(const plait_param_info& info, double value) {
    if (value > info.most)
        return "of the model"; // PLAIT_BDF2_OF_MODEL
    return info.choices ? info.choices[static_cast<size_t>(value)] : text_of(value);
}

std::string default_of(const plait_param_info& info) {
    const double* const first = info.default_value;
    const double* const last = first + std::min(info.count, 3u);
    std::string text = text_of(info, *first);
    if (!std::all_of(first, last, [&](double value) { return value == *first; }))
        for (const double* next = first + 1; next != last; ++next)
            text += ", " + text_of(info, *next);
    return text;
}

std::string range_of(const plait_param_info& info) {
    std::string text;
    if (info.choices) {
        for (size_t i = 0; i <= static_cast<size_t>(info.most); ++i)
            text.append(i ? ", " : "").append(info.choices[i]);
        return text;
    }
    text += info.least_excluded ? '(' : '[';
    return text.append(text_of(info.least) + ", " + text_of(info.most)) + ']';
}

using Row = std::array<std::string, 5>;

Row row_of(const plait_param_info& info) {
    std::string name = info.name;
    if (info.count > 1)
        name.append("[").append(std::to_string(info.count)).append("]");
    return {name, default_of(info), range_of(info), info.unit, info.feature};
}

} // namespace

std::vector<plait_param_info> all_params() {
    size_t count = 0;
    check(plait_params_list(nullptr, &count));
    std::vector<plait_param_info> list(count, plait_param_info_defaults());
    check(plait_params_list(list.data(), &count));
    return list;
}

void print_params() {
    const std::vector<plait_param_info> params = all_params();
    std::vector<Row> rows{{"parameter", "default", "range", "unit", "feature"}};
    std::transform(params.begin(), params.end(), std::back_inserter(rows), row_of);
    std::array<int, 5> widths{};
    for (const Row& row : rows)
        for (size_t i = 0; i < row.size(); ++i)
            widths[i] = std::max(widths[i], static_cast<int>(row[i].size()));
    for (size_t i = 0; i < rows.size(); ++i) {
        const Row& row = rows[i];
        std::printf("%-*s  %-*s  %-*s  %-*s  %s\n", widths[0], row[0].c_str(), widths[1],
                    row[1].c_str(), widths[2], row[2].c_str(), widths[3], row[3].c_str(),
                    row[4].c_str());
        if (i > 0)
            std::printf("    %s\n", params[i - 1].text);
    }
}

} // namespace common
