// A backend of the tests' own: `reference`, failing when told to.
#pragma once

#include <plait/plait_backend.h>

struct Faults {
    int fail_create_after = -1; // buffers made before one is refused; -1: never
    int lose_after = -1;        // submits done before the device is lost; -1: never
    int live_buffers = 0;
    int live_devices = 0;
};

// Registered once as "faulty"; the faults are those of all its devices.
Faults& faulty();
