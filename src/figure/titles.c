/* What stands above a figure: the title of its tables, and a note beside it on how the run ended or in which units tables are. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "figure/builder.h"

/* The common title: the figure's, or the tables' where they agree. */
static void choose_title(builder *b) {
    const char *title = b->figure->title != NULL ? b->figure->title : b->tables[0]->title;
    for (size_t t = 1; t < b->table_count && b->figure->title == NULL; t++) {
        if (strcmp(b->tables[t]->title, title) != 0) title = "";
    }
    snprintf(b->sheet->title, sizeof b->sheet->title, "%s", title);
}

/* What gough_cause_name() stands for. */
static const char *words_of_cause(const char *cause) {
    static const char *const known[][2] = {
        {"leg_short", "a leg too short"},
        {"leg_long", "a leg too long"},
        {"leg_speed", "a leg too fast"},
        {"leg_force", "a leg overloaded"},
        {"leg_no_length", "joints of a leg meet"},
        {"singular", "singular pose"},
        {"not_finite", "a number not finite"},
        {"no_convergence", "no convergence"},
        {"leg_acceleration", "a leg's acceleration too great"},
        {"base_swing", "a leg turned too far at the base"},
        {"top_swing", "a leg turned too far at the top"},
        {"platform_pose", "the platform out of its range"},
        {"platform_speed", "the platform too fast"},
        {"platform_acceleration", "the platform's acceleration too great"}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        if (strcmp(cause, known[i][0]) == 0) return known[i][1];
    return cause;
}

/* How a single run ended, where it did not reach its duration; of forces, which go on, the limit that they exceed. In the table's
 * own sentence where it has one. */
static void note_end(builder *b) {
    const gough_table *table = b->tables[0];
    if (builder_compares(b) || table->end_cause[0] == '\0' || !isfinite(table->end_time) ||
        strcmp(table->end_cause, "done") == 0)
        return;
    b->sheet->alarming = true;
    if (table->end_message != NULL && table->end_message[0] != '\0') {
        snprintf(b->sheet->note, sizeof b->sheet->note, "%s", table->end_message);
        return;
    }
    const double *time = gough_table_column(table, "t");
    const char *unit = builder_unit(b, "t");
    const bool bare = unit[0] == '\0' || strcmp(unit, "1") == 0;
    /* forces along a program are computed to its end, whatever limits they exceed on the way */
    const bool limit = strncmp(table->end_cause, "leg_", 4) == 0;
    const bool beyond = limit && time != NULL && table->rows > 0 &&
                        time[table->rows - 1] > table->end_time * (1 + 1e-9);
    snprintf(b->sheet->note, sizeof b->sheet->note, "%s t = %.6g%s%s: %.60s",
             beyond ? "first limit exceeded at" : "ended at", table->end_time, bare ? "" : " ",
             bare ? "" : unit, words_of_cause(table->end_cause));
}

void builder_title(builder *b) {
    choose_title(b);
    note_end(b);
    if (builder_mixes_units(b)) {
        b->sheet->alarming = true;
        snprintf(b->sheet->note, sizeof b->sheet->note,
                 "each in its own units: compare shapes only");
    }
}
