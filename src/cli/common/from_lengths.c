/* Poses from leg lengths for verbs that begin with one. */
#include "cli/common/from_lengths.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/in_and_out.h"
#include "cli/common/memory.h"
#include "cli/common/option_values.h"
#include "cli/common/scale.h"
#include "cli/common/talk.h"

static void read_lengths(const struct argp_state *state, const option *o, const char *text,
                         void *group) {
    lengths_asked *asked = group;
    const char *at = text;
    int count = 0;
    (void)o;
    for (;; at++) {
        const char *end = at + strcspn(at, ",");
        double value;
        if (count == GOUGH_LEGS || !read_decimal(at, end, &value) || !(value > 0))
            usage_error(state,
                        "--lengths takes six lengths above 0, in the study's unit, as in --lengths "
                        "1.2,1.2,1.3,1.3,1.2,1.2; got '%s'",
                        text);
        else
            asked->length[count++] = value;
        at = end;
        if (!*at) break;
    }
    if (count < GOUGH_LEGS)
        usage_error(state, "--lengths takes six lengths, of legs 1 to 6; '%s' has %d", text, count);
    asked->given = true;
}

static const option lengths_option[] = {
    {.name = "lengths", .value = "L1,...,L6", .read = read_lengths}, {0}};

const option_group lengths_group = {lengths_option, NULL, NULL};

/* R · about − about, less the height of home */
static void point_at_home(const gough_model *model, const gough_state *state, double out[3]) {
    const double *about = model->motion.about;
    for (int r = 0; r < 3; r++) {
        out[r] = -about[r] - (r == 2 ? model->machine.platform.height : 0);
        for (int k = 0; k < 3; k++) out[r] += state->rotation[r][k] * about[k];
    }
}

gough_state pose_at(const gough_model *model, const double component[GOUGH_COMPONENTS]) {
    gough_state state = gough_state_home(&model->machine);
    double moved[3];
    gough_rotation_in_order(model->motion.order, component + GOUGH_ROLL, state.rotation);
    point_at_home(model, &state, moved);
    for (int k = 0; k < 3; k++) state.position[k] = component[k] - moved[k];
    return state;
}

void pose_components(const gough_model *model, const gough_state *state,
                     double component[GOUGH_COMPONENTS]) {
    gough_state copy = *state;
    double moved[3];
    point_at_home(model, state, moved);
    for (int k = 0; k < 3; k++) component[k] = state->position[k] + moved[k];
    gough_angles_in_order(model->motion.order, copy.rotation, component + GOUGH_ROLL);
}

gough_status lengths_pose(const char *verb, const gough_study *study, const lengths_asked *asked,
                          double pose[GOUGH_COMPONENTS]) {
    gough_state state = gough_state_home(&study->model->machine);
    gough_error error = {.message = ""};
    double length[GOUGH_LEGS];
    for (int v = 0; v < GOUGH_LEGS; v++)
        length[v] = gough_unit_read(&study->units, GOUGH_UNIT_LENGTH, asked->length[v]);
    const gough_status status = gough_pose_from_lengths(&study->model->machine, length,
                                                        LENGTHS_STEPS, &state, NULL, &error);
    if (status) {
        gough_error_say(&error, &study->units);
        complain(verb,
                 "--lengths, from home: %s. gough pose lists all poses of these lengths (--all)",
                 error.message);
        return status;
    }
    pose_components(study->model, &state, pose);
    for (int c = 0; c < GOUGH_COMPONENTS; c++)
        pose[c] = in_units(&study->units, component_unit(c), pose[c]);
    return GOUGH_OK;
}

/* the settings of the line, then those of the pose */
static void add_settings(command_line *line, const double pose[GOUGH_COMPONENTS],
                         lengths_settings *memory) {
    static const char *const key[GOUGH_COMPONENTS] = {"initial.surge", "initial.sway",
                                                      "initial.heave", "initial.roll",
                                                      "initial.pitch", "initial.yaw"};
    setting_list *list = &memory->settings;
    const size_t before = line->settings.count;
    list->list = allocate((before + GOUGH_COMPONENTS) * sizeof *list->list);
    list->count = before + GOUGH_COMPONENTS;
    for (size_t i = 0; i < before; i++) list->list[i] = line->settings.list[i];
    for (size_t c = 0; c < GOUGH_COMPONENTS; c++) {
        snprintf(memory->value[c], sizeof memory->value[c], "%.17g", pose[c]);
        list->list[before + c] = (gough_setting){.key = key[c], .value = memory->value[c]};
    }
    line->settings = *list;
}

gough_status read_study_at(command_line *line, const char *path, const lengths_asked *asked,
                           lengths_settings *memory, gough_study **study) {
    double pose[GOUGH_COMPONENTS];
    gough_study *first = NULL;
    *memory = (lengths_settings){.value = {""}};
    if (!asked->given) return read_study(line, path, study);
    if (strcmp(path, "-") == 0) {
        complain(line->verb, "--lengths needs a study file, which is read twice; standard input "
                             "can be read only once");
        return GOUGH_ERROR_INPUT;
    }
    command_line quiet = *line; /* what is remarked on is said at the second reading */
    quiet.quiet = true;
    gough_status status = read_study(&quiet, path, &first);
    if (!status) status = lengths_pose(line->verb, first, asked, pose);
    gough_study_free(first);
    if (status) return status;
    add_settings(line, pose, memory);
    return read_study(line, path, study);
}

void lengths_settings_free(lengths_settings *memory) { free(memory->settings.list); }
