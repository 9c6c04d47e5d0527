/* gough simulate: forward dynamics under control and disturbance. */
#include "cli/run/run_study.h"

static const option drive_option[] = {
    {.name = "actuators",
     .read = read_flag,
     .at = offsetof(run_options, actuators),
     .text = "add commands, measured lengths and what holds the drives back to the table"},
    {0}};

static const option_group drive_group = {drive_option, NULL, NULL};

static const group_use groups[] = {
    RUN_GROUPS,
    USES(drive_group, run_line, run, NULL),
    USES(lengths_group, run_line, start,
         "start in the pose of these six leg lengths, joint to joint, in the unit of the study, "
         "that is joined to home, as initial has it"),
    {0}};

static gough_status run(const void *line) { return run_study(line, true); }

extern const command_verb simulate_verb;
const command_verb simulate_verb = {
    .name = "simulate",
    .arguments = "STUDY",
    .sentence = "the motion under leg forces, control, disturbances",
    .text = "Compute the motion under leg forces, control and disturbance (forward dynamics), "
            "and its deviation from the program (the commanded motion).\vSTUDY is a study "
            "file, or - for standard input. The run ends early at the first exceeded limit, at "
            "a singular pose or at a step that does not converge; the results up to that time "
            "are complete and the exit status is 1.",
    .endings = "yaml yml",
    .least_files = 1,
    .most_files = 1,
    .groups = groups,
    .size = sizeof(run_line),
    .run = run};
