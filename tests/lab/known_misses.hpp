// What misses its mark of the accuracy table, and by how much, on either backend; tools/lab/docs/lab.md says
// why. What meets its mark again is to be struck off.
//
// Where rounding moves a value, machines do not agree, and neither do kernels of the same
// mathematics. Found by scaling a strand's mass by 1.1, 1.3 and 0.87, EI and EA with it, which
// changes nothing but rounding: the comments say between what values OpenCL came out then.
// Where these lie farther apart than the factor (21a, 27, 34a) a CPU of another kind may disagree.
#pragma once

namespace lab {

struct KnownMiss {
    const char *row, *variant, *method;
    double opencl, reference; // magnitudes
    double rounding = 1;      // what rounding alone may make of it, besides
};

constexpr double met = 0; // on this backend

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
    {"3b", "all", "articulated 1x1 BDF2", 0.0313, 0.0313},
    {"3b", "all", "articulated 2x1 BDF2", 0.0313, 0.0313},
    {"4", "", "chain 1x1", 0.0277, 0.0277},
    {"4", "", "cosserat 1x3", 0.0877, 0.0877},
    {"4", "", "cosserat 4x2 BDF2", 0.0408, 0.0408},
    {"4", "", "rod 1x1", 0.0387, 0.0387},
    {"5", "", "chain 1x1", 0.0994, 0.0994},
    {"5", "", "chain 4x1", 0.0795, 0.0795},
    {"5", "", "cosserat 1x3", 0.319, 0.319},
    {"5", "", "cosserat 4x2 BDF2", 0.265, 0.265},
    {"5", "", "rod 1x1", 0.198, 0.198},
    {"5", "", "rod 2x1 BDF2", 0.0806, 0.0806},
    {"5", "", "articulated 1x1 BDF2", 0.153, 0.153},
    {"5", "", "articulated 2x1 BDF2", 0.0718, 0.0718},
    {"6a", "", "chain 1x1", 0.0156, met},
    {"6a", "", "cosserat 1x3", 0.526, 0.531},
    {"6a", "", "cosserat 4x2 BDF2", 0.0273, 0.0267},
    {"6b", "", "cosserat 1x3", 0.48, 0.586, 1.5}, // 0.33 to 0.69: two or three crossings
    {"6b", "", "cosserat 4x2 BDF2", 0.0405, 0.0266},
    {"6b", "", "rod 1x1", met, 0.00503},
    {"6c", "240 Hz", "cosserat 1x3", 0.0586, 0.00663, 1.1}, // 0.059 to 0.065
    {"6c", "480 Hz", "cosserat 1x3", 0.0354, 0.0294},
    {"7a", "", "chain 1x1", 0.0609, 0.0563},
    {"7a", "", "chain 4x1", 0.0141, 0.0141},
    {"7a", "", "cosserat 1x3", 0.209, 0.21},
    {"7a", "", "cosserat 4x2 BDF2", 0.0936, 0.0938},
    {"7a", "", "rod 1x1", 0.0571, 0.0571},
    {"7a", "", "articulated 1x1 BDF2", 0.00208, 0.00206},
    {"7b", "", "cosserat 1x3", 0.386, 0.207, 1.1}, // 0.28 to 0.40
    {"7b", "", "cosserat 4x2 BDF2", 0.108, 0.123},
    {"7b", "", "rod 1x1", 0.0596, 0.0596},
    {"7b", "", "articulated 1x1 BDF2", 0.00209, 0.00206},
    {"9a", "", "cosserat 1x3", 0.00178, 0.00178},
    {"9a", "", "cosserat 4x2 BDF2", 0.00186, 0.00186},
    {"9a", "", "rod 1x1", 0.00182, 0.00182},
    {"9a", "", "rod 2x1 BDF2", 0.00202, 0.00202},
    {"9b", "", "cosserat 1x3", 0.0151, 0.0151},
    {"9b", "", "cosserat 4x2 BDF2", 0.0202, 0.0202},
    {"9b", "", "rod 1x1", 0.0269, 0.0269},
    {"9b", "", "rod 2x1 BDF2", 0.0277, 0.0277},
    {"9c", "", "chain 1x1", 0.000218, 0.000218},
    {"9c", "", "chain 4x1", 0.000364, 0.000339},
    {"9c", "", "cosserat 1x3", 0.135, 0.135},
    {"9c", "", "cosserat 4x2 BDF2", 0.22, 0.22},
    {"9c", "", "rod 1x1", 0.314, 0.314},
    {"9c", "", "rod 2x1 BDF2", 0.349, 0.349},
    {"16a", "", "cosserat 1x3", 0.00231, 0.00228},
    {"16b", "", "cosserat 4x2 BDF2", 0.0218, met}, // 0.0207 to 0.0222
    {"16c", "Γ 500", "cosserat 1x3", 1.73e-5, 2.5e-5},
    {"16c", "Γ 500", "cosserat 4x2 BDF2", 2.94e-5, 2.94e-5, 1.2},
    {"16c", "Γ 500", "rod 1x1", 7.51e-5, 7.49e-5},
    {"16c", "Γ 500", "rod 2x1 BDF2", 1.28e-4, 1.29e-4, 1.1}, // 1.28e-4 to 1.36e-4
    {"16c", "Γ 1762", "rod 1x1", 3.54e-5, 3.44e-5},
    {"16c", "Γ 1762", "rod 2x1 BDF2", 1.16e-4, 1.23e-4},
    {"18a", "Γ 1000", "cosserat 1x3", 0.0245, 0.0245},
    {"18a", "Γ 10, N 32", "cosserat 1x3", 0.0294, 0.0294},
    {"18a", "Γ 1000, N 32", "cosserat 1x3", 0.0236, 0.0236},
    {"19a", "", "chain 1x1", 0.748, 0.749},
    {"19a", "", "chain 4x1", 0.0314, 0.0322},
    {"19b", "", "chain 4x1", 0.0181, 0.0179},
    {"19b", "", "cosserat 1x3", 0.00996, 0.00996},
    {"19b", "", "cosserat 4x2 BDF2", 0.00207, 0.00206},
    {"19b", "", "rod 1x1", 0.0278, 0.0298},
    {"19b", "", "rod 2x1 BDF2", 0.0104, 0.0104},
    // Where a strand slips hangs on rounding: depth is the difference of numbers of 20 m.
    {"20", "µ 0.1", "cosserat 1x3", 0.376, 0.209},
    {"20", "µ 0.1", "cosserat 4x2 BDF2", 0.675, 0.276, 1.2}, // 0.63 to 0.76
    {"20", "µ 0.1", "rod 2x1 BDF2", 0.138, met, 1.1},        // 0.12 to 0.15
    {"20", "µ 0.1", "articulated 1x1 BDF2", 0.287, met, 1.5},
    {"20", "µ 0.1", "articulated 2x1 BDF2", 0.789, 0.0525, 1.5},
    {"20", "µ 0.2", "cosserat 1x3", 0.41, 0.215},
    {"20", "µ 0.2", "cosserat 4x2 BDF2", 0.808, 0.378}, // where the root stops
    {"20", "µ 0.2", "rod 2x1 BDF2", 0.228, 0.0854},
    {"20", "µ 0.2", "articulated 1x1 BDF2", 0.0992, met, 1.5},
    {"20", "µ 0.2", "articulated 2x1 BDF2", 0.791, 0.0874, 1.5},
    {"21a", "µ 0.3", "rod 1x1", 0.00116, met, 1.5}, // 0.0004 to 0.0012
    {"21b", "µ 0.3", "cosserat 1x3", 0.0119, met},
    {"21b", "µ 0.3", "cosserat 4x2 BDF2", 0.000922, met},
    {"21c", "", "cosserat 1x3", 0.748, 0.673},
    {"21c", "", "cosserat 4x2 BDF2", 0.181, 0.217},
    {"22", "2 r", "chain 1x1", 0.375, 0.375},
    {"22", "5 r", "chain 1x1", 1, 1},
    {"22", "5 r", "chain 4x1", 0.125, 0.125},
    {"22", "5 r", "articulated 1x1 BDF2", 0.375, 0.375},
    // Far away rounding is what is measured: a swing of 15 mm where float32 knows 0.06 and 1 mm.
    {"27a", "1000 m", "cosserat 1x3", 0.508, met, 1.5},           // 0.04 to 1.08
    {"27a", "10 km", "chain 1x1", 0.013, met, 1.5},               // 0.005 to 0.014
    {"27a", "10 km", "cosserat 1x3", 0.0595, 0.261, 1.5},         // 0.06 to 0.34
    {"27a", "10 km", "cosserat 4x2 BDF2", 0.00614, 0.00605, 1.5}, // 0.003 to 0.006
    {"27b", "1000 m", "cosserat 1x3", 0.626, 0.00991, 1.5},       // 0.001 to 0.63
    {"27b", "1000 m", "cosserat 4x2 BDF2", met, 0.0158, 1.5},     // 0.003 to 0.020
    {"27b", "10 km", "cosserat 1x3", 0.228, 0.197, 1.2},          // 0.16 to 0.26
    {"27b", "10 km", "cosserat 4x2 BDF2", 0.016, 0.0292, 1.2},    // 0.014 to 0.019
    {"29a", "shake", "chain 1x1", 0.673, 0.673},
    {"29a", "shake", "chain 4x1", 0.671, 0.671},
    {"29a", "shake", "cosserat 1x3", 0.953, 0.937},
    {"29a", "shake", "cosserat 4x2 BDF2", 0.683, 0.679},
    {"29a", "shake", "rod 1x1", 0.519, 0.519},
    {"29a", "shake", "rod 2x1 BDF2", 0.14, 0.14},
    {"29a", "shake", "articulated 1x1 BDF2", 0.22, 0.22},
    {"29a", "turn", "chain 1x1", 0.982, 0.982},
    {"29a", "turn", "chain 4x1", 1.05, 1.05},
    {"29a", "turn", "cosserat 1x3", 1.12, 1.12},
    {"29a", "turn", "cosserat 4x2 BDF2", 0.523, 0.523},
    {"29a", "turn", "rod 1x1", 0.333, 0.333},
    {"29a", "walk", "chain 1x1", 1.12, 1.12},
    {"29a", "walk", "chain 4x1", 1.17, 1.17},
    {"29a", "walk", "cosserat 1x3", 1, 1},
    {"29a", "walk", "cosserat 4x2 BDF2", 0.479, 0.467},
    {"29a", "walk", "rod 1x1", 0.405, 0.4},
    {"29b", "shake", "chain 1x1", 4.82, 4.82},
    {"29b", "shake", "chain 4x1", 5, 5},
    {"29b", "shake", "cosserat 1x3", 1.07, 1.08},
    {"29b", "shake", "cosserat 4x2 BDF2", 0.861, 0.86},
    {"29b", "shake", "rod 1x1", 0.66, 0.654},
    {"29b", "shake", "rod 2x1 BDF2", 0.823, 0.859},
    {"29b", "turn", "chain 1x1", 9.19, 9.19},
    {"29b", "turn", "chain 4x1", 9.19, 9.19},
    {"29b", "turn", "cosserat 1x3", 3.41, 3.34},
    {"29b", "turn", "cosserat 4x2 BDF2", 0.893, 0.865},
    {"29b", "turn", "rod 2x1 BDF2", 0.832, 0.767},
    {"29b", "walk", "chain 1x1", 7.54, 7.54},
    {"29b", "walk", "chain 4x1", 7.54, 7.54},
    {"29b", "walk", "cosserat 1x3", 1.15, 1.15},
    {"29b", "walk", "cosserat 4x2 BDF2", 0.824, 0.816},
    {"29b", "walk", "rod 1x1", 0.548, 0.558},
    {"29b", "walk", "rod 2x1 BDF2", 0.787, 0.754},
    {"29b", "walk", "articulated 2x1 BDF2", 0.341, 0.341},
    {"29c", "", "chain 1x1", 0.52, 0.52},
    {"29c", "", "chain 4x1", 0.387, 0.387},
    {"29c", "", "cosserat 1x3", 0.975, 0.962},
    {"29c", "", "cosserat 4x2 BDF2", 0.522, 0.511},
    {"29c", "", "rod 1x1", 0.371, 0.252},
    {"29c", "", "rod 2x1 BDF2", 0.214, 0.214},
    {"29d", "", "chain 1x1", 0.686, 0.686},
    {"29d", "", "chain 4x1", 0.572, 0.572},
    {"29d", "", "cosserat 1x3", 0.979, 0.971},
    {"29d", "", "cosserat 4x2 BDF2", 0.711, 0.664},
    {"29d", "", "rod 1x1", 0.486, 0.486},
    {"30a", "N 8", "chain 1x1", 0.262, 0.262},
    {"30a", "N 8", "chain 4x1", 0.0775, 0.0774},
    {"30a", "N 8", "cosserat 1x3", 0.889, 0.889},
    {"30a", "N 8", "cosserat 4x2 BDF2", 0.675, 0.675},
    {"30a", "N 8", "rod 1x1", 0.47, 0.47},
    {"30a", "N 8", "articulated 1x1 BDF2", 0.169, 0.169},
    {"30a", "N 16", "chain 1x1", 0.238, 0.238},
    {"30a", "N 16", "chain 4x1", 0.0765, 0.0765},
    {"30a", "N 16", "cosserat 1x3", 0.865, 0.863},
    {"30a", "N 16", "cosserat 4x2 BDF2", 0.466, 0.465},
    {"30a", "N 16", "rod 1x1", 0.257, 0.257},
    {"30a", "N 32", "chain 1x1", 0.224, 0.224},
    {"30a", "N 32", "chain 4x1", 0.0707, 0.0707},
    {"30a", "N 32", "cosserat 1x3", 0.859, 0.859},
    {"30a", "N 32", "cosserat 4x2 BDF2", 0.441, 0.441},
    {"30a", "N 32", "rod 1x1", 0.229, 0.229},
    {"30b", "N 8", "cosserat 1x3", 42.3, 45.8},
    {"30b", "N 8", "cosserat 4x2 BDF2", 18.8, 18.8},
    {"30b", "N 8", "rod 2x1 BDF2", 24.9, 24.9},
    {"30b", "N 8", "articulated 1x1 BDF2", 29, 29},
    {"30b", "N 8", "articulated 2x1 BDF2", 24.3, 24.3},
    {"30b", "N 16", "cosserat 1x3", 41.3, 42.3},
    {"30b", "N 16", "cosserat 4x2 BDF2", 14.5, 14.5},
    {"30b", "N 32", "cosserat 1x3", 44.2, 43.2},
    {"30b", "N 32", "cosserat 4x2 BDF2", 13.3, 13.3},
    {"30c", "Γ 10, N 8", "cosserat 1x3", 0.92, 0.921},
    {"30c", "Γ 10, N 8", "cosserat 4x2 BDF2", 0.546, 0.506},
    {"30c", "Γ 10, N 8", "rod 1x1", 0.288, 0.288},
    {"30c", "Γ 10, N 16", "cosserat 1x3", 0.844, 0.844},
    {"30c", "Γ 10, N 16", "cosserat 4x2 BDF2", 0.427, 0.531},
    {"30c", "Γ 10, N 16", "rod 1x1", 0.29, 0.29},
    {"30c", "Γ 10, N 32", "cosserat 1x3", 0.852, 0.852},
    {"30c", "Γ 10, N 32", "cosserat 4x2 BDF2", 0.373, 0.373},
    {"30c", "Γ 10, N 32", "rod 1x1", 0.291, 0.291},
    {"30c", "Γ 100, N 8", "cosserat 1x3", 0.919, 0.916},
    {"30c", "Γ 100, N 8", "cosserat 4x2 BDF2", 0.609, 0.609},
    {"30c", "Γ 100, N 8", "rod 1x1", 0.44, 0.44},
    {"30c", "Γ 100, N 8", "rod 2x1 BDF2", 0.103, 0.103},
    {"30c", "Γ 100, N 8", "articulated 1x1 BDF2", 0.209, 0.209},
    {"30c", "Γ 100, N 8", "articulated 2x1 BDF2", 0.0994, 0.0994},
    {"30c", "Γ 100, N 16", "cosserat 1x3", 0.924, 0.924},
    {"30c", "Γ 100, N 16", "cosserat 4x2 BDF2", 0.714, 0.714},
    {"30c", "Γ 100, N 16", "rod 1x1", 0.551, 0.551},
    {"30c", "Γ 100, N 16", "rod 2x1 BDF2", 0.159, 0.159},
    {"30c", "Γ 100, N 16", "articulated 1x1 BDF2", 0.288, 0.288},
    {"30c", "Γ 100, N 16", "articulated 2x1 BDF2", 0.154, 0.154},
    {"30c", "Γ 100, N 32", "cosserat 1x3", 0.94, 0.94},
    {"30c", "Γ 100, N 32", "cosserat 4x2 BDF2", 0.74, 0.741},
    {"30c", "Γ 100, N 32", "rod 1x1", 0.582, 0.581},
    {"30c", "Γ 100, N 32", "rod 2x1 BDF2", 0.178, 0.178},
    {"30c", "Γ 100, N 32", "articulated 1x1 BDF2", 0.311, 0.311},
    {"30c", "Γ 100, N 32", "articulated 2x1 BDF2", 0.174, 0.174},
    {"30c", "Γ 1000, N 8", "cosserat 1x3", 0.868, 0.868},
    {"30c", "Γ 1000, N 8", "cosserat 4x2 BDF2", 0.481, 0.481},
    {"30c", "Γ 1000, N 8", "rod 1x1", 0.251, 0.251},
    {"30c", "Γ 1000, N 16", "cosserat 1x3", 0.859, 0.859},
    {"30c", "Γ 1000, N 16", "cosserat 4x2 BDF2", 0.402, 0.402},
    {"30c", "Γ 1000, N 16", "rod 1x1", 0.231, 0.231},
    {"30c", "Γ 1000, N 32", "cosserat 1x3", 0.842, 0.842},
    {"30c", "Γ 1000, N 32", "cosserat 4x2 BDF2", 0.372, 0.372},
    {"30c", "Γ 1000, N 32", "rod 1x1", 0.232, 0.232},
    {"30d", "Γ 10, N 8", "cosserat 1x3", 82.5, 84.9},
    {"30d", "Γ 10, N 8", "cosserat 4x2 BDF2", 16.5, 16.1},
    {"30d", "Γ 10, N 16", "cosserat 1x3", 62, 62.6},
    {"30d", "Γ 10, N 16", "cosserat 4x2 BDF2", 17.4, 17.4},
    {"30d", "Γ 10, N 32", "cosserat 1x3", 62.8, 62.9},
    {"30d", "Γ 10, N 32", "cosserat 4x2 BDF2", 32.3, 32.3},
    {"30d", "Γ 100, N 8", "cosserat 1x3", 58.4, 58.3},
    {"30d", "Γ 100, N 8", "cosserat 4x2 BDF2", 12.8, 13},
    {"30d", "Γ 100, N 16", "cosserat 1x3", 53.3, 54.4},
    {"30d", "Γ 100, N 16", "cosserat 4x2 BDF2", 12.2, 11.4},
    {"30d", "Γ 100, N 32", "cosserat 1x3", 58.2, 58},
    {"30d", "Γ 100, N 32", "cosserat 4x2 BDF2", 11.1, 10.7},
    {"30d", "Γ 1000, N 8", "cosserat 4x2 BDF2", 15.2, 15.2},
    {"30d", "Γ 1000, N 16", "cosserat 1x3", met, 20.3},
    {"30d", "Γ 1000, N 16", "cosserat 4x2 BDF2", 10.2, 10.3},
    {"30d", "Γ 1000, N 32", "cosserat 1x3", 20.7, 20.6},
    {"34a", "", "cosserat 1x3", 0.503, 0.437},
    {"34a", "", "rod 1x1", 0.0068, met, 1.5}, // 0.0025 to 0.0068
    {"34b", "", "chain 1x1", 0.0476, 0.0476},
    {"34b", "", "chain 4x1", 0.0119, 0.0119},
    {"34b", "", "cosserat 1x3", 0.274, 0.239, 1.2},      // 0.23 to 0.27
    {"34b", "", "cosserat 4x2 BDF2", 0.00831, met, 1.3}, // 0.0075 to 0.0095
    {"34b", "", "rod 1x1", 0.0515, 0.0475, 1.1},         // 0.048 to 0.052
    // As row 20.
    {"36", "4 ρA", "cosserat 1x3", 0.148, 0.063, 1.2},       // 0.15 to 0.17
    {"36", "4 ρA", "cosserat 4x2 BDF2", 0.103, 0.219, 1.3},  // 0.06 to 0.13
    {"36", "4 ρA", "rod 1x1", 0.0524, 0.0844, 1.2},          // 0.052 to 0.061
    {"36", "4 ρA", "rod 2x1 BDF2", 0.16, 0.127, 1.1},        // 0.16 to 0.17
    {"36", "4 ρA", "articulated 1x1 BDF2", 0.739, 0.169},    // 0.71 to 0.74
    {"36", "4 ρA", "articulated 2x1 BDF2", 0.4, 0.139, 1.5}, // 0.23 to 0.58
};

} // namespace lab
