// What misses its mark of the accuracy table, and by how much, on either backend; docs/lab.md says
// why. What meets its mark again is to be struck off.
#pragma once

#include <limits>

namespace lab {

struct KnownMiss {
    const char *row, *variant, *method;
    double opencl, reference; // magnitudes
    double rounding = 1;      // how far apart kernels were that differ by rounding alone
};

constexpr double met = 0; // on this backend
constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

constexpr KnownMiss known_misses[] = {
    {"2", "Γ 1", "cosserat 1x3", 2.05, 2.05},
    {"2", "Γ 1", "cosserat 4x2 BDF2", 2.05, 2.05},
    {"2", "Γ 1", "rod 1x1", 2.05, 2.05},
    {"2", "Γ 1", "rod 2x1 BDF2", 2.05, 2.05},
    {"2", "Γ 10, N 32", "cosserat 1x3", 2.06, 1.97},
    {"2", "Γ 10, N 32", "cosserat 4x2 BDF2", 2.08, 1.97},
    {"2", "Γ 10, N 32", "rod 1x1", 1.97, 1.97},
    {"2", "Γ 10, N 32", "rod 2x1 BDF2", 1.97, 1.97},
    {"3b", "all", "cosserat 1x3", 0.0313, 0.0313},
    {"3b", "all", "cosserat 4x2 BDF2", 0.0313, 0.0313},
    {"3b", "all", "rod 1x1", 0.0313, 0.0313},
    {"3b", "all", "rod 2x1 BDF2", 0.0313, 0.0313},
    {"4", "", "chain 1x1", 0.0277, 0.0277},
    {"5", "", "chain 1x1", 0.0994, 0.0994},
    {"5", "", "chain 4x1", 0.0795, 0.0795},
    {"6a", "", "chain 1x1", 0.0156, met},
    {"6b", "", "cosserat 1x3", 0.594, 0.586, 1.5},
    {"6b", "", "cosserat 4x2 BDF2", 0.0388, 0.0266, 1.5},
    {"6b", "", "rod 1x1", met, 0.00503},
    {"7a", "", "chain 1x1", 0.0609, 0.0563},
    {"7a", "", "chain 4x1", 0.0141, 0.0141},
    {"7b", "", "cosserat 1x3", 0.208, 0.207, 1.7},
    {"7b", "", "cosserat 4x2 BDF2", 0.108, 0.123},
    {"7b", "", "rod 1x1", 0.0596, 0.0596},
    {"9a", "", "cosserat 1x3", 0.00178, 0.00178},
    {"9a", "", "cosserat 4x2 BDF2", 0.00136, 0.00136},
    {"9a", "", "rod 1x1", 0.00182, 0.00182},
    {"9a", "", "rod 2x1 BDF2", 0.00217, 0.00217},
    {"9b", "", "cosserat 1x3", 0.0151, 0.0151},
    {"9b", "", "rod 1x1", 0.0269, 0.0269},
    {"9b", "", "rod 2x1 BDF2", 0.0258, 0.0258},
    {"9c", "", "chain 1x1", 0.000218, 0.000218},
    {"9c", "", "chain 4x1", 0.000364, 0.000339},
    {"9c", "", "cosserat 1x3", 0.135, 0.135},
    {"9c", "", "cosserat 4x2 BDF2", 0.0607, 0.0606},
    {"9c", "", "rod 1x1", 0.225, 0.225},
    {"9c", "", "rod 2x1 BDF2", 0.347, 0.347},
    {"14", "Γ 10", "cosserat 1x3", 0.00578, 0.00578},
    {"14", "Γ 10", "cosserat 4x2 BDF2", 0.00578, 0.00578},
    {"14", "Γ 100", "cosserat 1x3", 0.0335, 0.0335},
    {"14", "Γ 100", "cosserat 4x2 BDF2", 0.0335, 0.0335},
    {"16b", "", "cosserat 1x3", 0.103, 0.0931},
    {"16b", "", "cosserat 4x2 BDF2", 0.0918, 0.0769},
    {"19a", "", "chain 1x1", 0.748, 0.749},
    {"19a", "", "chain 4x1", 0.0314, 0.0301},
    {"19b", "", "chain 4x1", 0.0181, 0.0179},
    {"19b", "", "cosserat 1x3", 0.00996, 0.00996},
    {"19b", "", "cosserat 4x2 BDF2", 0.00207, 0.00206},
    {"19b", "", "rod 2x1 BDF2", 0.0104, 0.0104},
    {"20", "µ 0.1", "cosserat 1x3", 0.35, 0.209, 1.5},
    {"20", "µ 0.1", "cosserat 4x2 BDF2", 0.755, 0.276, 1.5},
    {"20", "µ 0.1", "rod 2x1 BDF2", 0.138, met, 1.5},
    {"20", "µ 0.2", "cosserat 1x3", 0.41, 0.215, 1.5},
    {"20", "µ 0.2", "cosserat 4x2 BDF2", no_value, 0.378, 1.5},
    {"20", "µ 0.2", "rod 2x1 BDF2", 0.228, 0.0854, 1.5},
    {"21a", "µ 0.3", "rod 1x1", 0.00116, met, 1.5},
    {"21b", "µ 0.3", "cosserat 1x3", 0.0119, met},
    {"21b", "µ 0.3", "cosserat 4x2 BDF2", 0.000922, met},
    {"21c", "", "cosserat 1x3", 0.748, 0.673},
    {"21c", "", "cosserat 4x2 BDF2", 0.181, 0.217},
    {"22", "2 r", "chain 1x1", 0.375, 0.375},
    {"22", "5 r", "chain 1x1", 1, 1},
    {"22", "5 r", "chain 4x1", 0.125, 0.125, 1.5},
    {"27a", "1000 m", "cosserat 1x3", 0.508, met, 1.5},
    {"27a", "10 km", "chain 1x1", 0.013, met, 1.5},
    {"27a", "10 km", "cosserat 1x3", 0.0595, 0.261, 1.5},
    {"27a", "10 km", "cosserat 4x2 BDF2", 0.00614, 0.00605, 1.5},
    {"27b", "1000 m", "cosserat 1x3", 0.0168, 0.00991, 1.5},
    {"27b", "1000 m", "cosserat 4x2 BDF2", 0.0683, 0.0158, 1.5},
    {"27b", "10 km", "cosserat 1x3", 0.334, 0.197, 1.5},
    {"27b", "10 km", "cosserat 4x2 BDF2", 0.016, 0.0292, 1.5},
};

} // namespace lab
