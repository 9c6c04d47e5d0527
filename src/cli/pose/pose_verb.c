/* gough pose: the pose from leg lengths (forward kinematics). */
#include "cli/pose/pose_verb.h"

#include <math.h>
#include <string.h>

#include "cli/common/in_and_out.h"
#include "cli/common/option_values.h"
#include "cli/common/talk.h"

static void read_near(const struct argp_state *state, const option *o, const char *text,
                      void *group) {
    pose_asked *asked = group;
    gough_error error = {.message = ""};
    (void)o;
    asked->given_near = true;
    if (!read_pose("near", text, asked->near, &error)) usage_error(state, "%s", error.message);
}

static void read_length_error(const struct argp_state *state, const option *o, const char *text,
                              void *group) {
    pose_asked *asked = group;
    asked->given_length_error = true;
    if (!read_decimal(text, text + strlen(text), &asked->length_error) ||
        !(asked->length_error >= 0))
        usage_error(state, "--%s takes a length of 0 or more, in the study's unit; got '%s'",
                    o->name, text);
}

static const option pose_option[] = {
    {.name = "near",
     .value = "C=X,...",
     .many = true,
     .read = read_near,
     .text =
         "the pose joined to this one instead of home, given by its components from home, as in "
         "surge=0.1,yaw=5"},
    {.name = "all",
     .read = read_flag,
     .at = offsetof(pose_asked, all),
     .text = "every pose of these lengths, and whether it is proved that there are no others"},
    {.name = "samples",
     .value = "FILE",
     .choices = CHOICES_FILES,
     .read = read_word,
     .at = offsetof(pose_asked, samples),
     .text =
         "the poses of recorded lengths, a table with the columns t and l1 to l6 (CSV or HDF5); "
         "give -o for the table of poses"},
    {.name = "length-error",
     .value = "L",
     .read = read_length_error,
     .text = "greatest error of a recorded length, in the unit of the study (default: "
             "pose.length_error of the study)"},
    {0}};

static const option_group pose_group = {pose_option, NULL, NULL};

static gough_status refuse(const pose_line *line, const char *sentence) {
    complain(line->line.verb, "%s", sentence);
    return GOUGH_ERROR_INPUT;
}

/* Options that go together. */
static gough_status check_asked(const pose_line *line) {
    const pose_asked *asked = &line->asked;
    const bool outputs = line->line.outputs.count > 0;
    if (asked->lengths.given == (asked->samples != NULL))
        return refuse(line, "give either --lengths, for one set of lengths, or --samples, for a "
                            "record of them");
    if (asked->all && asked->samples)
        return refuse(line, "--all lists the poses of --lengths; a record has one pose a row");
    if (asked->all && asked->given_near)
        return refuse(line, "--near says where a pose is followed from; --all lists all poses");
    if (asked->given_length_error && !asked->samples)
        return refuse(line, "--length-error is that of the lengths of --samples");
    if (outputs && !asked->samples)
        return refuse(line, "-o writes the poses of --samples; use --json for those of --lengths");
    if (asked->samples && !outputs)
        return refuse(line, "give -o FILE for the poses of --samples, such as -o poses.csv");
    return GOUGH_OK;
}

static gough_status run(const void *given) {
    const pose_line *line = given;
    gough_study *study = NULL;
    gough_status status = check_asked(line);
    if (!status) status = check_output(&line->line, NULL);
    for (size_t i = 0; i < line->line.outputs.count && !status; i++)
        status =
            check_overwriting(line->line.verb, line->line.outputs.word[i], &line->asked.samples, 1);
    if (!status) status = read_study(&line->line, line->line.file.word[0], &study);
    if (!status)
        status = line->asked.samples ? pose_of_record(line, study) : pose_of_lengths(line, study);
    gough_study_free(study);
    return status;
}

static const group_use groups[] = {USES(lengths_group, pose_line, asked.lengths,
                                        "the pose of these six leg lengths, joint to joint, in the "
                                        "unit of the study, that is joined to home"),
                                   USES(pose_group, pose_line, asked, NULL),
                                   USES_JSON,
                                   USES_SETTINGS,
                                   USES_OUTPUT(TABLE_OUTPUT),
                                   {0}};

extern const command_verb pose_verb;
const command_verb pose_verb = {
    .name = "pose",
    .arguments = "STUDY",
    .sentence = "the pose from leg lengths, with a certificate",
    .text =
        "Find the pose of a machine from its six leg lengths (forward kinematics). The pose is "
        "followed from home, or from --near, along a straight line of the squared lengths, with "
        "a proof that no singular pose lies between; if it cannot be proved, the answer is "
        "where it ends, never a pose of another branch. --all lists all poses of the lengths. "
        "--samples follows a record, whatever the lengths do between its rows within their "
        "greatest acceleration.\vSTUDY is a study file, or - for standard input. If a pose cannot "
        "be certified, or no pose has the lengths, the exit status is 1; the rows of a record up "
        "to there are written.",
    .endings = "yaml yml",
    .least_files = 1,
    .most_files = 1,
    .groups = groups,
    .size = sizeof(pose_line),
    .run = run};
