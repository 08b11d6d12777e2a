// Results as files: bench-<device>.md for people, bench-<device>.csv for programs.
#pragma once

#include "results.hpp"

namespace bench {

// "pthread-haswell-AMD EPYC" -> "pthread-haswell-amd-epyc": what a device's files are named after.
std::string slug(const plait_device_info& device);

// Up to two files per device, into the folders of its options. Throws if a file cannot be written.
void write_pages(const Results& results);

} // namespace bench
