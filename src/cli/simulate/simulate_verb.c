/* gough simulate: forward dynamics under control and disturbance. */
#include "cli/common/command.h"

static const struct argp_option option[] = {
    {"output", OPTION_OUTPUT, "FILE", 0,
     "write the table to FILE: .h5 or .csv by its ending; - is CSV on standard output; may be "
     "given several times",
     0},
    {"json", OPTION_JSON, NULL, 0, "print the summary as JSON", 0},
    {"set", OPTION_SET, "KEY=VALUE", 0,
     "override a key of the study, as in --set control.stiffness=50; may be repeated", 0},
    {"precision", OPTION_PRECISION, "double|quad", 0,
     "compute with 16 or 33 digits (default: double)", 0},
    {"reactions", OPTION_REACTIONS, NULL, 0, "add the constraint reactions to the table", 0},
    {"dimensionless", OPTION_DIMENSIONLESS, NULL, 0,
     "print table and summary in units of R_b, M and sqrt(R_b/g)", 0},
    {"quiet", OPTION_QUIET, NULL, 0, "print errors only", 0},
    {0}};

gough_status simulate_verb(int count, char **argument) {
    static const verb_usage usage = {
        .verb = "simulate",
        .option = option,
        .arguments = "STUDY",
        .text = "Compute the motion under leg forces, control and disturbance (forward dynamics), "
                "and its deviation from the program (the commanded motion).\vSTUDY is a study "
                "file, or - for standard input. The run ends early at the first exceeded limit, at "
                "a singular pose or at a step that does not converge; the results up to that time "
                "are complete and the exit status is 1.",
        .least_files = 1,
        .most_files = 1};
    return run_verb(&usage, true, count, argument);
}
