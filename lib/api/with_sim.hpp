// The common shape of the calls that take a sim and can fail.
#pragma once

#include "api/objects.hpp"
#include "api/wall.hpp"

namespace plait::api {

template <typename Body>
plait_result with_sim(const char* function, plait_sim* sim, const Body& body) noexcept {
    return guard(function, [&]() -> Status {
        PLAIT_TRY(need(sim, "sim"));
        return body(sim->sim);
    });
}

} // namespace plait::api
