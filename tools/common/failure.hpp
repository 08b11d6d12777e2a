// How a program ends: an exit code (128 + a signal's number: ended()); failing, with a sentence.
#pragma once

#include <plait/plait.h>

#include <stdexcept>
#include <string>

namespace common {

enum class Exit { ok = 0, user_error = 1, device_failure = 2 };

struct Failure : std::runtime_error {
    explicit Failure(const std::string& sentence, Exit code = Exit::user_error)
        : std::runtime_error(sentence), exit(code) {}
    Exit exit;
};

// Which results are the device's doing rather than the user's.
inline Exit exit_of(plait_result result) {
    switch (result) {
    case PLAIT_OUT_OF_MEMORY:
    case PLAIT_COMPILE:
    case PLAIT_DEVICE_LOST:
    case PLAIT_BACKEND:
    case PLAIT_INTERNAL:
        return Exit::device_failure;
    default:
        return Exit::user_error;
    }
}

// Throws what plait_last_error() says unless `result` is PLAIT_OK.
inline void check(plait_result result) {
    if (result != PLAIT_OK)
        throw Failure(plait_last_error(), exit_of(result));
}

} // namespace common
