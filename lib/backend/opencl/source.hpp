// Kernel source with its includes put in place, since nothing lies beside the library at run time.
#pragma once

#include "base/result.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace plait::opencl {

struct Source {
    struct Line {
        uint32_t file; // index into files
        uint32_t line; // from 1
    };

    std::string text; // what the compiler is given, with #line for its messages
    std::vector<std::string> files;
    std::vector<Line> lines; // where each line of `text` comes from
};

// Replaces every #include of a file of cl/ by that file, each file once; looked for beside the
// including file, in cl/ and in cl/shared/. An unknown "quoted" name is an error; an unknown
// <angled> one is left to the compiler, because it may stand in a branch that is not for OpenCL.
Result<Source> flatten(std::string_view name, std::string_view text);

// The embedded file of a stage's kernel, "cl/tressfx/tressfx_wind.cl", or "".
std::string stage_file(const std::string& stage);

// The text of that file, or an empty view.
std::string_view stage_text(const std::string& stage);

// A compiler's log with its lines made true: some compilers (Oclgrind's) ignore #line and count
// lines of the flattened text under a name of their own.
std::string with_true_lines(const Source& source, const std::string& log);

} // namespace plait::opencl
