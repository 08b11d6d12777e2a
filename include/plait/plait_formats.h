/* What files of grooms hold beside strands: guides among them, and sentences about what was read.
 * The conventions are those of plait.h; docs/formats.md has the formats.
 */
#ifndef PLAIT_FORMATS_H
#define PLAIT_FORMATS_H

#include <plait/plait.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Which strands of a file that tells guides from others, as groom_guide of Unreal's schema does. */
typedef enum plait_strand_part {
    PLAIT_STRAND_PART_ALL = 0,
    PLAIT_STRAND_PART_GUIDES = 1,
    PLAIT_STRAND_PART_FOLLOWS = 2, /* the others */
    PLAIT_STRAND_PART_FORCE_32 = 0x7fffffff
} plait_strand_part;

/* plait_groom_load of a part: the guides to be simulated, and the strands that follow them, for a
 * plait_follow_map. @errors as plait_groom_load; BAD_DATA (the file has none of the part), UNSUPPORTED
 * (its format knows no guides) */
PLAIT_API plait_result plait_groom_load_part(const char* path, plait_strand_part part,
                                             const plait_import_options* options,
                                             plait_groom** out);

/* Loads the guides of a file, for plait_sim_create, and its other strands as a map, for plait_sim_desc.follow_map.
 * A strand follows the guides that groom_closest_guides and groom_guide_weights of Unreal's schema name. In a
 * file without these it follows the four nearest guides, as in plait_groom_guides. The caller
 * owns both. @errors as plait_groom_load_part; BAD_DATA (also weights below 0 or without a sum, a guide
 * that is none of the file's or was not kept, two guides of one groom_id, by the follow's number and value).
 * What was repaired of either, and not read, is in the notes of `guides`. */
PLAIT_API plait_result plait_groom_load_guides(const char* path,
                                               const plait_import_options* options,
                                               plait_groom** guides, plait_follow_map** map);

/* What was taken from the groom's file beside its strands, and what of it was not read, in sentences:
 * units and axes it declares, cubic curves that became polylines, properties by name. "" for a groom
 * that is not from .abc or .usda, or where there is nothing to say. Bytes, with the NUL at its end. */
PLAIT_API plait_result plait_groom_read_notes(const plait_groom* groom, char* dst, size_t* size);

#ifdef __cplusplus
}
#endif

#endif
