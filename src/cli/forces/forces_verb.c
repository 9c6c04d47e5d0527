/* gough forces: inverse dynamics along the program. */
#include "cli/common/command.h"

static const struct argp_option option[] = {
    {"output", OPTION_OUTPUT, "FILE", 0,
     "write the table to FILE: .h5 or .csv by its ending; - is CSV on standard output; may be "
     "given several times",
     0},
    {"json", OPTION_JSON, NULL, 0, "print the summary as JSON", 0},
    {"set", OPTION_SET, "KEY=VALUE", 0,
     "override a key of the study, as in --set load.mass=2; may be repeated", 0},
    {"precision", OPTION_PRECISION, "double|quad", 0,
     "compute with 16 or 33 digits (default: double)", 0},
    {"reactions", OPTION_REACTIONS, NULL, 0, "add the constraint reactions to the table", 0},
    {"dimensionless", OPTION_DIMENSIONLESS, NULL, 0,
     "print table and summary in units of R_b, M and sqrt(R_b/g)", 0},
    {"all", OPTION_ALL, NULL, 0, "list every interval in which a leg exceeds a limit", 0},
    {"quiet", OPTION_QUIET, NULL, 0, "print errors only", 0},
    {0}};

gough_status forces_verb(int count, char **argument) {
    static const verb_usage usage = {
        .verb = "forces",
        .option = option,
        .arguments = "STUDY",
        .text =
            "Compute the leg forces that the program (the commanded motion) needs, with leg "
            "lengths, rates and powers (inverse dynamics). The summary contains what you need to "
            "size a leg: least and greatest values, between rows too, RMS forces, and the share of "
            "each limit that is used.\vSTUDY is a study file, or - for standard input. If the "
            "program exceeds a limit, the table is still complete and the exit status is 1.",
        .least_files = 1,
        .most_files = 1};
    return run_verb(&usage, false, count, argument);
}
