// Named numbers of a recording. tools/lab/docs/lab.md says what each is.
#pragma once

#include "run/recording.hpp"

#include <string>
#include <vector>

namespace lab {

struct Value {
    double value = 0; // NaN where there is none; then `note` says why
    std::string note;
};

bool is_metric(const std::string& name);
bool is_of_all_strands(const std::string& metric); // no `strand` of a measure chooses one
Measure measure_of(const char* metric);            // all of the first strand's recording, no mark
const std::vector<std::string>& metric_names();
std::string metric_list();                          // "rms_error, max_error, ..."
const char* metric_unit(const std::string& metric); // "L", "deg", "1/s", "" ...

// Whether an error of 1 is what hair that stands still has, not a length.
bool counts_over_swing(const std::string& metric);

Value evaluate(const Scene& scene, const Method& method, const Recording& recording,
               const Measure& measure);

// The largest magnitude that passes: the model's own mark, else that of a model's setting for
// quality, else everyone's. Null: none.
const double* mark_of(const Measure& measure, const Method& method);

// Whether the magnitude is at most the mark, or at least what is asked; no mark: no opinion.
enum class Verdict { none, pass, fail };
Verdict judge(const Measure& measure, const Method& method, const Value& value);

// Of one strand: for reports and tests.
double strain_at(const std::vector<double>& lengths, const std::vector<Vec3>& x); // worst |l/l0-1|
std::vector<double> masses_of(const Scene& scene, const Model& model, const Strand& strand); // kg

// First swing of a signal sampled every `step` s: frequency (rad/s) from its zero crossings and
// damping ratio from its peaks, two of each at least. Zero where it does not swing.
struct Swing {
    double frequency = 0, damping = 0;
};
Swing fit_swing(const std::vector<double>& signal, double step);

// Where a strand was at `time`, by cubic interpolation between frames.
std::vector<Vec3> positions_at(const Recording& recording, size_t strand, double time);

} // namespace lab
