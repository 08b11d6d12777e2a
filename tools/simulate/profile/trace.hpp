// A run as a trace for Perfetto and chrome://tracing (the Trace Event Format).
#pragma once

#include "run.hpp"

namespace simulate {

Json to_trace(const Measurements& run);

} // namespace simulate
