/* gough design: keys of a study chosen so that a required box is certified. */
#include "cli/design/design_verb.h"

#include <stdlib.h>
#include <string.h>

#include "cli/common/in_and_out.h"
#include "cli/common/interrupt.h"
#include "cli/common/progress.h"
#include "cli/common/scale.h"
#include "cli/common/talk.h"

/* ---- what both outputs need ---------------------------------------------------------------------------------------- */

bool design_weighs(const design_answer *a) {
    int aims = 0;
    for (int k = 0; k < GOUGH_AIMS; k++) aims += a->request.weight[k] > 0;
    return aims > 1;
}

gough_aim design_aim(const design_answer *a) {
    int k = 0;
    while (k < GOUGH_AIMS - 1 && !(a->request.weight[k] > 0)) k++;
    return (gough_aim)k;
}

gough_unit aim_unit(gough_aim aim) {
    static const gough_unit unit[GOUGH_AIMS] = {GOUGH_UNIT_FORCE, GOUGH_UNIT_LENGTH,
                                                GOUGH_UNIT_SPEED, GOUGH_UNIT_LENGTH};
    return unit[aim];
}

const char *key_word(const design_answer *a, size_t key) {
    return unit_word(a->unit, gough_unit_of_field(a->key[key].unit));
}

workspace_answer design_workspace(const design_answer *a) {
    workspace_answer w = {.study = a->study,
                          .unit = a->unit,
                          .reach = a->reach,
                          .shape_given = true,
                          .shape = a->result.box,
                          .envelope = a->result.envelope};
    if (!a->result.bounded)
        gough_fail(&w.no_envelope, GOUGH_ERROR_NUMERICAL,
                   "no bound of the forces was found with the boxes that this search may test");
    return w;
}

/* ---- the verb ------------------------------------------------------------------------------------------------------ */

static int look(void *context, double part) {
    progress_update(context, part);
    return 0;
}

static void find(const command_line *line, gough_design_study *design, design_answer *a) {
    a->key = gough_design_study_keys(design, &a->keys);
    a->status = gough_design_study_request(design, &a->request, sizeof a->request);
    if (!a->status)
        a->status = gough_reach_init(&a->reach, sizeof a->reach, a->study->model, &a->error);
    if (a->status) return;
    progress bar = progress_begin(line->verb, 1, line->quiet);
    a->request.progress = look;
    a->request.progress_context = &bar;
    interrupt_says(line->verb, "stopped before the end; nothing was written");
    a->status = gough_design(&a->request, &a->result, &a->error);
    progress_end(&bar);
}

static gough_status write_study(const command_line *line, gough_design_study *design,
                                const design_answer *a) {
    const char *path = line->outputs.word[0], *text;
    gough_error error = {.message = ""};
    gough_status status = gough_design_study_text(design, a->result.value, &text, &error);
    if (!status) status = gough_write_file(path, text, strlen(text), &error);
    if (status) complain(line->verb, "%s", error.message);
    return status;
}

static gough_status tell(const command_line *line, gough_design_study *design, design_answer *a) {
    const bool standard = writes_standard(line);
    gough_error_say(&a->error, a->unit);
    if (a->status)
        complain_of(line->verb, a->study, &a->error);
    else if (line->outputs.count > 0)
        a->status = write_study(line, design, a);
    if (line->json) {
        if (design_print_json(a)) return GOUGH_ERROR_FILE;
    } else if (a->status != GOUGH_ERROR_INPUT && !line->quiet && !standard) {
        design_print(a);
        if (!a->status && line->outputs.count > 0)
            print_line(stdout, "wrote %s", line->outputs.word[0]);
    }
    return a->status;
}

static gough_status run(const void *given) {
    const command_line *line = given;
    static design_answer answer;
    gough_study *study = NULL;
    gough_design_study *design = NULL;
    gough_status status = check_study_output(line);
    if (!status) status = read_study(line, line->file.word[0], &study);
    if (!status) status = read_design(line, study, &design);
    if (!status) {
        answer = (design_answer){.study = study, .unit = &study->units};
        find(line, design, &answer);
        status = tell(line, design, &answer);
    }
    gough_design_study_free(design);
    gough_study_free(study);
    return status;
}

static const group_use groups[] = {
    USES_JSON,
    USES_SETTINGS,
    USES_OUTPUT("write the study with the values found to FILE, whose name ends in .yaml or .yml; "
                "comments stay; - is standard output"),
    {0}};

extern const command_verb design_verb;
const command_verb design_verb = {
    .name = "design",
    .arguments = "STUDY",
    .sentence = "a better machine, certified over a box of poses",
    .text =
        "Choose values of the keys under design.vary, each between its bounds, so that the box of "
        "poses workspace.box is certified with the motions and loads of workspace, and so that "
        "design.minimize is least: the greatest force, stroke or speed of a leg, the footprint of "
        "the machine, or a weighted sum of these. Prints the values, what keeps the design from "
        "being better, and the worst values over the box. -o writes a study to go on "
        "with.\vSTUDY is a study file, or - for standard input. The exit status is 1 if no values "
        "between the bounds meet the requirement.",
    .endings = "yaml yml",
    .least_files = 1,
    .most_files = 1,
    .groups = groups,
    .size = sizeof(command_line),
    .run = run};
