// Where messages go: the caller's callback, or nowhere.
#pragma once

#include <plait/plait.h>

#include <string>

namespace plait {

struct Log {
    plait_log_fn callback = nullptr;
    void* user = nullptr;

    void operator()(plait_log_level level, const std::string& text) const {
        if (callback)
            callback(level, text.c_str(), user);
    }
};

} // namespace plait
