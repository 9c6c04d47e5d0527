/* gough check FILE.csv: what a file of recorded motion is, and a mapping for motion.samples that reads it. Numbers are in the units
 * of the file. */
#define _POSIX_C_SOURCE 200809L /* strcasecmp */
#include "cli/check/check_file.h"

#include <math.h>
#include <string.h>
#include <strings.h>

#include "cli/common/json.h"
#include "cli/common/paragraph.h"
#include "cli/common/study_messages.h"
#include "cli/common/talk.h"

bool is_motion_file(const char *path) {
    static const char *const endings[] = {".csv", ".tsv", ".txt", ".dat", ".asc"};
    const char *dot = strrchr(path, '.');
    for (size_t i = 0; dot && i < sizeof endings / sizeof *endings; i++)
        if (strcasecmp(dot, endings[i]) == 0) return true;
    return false;
}

static const char *separator_word(char separator) {
    return separator == ','    ? "commas"
           : separator == ';'  ? "semicolons"
           : separator == '\t' ? "tabs"
                               : "blanks";
}

static const char *separator_key(char separator) {
    return separator == ','    ? "comma"
           : separator == ';'  ? "semicolon"
           : separator == '\t' ? "tab"
                               : "blanks";
}

/* ---- text ---- */

static void print_times(const gough_motion_file *file) {
    if (!file->time) {
        printf("  times                no column is certain to have them\n");
        return;
    }
    const gough_motion_column *time = &file->column[file->time - 1];
    const char *unit = *time->unit ? time->unit : "in the unit of the study";
    if (isnan(file->interval)) {
        print_line(stdout,
                   "  times                column %zu, which does not increase from row to row",
                   file->time);
        return;
    }
    print_line(stdout, "  times                column %zu, from %.15g to %.15g, %s", file->time,
               time->least, time->greatest, unit);
    printf("                       rows %s %.6g", file->even ? "each" : "on average every",
           file->interval);
    if (file->time_step > 0) printf(", times in steps of %.3g", file->time_step);
    printf("\n");
}

/* One column: what it is taken for, its range, and what its rounding does. */
static void print_column(const gough_motion_file *file, size_t i) {
    const gough_motion_column *column = &file->column[i];
    const bool time = i + 1 == file->time;
    printf("\n");
    print_line(stdout, "  %zu %s%s%s", i + 1, *column->name ? column->name : "(no name)",
               *column->unit ? ", unit " : "", column->unit);
    if (*column->quantity)
        printf("    read as            %s%s\n",
               strcmp(column->quantity, "t") == 0 ? "the time" : column->quantity,
               column->certain ? "" : ", if the mapping below is used: its name does not say so");
    else
        printf("    read as            nothing\n");
    if (column->numbers < file->rows)
        printf("    numbers            in %zu of %zu rows\n", column->numbers, file->rows);
    if (column->numbers == 0) return;
    printf("    range              %.15g to %.15g\n", column->least, column->greatest);
    if (time || !column->jump_row) return;
    if (column->step > 0)
        printf("    steps              of %.3g", column->step);
    else
        printf("    steps              none visible");
    if (column->step > 0 && isfinite(column->acceleration))
        printf(", which can make accelerations of %.3g per square of the unit of the times",
               column->acceleration);
    printf("\n");
    printf("    greatest change    %.6g from row %zu to row %zu\n", column->jump,
           column->jump_row - 1, column->jump_row);
}

static void print_file(const char *path, const gough_motion_file *file) {
    print_line(stdout,
               "%s is a file of recorded motion: %zu rows of %zu column%s, in units of the file",
               path, file->rows, file->columns, file->columns == 1 ? "" : "s");
    printf("  cells                apart by %s, decimal %s\n", separator_word(file->separator),
           file->decimal == ',' ? "commas" : "points");
    if (file->first > 0)
        printf("  first row            line %zu; %s\n", file->first,
               file->named ? "a row above names the columns" : "no row names the columns");
    print_times(file);
    for (size_t i = 0; i < file->columns; i++) print_column(file, i);
    printf("\n%s\n", file->certain
                         ? "The name alone is enough in a study. The same in full:"
                         : "Which column is what is not certain. A proposal for a study, to be "
                           "checked:");
    print_line(stdout, "motion: {samples: %s}", file->mapping);
}

/* ---- JSON ---- */

static json_t *column_object(const gough_motion_column *column) {
    json_t *one = json_object();
    json_object_set_new(one, "name", json_words(column->name));
    json_object_set_new(one, "unit", json_words(column->unit));
    json_object_set_new(one, "quantity",
                        *column->quantity ? json_string(column->quantity) : json_null());
    json_object_set_new(one, "certain", json_boolean(column->certain));
    json_object_set_new(one, "numbers", json_integer((json_int_t)column->numbers));
    json_object_set_new(one, "least", json_number(column->least));
    json_object_set_new(one, "greatest", json_number(column->greatest));
    json_object_set_new(one, "step", json_number(column->step));
    json_object_set_new(one, "acceleration", json_number(column->acceleration));
    json_object_set_new(one, "jump", json_number(column->jump));
    json_object_set_new(one, "jump_row", json_integer((json_int_t)column->jump_row));
    return one;
}

static json_t *file_object(const gough_motion_file *file) {
    json_t *object = json_object(), *record = json_object(), *columns = json_array();
    for (size_t i = 0; i < file->columns; i++)
        json_array_append_new(columns, column_object(&file->column[i]));
    json_object_set_new(record, "rows", json_integer((json_int_t)file->rows));
    json_object_set_new(record, "separator", json_string(separator_key(file->separator)));
    json_object_set_new(record, "decimal", json_string(file->decimal == ',' ? "comma" : "point"));
    json_object_set_new(record, "first_line", json_integer((json_int_t)file->first));
    json_object_set_new(record, "time",
                        file->time ? json_integer((json_int_t)file->time) : json_null());
    json_object_set_new(record, "interval", json_number(file->interval));
    json_object_set_new(record, "time_step", json_number(file->time_step));
    json_object_set_new(record, "even", json_boolean(file->even));
    json_object_set_new(record, "certain", json_boolean(file->certain));
    json_object_set_new(record, "mapping", json_words(file->mapping));
    json_object_set_new(record, "columns", columns);
    json_object_set_new(object, "verb", json_string("check"));
    json_object_set_new(object, "motion_file", record);
    return object;
}

gough_status check_motion_file(const command_line *line, const char *path, json_t *list) {
    gough_motion_file *file = NULL;
    char *messages = NULL;
    gough_status status = gough_motion_file_read(path, &file, &messages);
    if (status == GOUGH_ERROR_FILE && !messages) complain(line->verb, "out of memory");
    say_study_messages(line->verb, messages);
    if (status != GOUGH_OK) return status;
    if (list)
        json_array_append_new(list, file_object(file));
    else if (line->json)
        status = json_print(file_object(file)) ? GOUGH_ERROR_FILE : GOUGH_OK;
    else if (!line->quiet)
        print_file(path, file);
    gough_motion_file_free(file);
    return status;
}
