/* gough forces: inverse dynamics along the program. */
#include "cli/run/run_study.h"

static const option_group all_group = {
    (const option[]){{.name = "all",
                      .read = read_flag,
                      .text = "list every interval in which a leg exceeds a limit"},
                     {0}},
    NULL, NULL};

static const group_use groups[] = {RUN_GROUPS, USES(all_group, run_line, all, NULL), {0}};

static gough_status run(const void *line) { return run_study(line, false); }

extern const command_verb forces_verb;
const command_verb forces_verb = {
    .name = "forces",
    .arguments = "STUDY",
    .sentence = "the leg forces that the motion of a study needs",
    .text = "Compute the leg forces that the program (the commanded motion) needs, with leg "
            "lengths, rates and powers (inverse dynamics). The summary contains what you need to "
            "size a leg: least and greatest values, between rows too, RMS forces, energy returned "
            "while braking, loads of joints, what friction takes, and the share of each limit that "
            "is used.\vSTUDY is a study file, or - for standard input. If the "
            "program exceeds a limit, the table is still complete and the exit status is 1.",
    .endings = "yaml yml",
    .least_files = 1,
    .most_files = 1,
    .groups = groups,
    .size = sizeof(run_line),
    .run = run};
