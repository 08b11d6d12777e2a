/* Files of hair as it moves, for renderers: Alembic (.abc) and USD text (.usda), one sample a frame.
 * The conventions are those of plait.h; docs/formats.md has what the files hold.
 */
#ifndef PLAIT_RECORDER_H
#define PLAIT_RECORDER_H

#include <plait/plait.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct plait_recorder plait_recorder;

/* Which strands of a sim. */
typedef enum plait_recorder_strands {
    PLAIT_RECORDER_STRANDS_SHOWN = 0, /* guides, then the strands that follow */
    PLAIT_RECORDER_STRANDS_GUIDES = 1,
    PLAIT_RECORDER_STRANDS_FORCE_32 = 0x7fffffff
} plait_recorder_strands;

typedef struct plait_recorder_desc {
    uint32_t struct_size;
    plait_recorder_strands strands; /* default SHOWN */
    /* 1: the velocity of each vertex, too, for motion blur, in the file's units a second: between the
       frames before and after its own, at the ends between two; default 0 */
    uint32_t velocities;
    plait_axes axes; /* of the file, default Y_UP, as Alembic has it; of .usda Y_UP or Z_UP */
    float scale;     /* metres to the file's units, (0, 1e6], default 1; 100: centimetres */
    double
        frames_per_second; /* [1e-3, 1e6], default 24: of .usda, whose times are in frames, and as
                                 a note in .abc, whose times are in seconds */
    /* float, m, diameters, each [0, 1]: one for all, one for each strand, one for each vertex, root
       first, strand after strand; or empty: none */
    plait_view widths;
    plait_view strand_uv; /* float[2], where roots lie on the scalp [strands] or empty */
    plait_allocator allocator;
} plait_recorder_desc;
PLAIT_STRUCT(plait_recorder_desc)

/* By the extension of `path`. The file is written beside it and is there, whole, after
 * plait_recorder_close: until then, and whatever fails, `path` is what it was. `desc` NULL: defaults.
 * @errors NOT_FOUND (its folder), IO, UNSUPPORTED (another extension; .usda with left-handed axes) */
PLAIT_API plait_result plait_recorder_create(const char* path, const plait_recorder_desc* desc,
                                             plait_recorder** out);

/* PLAIT_FIELD_POSITION of `sim` as the frame at `time`, in s, which is later than that of the frame
 * before. The first sim says how many strands and vertices there are; others may follow it if
 * they have as many. A frame that could not be written ends the recording. Waits.
 * @errors INVALID_STATE (closed, or ended by a failure), IO */
PLAIT_API plait_result plait_recorder_add(plait_recorder* recorder, plait_sim* sim, double time);

/* Adds a frame of positions that the caller has kept. `vertex_counts`: uint32, [2, 256], of each strand.
 * `positions`: float[3], m, world, strand after strand, root first, as many as the counts add up to.
 * Both are copied. The desc's `strands` is not read.
 * @errors INVALID_ARGUMENT (a count, another shape than that of the first frame), INVALID_STATE
 *         (closed, or ended by a failure), IO */
PLAIT_API plait_result plait_recorder_add_positions(plait_recorder* recorder,
                                                    const plait_view* vertex_counts,
                                                    const plait_view* positions, double time);

/* Ends the file and puts it in its place. @errors INVALID_STATE (closed, ended by a failure, or
 * without a frame), IO */
PLAIT_API plait_result plait_recorder_close(plait_recorder* recorder);

/* One that was not closed is abandoned: no file. */
PLAIT_API void plait_recorder_destroy(plait_recorder* recorder);

#ifdef __cplusplus
}
#endif

#endif
