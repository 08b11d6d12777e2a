// The measurements, each registered with Google Benchmark.
#pragma once

#include "results.hpp"

#include <benchmark/benchmark.h>

#include <chrono>
#include <exception>
#include <string>

namespace bench {

void register_ceilings(uint32_t device, Results& results);
void register_steps(uint32_t device, Results& results);
void register_characters(uint32_t device, Results& results);
void register_features(uint32_t device, Results& results);
void register_levels(uint32_t device, Results& results);

// Prints what the solves over strands take while each work-group holds so much idle local memory.
void sweep_local_memory(const Results& results);

inline double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Registers `measure(state)`; what it throws fails the row and the program, not the other rows.
template <typename Measure>
void register_row(const std::string& name, Results& results, Measure measure) {
    const auto run = [name, &results, measure](benchmark::State& state) {
        try {
            measure(state);
        } catch (const std::exception& error) {
            results.failures += name + ": " + error.what() + "\n";
            state.SkipWithError(error.what());
        }
    };
    benchmark::RegisterBenchmark(name.c_str(), run)->UseManualTime()->Unit(benchmark::kMicrosecond);
}

} // namespace bench
