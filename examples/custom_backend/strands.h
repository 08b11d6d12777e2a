/* A row of straight strands of 0.2 m, grown sideways, for the examples beside. */
#ifndef STRANDS_H
#define STRANDS_H

#include <plait/plait.h>

#include <stdio.h>
#include <stdlib.h>

enum { STRANDS = 16, VERTICES = 16 };

static inline void check(plait_result result) {
    if (result == PLAIT_OK)
        return;
    fprintf(stderr, "%s: %s\n", plait_result_string(result), plait_last_error());
    exit(1);
}

static inline plait_groom* make_groom(void) {
    float positions[STRANDS][VERTICES][3];
    for (int strand = 0; strand < STRANDS; ++strand) {
        for (int vertex = 0; vertex < VERTICES; ++vertex) {
            positions[strand][vertex][0] = 0.2f * (float)vertex / (VERTICES - 1);
            positions[strand][vertex][1] = 0.0f;
            positions[strand][vertex][2] = 0.01f * (float)strand;
        }
    }
    plait_groom_desc desc = plait_groom_desc_defaults();
    desc.positions.data = positions;
    desc.positions.count = STRANDS * VERTICES;
    desc.vertices_per_strand = VERTICES;
    plait_groom* groom = NULL;
    check(plait_groom_create(&desc, NULL, &groom));
    return groom;
}

#endif
