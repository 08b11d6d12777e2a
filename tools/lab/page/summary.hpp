// All of a page in one table, a line for each method: the README shows some of its lines.
#pragma once

#include "page.hpp"

namespace lab {

// Error over swing where a head shakes, turns and walks; the rod fall of gamma 100, falling and at
// rest; strands in real time; trials of the stability sweep in which a strand was lost or gained
// energy. A cell is empty where nothing was measured.
std::string summary_markdown(const Page& page);

} // namespace lab
