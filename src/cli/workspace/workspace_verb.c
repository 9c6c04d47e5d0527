/* gough workspace: where a machine can go. */
#include "cli/workspace/workspace_verb.h"

#include <math.h>
#include <string.h>

#include "cli/common/in_and_out.h"
#include "cli/common/talk.h"

/* the shape of workspace.box; without it the travels of all axes */
static void find_shape(workspace_answer *a) {
    const gough_workspace *w = &a->study->model->workspace;
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        a->shape.least[c] = fmin(w->box[c][0], 0), a->shape.greatest[c] = fmax(w->box[c][1], 0);
        a->shape_given |= w->box[c][0] < 0 || w->box[c][1] > 0;
    }
    for (int c = 0; c < GOUGH_COMPONENTS && !a->shape_given; c++)
        a->shape.least[c] = a->travel[c].end[0], a->shape.greatest[c] = a->travel[c].end[1];
}

static void find_rest(workspace_answer *a) {
    const gough_box *box = a->shape_given ? &a->shape : &a->box.box;
    if (gough_workspace_envelope(&a->reach, box, &a->envelope, &a->no_envelope) == GOUGH_OK)
        a->tests += a->envelope.tests;
    if (gough_workspace_volume(&a->reach, a->study->model->workspace.orientation, &a->volume,
                               &a->no_volume) == GOUGH_OK)
        a->tests += a->volume.tests;
    gough_error_say(&a->no_envelope, a->unit);
    gough_error_say(&a->no_volume, a->unit);
}

/* `all`: not only what -o needs */
static void find(workspace_answer *a, bool all) {
    a->status = gough_reach_init(&a->reach, sizeof a->reach, a->study->model, &a->error);
    for (int c = 0; c < GOUGH_COMPONENTS && !a->status; c++) {
        a->status = gough_workspace_travel(&a->reach, c, &a->travel[c], &a->error);
        a->tests += a->travel[c].tests;
    }
    if (a->status || !all) return;
    find_shape(a);
    a->status = gough_workspace_box(&a->reach, &a->shape, &a->box, &a->error);
    a->tests += a->box.tests;
    if (!a->status) find_rest(a);
}

static gough_status tell(const workspace_line *line, workspace_answer *a) {
    gough_error_say(&a->error, a->unit);
    if (a->status)
        complain_of(line->line.verb, a->study, &a->error);
    else if (line->line.outputs.count > 0)
        a->status = workspace_write(line, a);
    if (line->line.json) {
        if (workspace_print_json(a)) return GOUGH_ERROR_FILE;
    } else if (!a->status && !line->line.quiet && !writes_standard(&line->line)) {
        workspace_print(a);
    }
    return a->status;
}

static gough_status run(const void *given) {
    const workspace_line *line = given;
    static workspace_answer answer;
    gough_study *study = NULL;
    gough_status status = check_output(&line->line, NULL);
    if (!status && line->slice[0] != line->slice[1] && line->line.outputs.count == 0) {
        complain(line->line.verb, "give -o FILE for the poses of --slice, such as -o slice.csv");
        status = GOUGH_ERROR_INPUT;
    }
    if (!status) status = read_study(&line->line, line->line.file.word[0], &study);
    if (!status) {
        answer = (workspace_answer){.study = study, .unit = &study->units};
        find(&answer, line->line.json || !line->line.quiet);
        status = tell(line, &answer);
    }
    gough_study_free(study);
    return status;
}

static int component_of(const char *text, size_t length) {
    for (int c = 0; c < GOUGH_COMPONENTS; c++)
        if (strlen(gough_component_name(c)) == length &&
            strncmp(gough_component_name(c), text, length) == 0)
            return c;
    return -1;
}

static void read_slice(const struct argp_state *state, const option *o, const char *text,
                       void *group) {
    int *slice = group;
    const size_t first = strcspn(text, ",");
    (void)o;
    slice[0] = component_of(text, first);
    slice[1] = text[first] ? component_of(text + first + 1, strlen(text + first + 1)) : -1;
    if (slice[0] < 0 || slice[1] < 0 || slice[0] == slice[1])
        usage_error(state,
                    "--slice takes two different components of surge, sway, heave, roll, pitch and "
                    "yaw, as in --slice surge,heave; got '%s'",
                    text);
}

static const option slice_option[] = {
    {.name = "slice",
     .value = "A,B",
     .read = read_slice,
     .text = "with -o, the outline in the plane of two components, such as surge,heave, the others "
             "at home, instead of the surface of the positions"},
    {0}};
static const option_group slice_group = {slice_option, NULL, NULL};

static const group_use groups[] = {USES(slice_group, workspace_line, slice, NULL),
                                   USES_JSON,
                                   USES_SETTINGS,
                                   USES_OUTPUT(TABLE_OUTPUT),
                                   {0}};

extern const command_verb workspace_verb;
const command_verb workspace_verb = {
    .name = "workspace",
    .arguments = "STUDY",
    .sentence = "where a machine can go: travel, boxes, worst values",
    .text =
        "Find how far each axis of a machine reaches, which limit ends its travel, and the "
        "largest box of poses, of the shape workspace.box or of these travels, in which all "
        "combinations of the axes keep all limits: lengths of the legs, swing of the joints, "
        "clearance of the legs, components of the platform, distance from singular poses, and "
        "speeds and forces for the motions and loads of workspace. Then the worst values over "
        "the box, and the volume of the positions. Every pose of the box is certified, not only "
        "samples. -o writes the poses at which lines from home leave the workspace.\vSTUDY is a "
        "study file, or - for standard input. The exit status is 1 if home itself exceeds a limit "
        "or is singular.",
    .endings = "yaml yml",
    .least_files = 1,
    .most_files = 1,
    .groups = groups,
    .size = sizeof(workspace_line),
    .run = run};
