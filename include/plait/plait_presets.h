/* Kinds of hair by name: "curly", "bob", "short_fur". A preset is a list of values of the parameters that
 * plait_params_list names; assets/presets has one file for each, with the sources of its values.
 * docs/presets.md shows them. The conventions are those of plait.h.
 */
#ifndef PLAIT_PRESETS_H
#define PLAIT_PRESETS_H

#include <plait/plait.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Texts are static. */
typedef struct plait_preset_info {
    uint32_t struct_size;
    const char* name;  /* as plait_sim_set_preset takes it */
    const char* text;  /* one sentence: what hair it is */
    const char* groom; /* the hairstyle of plait-groom that it was tried on */
} plait_preset_info;
PLAIT_STRUCT(plait_preset_info)

/* All of them, by name: a list. */
PLAIT_API plait_result plait_presets_list(plait_preset_info* dst, size_t* count);

/* A value of a preset. */
typedef struct plait_preset_value {
    uint32_t struct_size;
    const char* param; /* its name, as plait_sim_set_param takes it; static */
    double values[4];
    uint32_t count; /* of `values` */
} plait_preset_value;
PLAIT_STRUCT(plait_preset_value)

/* Those of the preset `name`: a list. For who starts from a preset, in a desc or in a material of several.
 * @errors NOT_FOUND */
PLAIT_API plait_result plait_preset_read(const char* name, plait_preset_value* dst, size_t* count);

/* From the next step on hair is of that kind. Sets the material, `drag` and `groom` of the params, and grid,
 * volume and wetness: to the values of the preset, or, where it has none, to their defaults, and the
 * feature off. Gravity and all else stay. Hair of "wet" is wet at once. Waits as
 * plait_sim_set_materials does.
 * @errors NOT_FOUND, INVALID_STATE (model tressfx, or strands of several materials) */
PLAIT_API plait_result plait_sim_set_preset(plait_sim* sim, const char* name);

#ifdef __cplusplus
}
#endif

#endif
