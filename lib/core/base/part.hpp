// Strands that lie together in lanes, as the rooms around the solve see them in a substep, and the
// three doors by which these rooms reach the solve: push, spring and plane. The solve knows the doors
// and no feature. A feature knows the doors and not the solve.
#pragma once

#include "backend/device.hpp"
#include "core/base/lane_layout.hpp"

#include <plait/params.h>

namespace plait {

// Buffers that are not there are null.
struct Part {
    LaneLayout lanes;
    uint32_t row_stride; // V of the sim
    float h;             // s, of a substep
    float share;         // of the fixed step, at the substep's end
    uint32_t bdf2;
    bool grooms;             // material of these strands draws them to the groom
    plait_lane_params solve; // what the solve is told, but for its doors

    // Of the sim.
    const Buffer& vertex_count; // uint [strands]
    const Buffer& rest;         // float4 [guides*V]
    const Buffer& pose;         // float4 [2*guides], at the substep's end
    const Buffer& acceleration; // float4 [guides*V], m/s^2: the caller's

    // In lanes: float [tile][V][components][T].
    const Buffer& strand;              // uint [lanes]: which strand each lane has
    const Buffer& dry_material;        // as the caller wants it
    const Buffer& material;            // as strands are solved with
    const Buffer& groom;               // stiffness of springs to the groom
    const Buffer &x, &v;               // m, m/s
    const Buffer &x_before, &v_before; // BDF2's step before
    const Buffer& room;                // that vertices have in the groom, with volume
    const Buffer& pressure;            // m/s^2, carried from step to step, with volume

    // Doors.
    const Buffer& push;   // 3: m/s^2, added to gravity; holds the pressure, too
    const Buffer& spring; // 4: m and N/m, an implicit spring to a point
    const Buffer& plane;  // PLAIT_LANE_PLANE_COMPONENTS: that a vertex stays above, with friction
    const Buffer& hollow; // PLAIT_LANE_HOLLOW_COMPONENTS: planes around that, of sheets

    // What pushes, where anything does.
    const Buffer& pushed() const { return push ? push : pressure; }
};

// Which doors of a part are filled in a substep. The push has no flag: where its buffer exists, it is filled.
struct Doors {
    bool spring = false;
    bool plane = false;  // by bodies
    bool hollow = false; // by sheets
    bool strand = false; // planes of other strands, after those of bodies
};

// Colliders that lie side by side: rows of `buffer` for a substep.
struct ColliderRows {
    const Buffer& buffer;
    uint32_t first, count;
};

// The parameters of a stage that meets `rows` as the solve would, with the doors that are filled so far.
inline plait_lane_params solve_params(const Part& part, const Doors& doors,
                                      const ColliderRows& rows) {
    plait_lane_params params = part.solve;
    params.collider_first = rows.first;
    params.collider_count = rows.count;
    params.accelerates = part.pushed() ? 1 : 0;
    params.pins = doors.spring ? 1 : 0;
    params.planes = doors.strand ? 2 : doors.plane ? 1 : 0;
    params.hollows = doors.hollow ? 1 : 0;
    return params;
}

} // namespace plait
