// A backend of the tests' own: `reference`, failing when told to.
#pragma once

#include <plait/plait_backend.h>

struct Faults {
    int fail_create_after = -1;              // buffers made before one is refused; -1: never
    int lose_after = -1;                     // submits done before the device is lost; -1: never
    int fail_upload_after = -1;              // uploads done before one is refused; -1: never
    plait_stage missing = PLAIT_STAGE_COUNT; // the stage it does not have; PLAIT_STAGE_COUNT: none
    int live_buffers = 0;
    int live_devices = 0;
    bool prepared[PLAIT_STAGE_COUNT] = {};  // stages that were,
    bool submitted[PLAIT_STAGE_COUNT] = {}; // and that ran, since faulty() was last called
};

// Registered once as "faulty"; the faults are those of all its devices.
Faults& faulty();
