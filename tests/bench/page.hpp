// Results as files: bench-<device>.md for people, bench-<device>.csv for programs.
#pragma once

#include "results.hpp"

namespace bench {

// One pair of files per device. Throws if a file cannot be written.
void write_pages(const Results& results);

} // namespace bench
