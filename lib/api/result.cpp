// Results, the thread's last error, the version.
#include "api/wall.hpp"

#include <cstdio>
#include <string>

namespace plait::api {
namespace {

// The one per-thread state of the library. The fixed array holds the sentence when memory is out.
struct LastError {
    char text[512] = "";
    std::string whole; // compiler logs are longer
    bool is_whole = false;
};
thread_local LastError last_error;

} // namespace

plait_result fail(plait_result code, const char* function, const char* text) noexcept {
    const int length =
        std::snprintf(last_error.text, sizeof last_error.text, "%s: %s", function, text);
    last_error.is_whole = false;
    if (length >= static_cast<int>(sizeof last_error.text)) {
        try {
            last_error.whole = std::string(function) + ": " + text;
            last_error.is_whole = true;
        } catch (const std::bad_alloc&) { // the beginning is in `text`
        }
    }
    return code;
}

const char* last_error_text() noexcept {
    return last_error.is_whole ? last_error.whole.c_str() : last_error.text;
}

} // namespace plait::api

extern "C" {

const char* plait_result_string(plait_result result) {
    switch (result) {
#define PLAIT_TEXT(name, value, text)                                                              \
    case PLAIT_##name:                                                                             \
        return text;
        PLAIT_RESULTS(PLAIT_TEXT)
#undef PLAIT_TEXT
    default:
        return "not a result of plait";
    }
}

const char* plait_last_error(void) {
    return plait::api::last_error_text();
}

uint32_t plait_version(void) {
    return PLAIT_VERSION_NUMBER;
}
}
