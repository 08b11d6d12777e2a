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
    {"3b", "all", "articulated 1x1 BDF2", 0.0313, 0.0313},
    {"3b", "all", "articulated 2x1 BDF2", 0.0313, 0.0313},
    {"5", "", "articulated 1x1 BDF2", 0.153, 0.153},
    {"5", "", "articulated 2x1 BDF2", 0.0718, 0.0718},
    {"7a", "", "articulated 1x1 BDF2", 0.00208, 0.00206},
    {"7b", "", "articulated 1x1 BDF2", 0.00209, 0.00206},
    // Far away rounding is what is measured: a swing of 15 mm where float32 knows 0.06 and 1 mm.
    {"29a", "shake", "articulated 1x1 BDF2", 0.22, 0.22},
    {"29b", "walk", "articulated 2x1 BDF2", 0.341, 0.341},
    {"30a", "N 8", "articulated 1x1 BDF2", 0.169, 0.169},
    {"30b", "N 8", "articulated 1x1 BDF2", 29, 29},
    {"30b", "N 8", "articulated 2x1 BDF2", 24.3, 24.3},
    {"30c", "Γ 100, N 8", "articulated 1x1 BDF2", 0.209, 0.209},
    {"30c", "Γ 100, N 8", "articulated 2x1 BDF2", 0.0994, 0.0994},
    {"30c", "Γ 100, N 16", "articulated 1x1 BDF2", 0.288, 0.288},
    {"30c", "Γ 100, N 16", "articulated 2x1 BDF2", 0.154, 0.154},
    {"30c", "Γ 100, N 32", "articulated 1x1 BDF2", 0.311, 0.311},
    {"30c", "Γ 100, N 32", "articulated 2x1 BDF2", 0.174, 0.174},
};

} // namespace lab
