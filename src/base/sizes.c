/* Sizes of the public structs by name, for programs in other languages and for structs that keep their size. */
#include "gough/sizes.h"

#include <string.h>

#include "gough/batch.h"
#include "gough/cueing.h"
#include "gough/design.h"
#include "gough/pose.h"
#include "gough/report.h"
#include "gough/sweep.h"
#include "gough/text.h"
#include "gough/tune.h"
#include "gough/workspace.h"

#define SIZE_OF(name)                                                                              \
    { #name, sizeof(name) }

static const struct {
    const char *name;
    size_t size;
} sizes[] = {
    SIZE_OF(gough_acceleration),
    SIZE_OF(gough_active),
    SIZE_OF(gough_actuators),
    SIZE_OF(gough_batch_options),
    SIZE_OF(gough_batch_run),
    SIZE_OF(gough_binding),
    SIZE_OF(gough_bound),
    SIZE_OF(gough_box),
    SIZE_OF(gough_certificate),
    SIZE_OF(gough_column_info),
    SIZE_OF(gough_control),
    SIZE_OF(gough_control_memory),
    SIZE_OF(gough_crossing),
    SIZE_OF(gough_cue),
    SIZE_OF(gough_cueing),
    SIZE_OF(gough_design_key),
    SIZE_OF(gough_design_request),
    SIZE_OF(gough_design_result),
    SIZE_OF(gough_disturbance),
    SIZE_OF(gough_eigenvalue),
    SIZE_OF(gough_end),
    SIZE_OF(gough_end_words),
    SIZE_OF(gough_envelope),
    SIZE_OF(gough_error),
    SIZE_OF(gough_external),
    SIZE_OF(gough_extreme),
    SIZE_OF(gough_felt_gain),
    SIZE_OF(gough_field),
    SIZE_OF(gough_figure),
    SIZE_OF(gough_floquet),
    SIZE_OF(gough_formula),
    SIZE_OF(gough_gains),
    SIZE_OF(gough_initial),
    SIZE_OF(gough_interval),
    SIZE_OF(gough_leg_limits),
    SIZE_OF(gough_leg_summary),
    SIZE_OF(gough_leg_part),
    SIZE_OF(gough_friction),
    SIZE_OF(gough_limits),
    SIZE_OF(gough_largest_box),
    SIZE_OF(gough_leg_bounds),
    SIZE_OF(gough_limiter),
    SIZE_OF(gough_linear_filter),
    SIZE_OF(gough_load),
    SIZE_OF(gough_machine),
    SIZE_OF(gough_map),
    SIZE_OF(gough_map_figure),
    SIZE_OF(gough_map_options),
    SIZE_OF(gough_map_point),
    SIZE_OF(gough_map_range),
    SIZE_OF(gough_map_row),
    SIZE_OF(gough_mode),
    SIZE_OF(gough_model),
    SIZE_OF(gough_motion),
    SIZE_OF(gough_motion_column),
    SIZE_OF(gough_motion_file),
    SIZE_OF(gough_move),
    SIZE_OF(gough_move_fit),
    SIZE_OF(gough_multiplier),
    SIZE_OF(gough_noise),
    SIZE_OF(gough_outcome),
    SIZE_OF(gough_page_template),
    SIZE_OF(gough_period),
    SIZE_OF(gough_piece),
    SIZE_OF(gough_place),
    SIZE_OF(gough_platform),
    SIZE_OF(gough_platform_limits),
    SIZE_OF(gough_pose),
    SIZE_OF(gough_pose_certificate),
    SIZE_OF(gough_pose_single),
    SIZE_OF(gough_poses),
    SIZE_OF(gough_ray),
    SIZE_OF(gough_reach),
    SIZE_OF(gough_record),
    SIZE_OF(gough_record_column),
    SIZE_OF(gough_remark),
    SIZE_OF(gough_resolution),
    SIZE_OF(gough_rest),
    SIZE_OF(gough_quantity),
    SIZE_OF(gough_result_column),
    SIZE_OF(gough_row),
    SIZE_OF(gough_sample),
    SIZE_OF(gough_sampled_edge),
    SIZE_OF(gough_sampled_floquet),
    SIZE_OF(gough_sampled_margins),
    SIZE_OF(gough_sampled_rest),
    SIZE_OF(gough_samples),
    SIZE_OF(gough_sampling),
    SIZE_OF(gough_setting),
    SIZE_OF(gough_simulation),
    SIZE_OF(gough_state),
    SIZE_OF(gough_statistics),
    SIZE_OF(gough_study),
    SIZE_OF(gough_stiffness),
    SIZE_OF(gough_summary),
    SIZE_OF(gough_sweep_key),
    SIZE_OF(gough_sweep_options),
    SIZE_OF(gough_sweep_output),
    SIZE_OF(gough_sweep_range),
    SIZE_OF(gough_sweep_row),
    SIZE_OF(gough_sweep_summary),
    SIZE_OF(gough_table),
    SIZE_OF(gough_threshold),
    SIZE_OF(gough_tolerances),
    SIZE_OF(gough_travel),
    SIZE_OF(gough_tuning),
    SIZE_OF(gough_tuning_exception),
    SIZE_OF(gough_tuning_options),
    SIZE_OF(gough_tuning_point),
    SIZE_OF(gough_units),
    SIZE_OF(gough_unwrapping),
    SIZE_OF(gough_volume),
    SIZE_OF(gough_washout),
    SIZE_OF(gough_workspace),
    SIZE_OF(gough_wrench),
};

size_t gough_struct_size(const char *name) {
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
        if (strcmp(name, sizes[i].name) == 0) return sizes[i].size;
    return 0;
}

gough_status gough_size_check(size_t size, size_t own, const char *name, gough_error *error) {
    if (size == 0 || size == own) return GOUGH_OK;
    return gough_fail(error, GOUGH_ERROR_INPUT,
                      "%s.size is %zu, but this struct has %zu bytes in this library: start from "
                      "%s_default()",
                      name, size, own, name);
}

gough_status gough_size_refuse(void *of_caller, size_t size) {
    memset(of_caller, 0xff, size);
    return GOUGH_ERROR_INPUT;
}
