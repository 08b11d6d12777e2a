// printf into a std::string, for the sentences of errors and logs.
#pragma once

#include <cstdarg>
#include <cstdio>
#include <string>

// MinGW's C++ library prints as C99 does, where GCC's `printf` means the older C library of
// Windows.
#ifdef __MINGW_PRINTF_FORMAT
#define PLAIT_PRINTF __MINGW_PRINTF_FORMAT
#else
#define PLAIT_PRINTF printf
#endif

namespace plait {

[[gnu::format(PLAIT_PRINTF, 1, 2)]] inline std::string format(const char* pattern, ...) {
    va_list arguments;
    va_start(arguments, pattern);
    va_list again;
    va_copy(again, arguments);
    const int length = std::vsnprintf(nullptr, 0, pattern, arguments);
    va_end(arguments);
    std::string text(length > 0 ? static_cast<size_t>(length) : 0, '\0');
    std::vsnprintf(text.data(), text.size() + 1, pattern, again);
    va_end(again);
    return text;
}

} // namespace plait
