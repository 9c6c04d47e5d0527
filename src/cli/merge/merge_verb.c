/* gough merge: the shards of a sweep as one table. */
#include <sys/resource.h>

#include "cli/common/in_and_out.h"
#include "cli/common/interrupt.h"
#include "cli/common/talk.h"
#include "cli/sweep/sweep_report.h"

static gough_status run(const void *given) {
    const command_line *line = given;
    sweep_report report = {.verb = line->verb};
    gough_error error = {0};
    struct rlimit files;
    gough_status status = GOUGH_OK;
    if (!line->outputs.count) {
        complain(line->verb, "-o FILE is missing; it names the table to write");
        status = GOUGH_ERROR_INPUT;
    }
    if (!status) status = check_output(line, NULL);
    for (size_t i = 0; i < line->outputs.count && !status; i++)
        status =
            check_overwriting(line->verb, line->outputs.word[i], line->file.word, line->file.count);
    if (getrlimit(RLIMIT_NOFILE, &files) == 0) { /* all shards are open at once */
        files.rlim_cur = files.rlim_max;
        (void)setrlimit(RLIMIT_NOFILE, &files);
    }
    if (!status) {
        for (size_t i = 0; i < line->outputs.count && !status; i++) {
            interrupt_outputs(line->verb, line->outputs.word, line->outputs.count, i);
            status = gough_sweep_merge(line->file.word, line->file.count, line->outputs.word[i],
                                       &report.summary, &error);
        }
        if (status) complain(line->verb, "%s", error.message);
    }
    if (!status) {
        report.output = line->outputs.word;
        report.outputs = line->outputs.count;
        report.units = report.summary.units;
        status = sweep_tell(line, &report);
        if (!status && report.summary.ended[GOUGH_END_INVALID]) {
            complain(line->verb, "%zu of %zu runs are invalid; the first is run %zu",
                     report.summary.ended[GOUGH_END_INVALID], report.summary.runs,
                     report.summary.first_invalid);
            status = GOUGH_ERROR_NUMERICAL;
        }
    }
    return status;
}

static const group_use groups[] = {USES_OUTPUT(TABLE_OUTPUT), USES_JSON, {0}};

extern const command_verb merge_verb;
const command_verb merge_verb = {
    .name = "merge",
    .arguments = "SHARD...",
    .sentence = "join the shards of a sweep into one table",
    .text = "Join the shards of a sweep into one table, with the same bytes as that of the whole "
            "sweep.\vThe shards may be given in any order. All must be present and belong to the "
            "same sweep.",
    .endings = "shard",
    .least_files = 1,
    .most_files = (size_t)-1,
    .groups = groups,
    .size = sizeof(command_line),
    .run = run};
