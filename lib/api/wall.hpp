// The exception wall: every fallible C entry point runs its body through guard().
#pragma once

#include "base/format.hpp"
#include "base/result.hpp"

#include <algorithm>
#include <exception>
#include <new>

namespace plait::api {

// Keeps the sentence for plait_last_error of this thread and returns the code.
plait_result fail(plait_result code, const char* function, const char* text) noexcept;

// Runs `body` (a callable that returns a Status); nothing it throws gets past.
template <typename Body> plait_result guard(const char* function, const Body& body) noexcept {
    try {
        const Status status = body();
        if (status.ok())
            return PLAIT_OK;
        return fail(status.error().code, function, status.error().message.c_str());
    } catch (const std::bad_alloc&) {
        return fail(PLAIT_OUT_OF_MEMORY, function, "host memory is exhausted");
    } catch (const std::exception& exception) {
        return fail(PLAIT_INTERNAL, function, exception.what());
    } catch (...) {
        return fail(PLAIT_INTERNAL, function, "unknown exception");
    }
}

inline Error invalid(const std::string& text) {
    return {PLAIT_INVALID_ARGUMENT, text};
}

// s; differences of clocks that round below 0 are 0.
inline Result<double> checked_dt(double dt) {
    constexpr double rounding = -1e-6, most = 1e9;
    if (!(dt > rounding && dt <= most))
        return invalid(format("dt is %g, range is [0, 1e9] s", dt));
    return std::max(dt, 0.0);
}

inline Status need(const void* pointer, const char* name) {
    return pointer ? Status{} : invalid(format("%s is NULL", name));
}

} // namespace plait::api
