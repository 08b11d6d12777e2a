// A page of results: device, driver, date, the accuracy table, the figures, the features.
#pragma once

#include "chart.hpp"
#include "features.hpp"

namespace lab {

// Writes <folder>/lab-<device>.md and copies the figures beside it; the files written.
std::vector<std::string> write_page(const std::string& folder, const AccuracyRun& accuracy,
                                    const ChartRun& charts, const FeatureRun& features,
                                    const std::string& figures);

std::string slug(const std::string& name); // "Intel(R) Xeon" -> "intel-r-xeon"

} // namespace lab
