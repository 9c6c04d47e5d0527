/* gough pose --samples: a record of leg lengths followed row by row, (pose-7), into a table of poses. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/json.h"
#include "cli/common/memory.h"
#include "cli/common/paragraph.h"
#include "cli/common/scale.h"
#include "cli/common/talk.h"
#include "cli/pose/pose_verb.h"

/* columns of the table: t, surge … yaw, error, margin, condition */
enum { COLUMN_ERROR = 1 + GOUGH_COMPONENTS, COLUMN_MARGIN, COLUMN_CONDITION, RECORD_COLUMNS };

typedef struct pose_record {
    const pose_line *line;
    const gough_study *study;
    const gough_units *unit;
    gough_table *samples;
    const double *time, *length[GOUGH_LEGS]; /* in units of the study */
    double acceleration[GOUGH_LEGS];         /* bounds, in units of the run */
    bool given;                              /* by the study, all of them */
    double length_error[GOUGH_LEGS];
    gough_table *table;
    double *column[RECORD_COLUMNS];
    size_t rows; /* certain ones */
    int steps;
    double least_margin, largest_error;
    gough_state last; /* the last pose that is certain */
    gough_error error;
    bool lost;
} pose_record;

/* ---- reading ---- */

static gough_status refuse(const pose_record *r, const char *sentence) {
    complain_at(r->line->line.verb, r->line->asked.samples, sentence);
    return GOUGH_ERROR_INPUT;
}

static gough_status check_row(const pose_record *r, size_t row) {
    char sentence[200];
    bool good = isfinite(r->time[row]) && (row == 0 || r->time[row] > r->time[row - 1]);
    if (!good) {
        snprintf(sentence, sizeof sentence,
                 "row %zu: the time t = %.9g%s must be finite and greater than that of the row "
                 "before",
                 row + 1, r->time[row], unit_word(r->unit, GOUGH_UNIT_TIME));
        return refuse(r, sentence);
    }
    for (int v = 0; v < GOUGH_LEGS; v++) {
        if (r->length[v][row] > 0 && isfinite(r->length[v][row])) continue;
        snprintf(sentence, sizeof sentence, "row %zu: the length l%d = %.9g%s must be above 0",
                 row + 1, v + 1, r->length[v][row], unit_word(r->unit, GOUGH_UNIT_LENGTH));
        return refuse(r, sentence);
    }
    return GOUGH_OK;
}

static gough_status read_samples(pose_record *r) {
    gough_error error = {.message = ""};
    gough_status status = gough_table_read(r->line->asked.samples, &r->samples, &error);
    if (status) {
        complain(r->line->line.verb, "%s", error.message);
        return status;
    }
    r->time = gough_table_column(r->samples, "t");
    if (!r->time) return refuse(r, "the column t, the time, is missing");
    for (int v = 0; v < GOUGH_LEGS; v++) {
        char name[] = "l1";
        char sentence[100];
        name[1] = (char)('1' + v);
        r->length[v] = gough_table_column(r->samples, name);
        snprintf(sentence, sizeof sentence,
                 "the column %s, the length of leg %d, is missing; needed are t and l1 to l6", name,
                 v + 1);
        if (!r->length[v]) return refuse(r, sentence);
    }
    if (r->samples->rows == 0) return refuse(r, "there is no row of numbers");
    for (size_t row = 0; row < r->samples->rows && !status; row++) status = check_row(r, row);
    return status;
}

static double length_at(const pose_record *r, int v, size_t row) {
    return gough_unit_read(r->unit, GOUGH_UNIT_LENGTH, r->length[v][row]);
}

static double time_at(const pose_record *r, size_t row) {
    return gough_unit_read(r->unit, GOUGH_UNIT_TIME, r->time[row]);
}

/* The study's bounds; for a leg without one twice the largest second difference of the record. */
static void find_accelerations(pose_record *r) {
    const gough_model *model = r->study->model;
    const gough_limits l = gough_limits_of(&model->machine, &model->motion);
    r->given = true;
    for (int v = 0; v < GOUGH_LEGS; v++) {
        double most = 0;
        r->acceleration[v] = l.acceleration[v];
        if (isfinite(l.acceleration[v])) continue;
        r->given = false;
        for (size_t i = 2; i < r->samples->rows; i++) {
            const double before = time_at(r, i - 1) - time_at(r, i - 2),
                         after = time_at(r, i) - time_at(r, i - 1);
            const double change = (length_at(r, v, i) - length_at(r, v, i - 1)) / after -
                                  (length_at(r, v, i - 1) - length_at(r, v, i - 2)) / before;
            most = fmax(most, fabs(2 * change / (before + after)));
        }
        r->acceleration[v] = 2 * most;
    }
}

/* ---- following ---- */

static void name_columns(pose_record *r) {
    r->table = gough_table_new(r->study->title, "pose", RECORD_COLUMNS, r->samples->rows);
    if (!r->table) out_of_memory();
    for (size_t c = 0; c < RECORD_COLUMNS; c++) {
        const int component = (int)c - 1;
        const char *name = c == 0                  ? "t"
                           : c == COLUMN_ERROR     ? "error"
                           : c == COLUMN_MARGIN    ? "margin"
                           : c == COLUMN_CONDITION ? "condition"
                                                   : gough_component_name(component);
        const gough_unit unit = c == 0              ? GOUGH_UNIT_TIME
                                : c < COLUMN_ERROR  ? component_unit(component)
                                : c == COLUMN_ERROR ? GOUGH_UNIT_LENGTH
                                                    : GOUGH_UNIT_NONE;
        const char *word = unit == GOUGH_UNIT_NONE ? "" : unit_word(r->unit, unit);
        r->column[c] = gough_table_name(r->table, c, name, *word ? word + 1 : "");
        if (!r->column[c]) out_of_memory();
    }
}

static void put_row(pose_record *r, const gough_pose_certificate *c) {
    const gough_model *model = r->study->model;
    double component[GOUGH_COMPONENTS], condition;
    pose_components(model, &r->last, component);
    gough_conditioning(&model->machine, &r->last, &condition, NULL);
    r->column[0][r->rows] = r->time[r->rows];
    for (int k = 0; k < GOUGH_COMPONENTS; k++)
        r->column[1 + k][r->rows] = in_units(r->unit, component_unit(k), component[k]);
    r->column[COLUMN_ERROR][r->rows] = in_units(r->unit, GOUGH_UNIT_LENGTH, c->position_error);
    r->column[COLUMN_MARGIN][r->rows] = c->margin;
    r->column[COLUMN_CONDITION][r->rows] = condition;
    r->steps += c->steps;
    if (r->rows > 0) r->least_margin = fmin(r->least_margin, c->margin);
    r->largest_error = fmax(r->largest_error, c->position_error);
    r->rows++;
}

/* The first row from home or --near along a straight line; each other from the one before. */
static gough_status follow_record(pose_record *r) {
    const gough_machine *machine = &r->study->model->machine;
    r->last = pose_begin(&r->line->asked, r->study);
    r->least_margin = 1;
    while (r->rows < r->samples->rows) {
        double length[GOUGH_LEGS], tube[GOUGH_LEGS];
        gough_pose_certificate c;
        const double step = r->rows ? time_at(r, r->rows) - time_at(r, r->rows - 1) : 0;
        for (int v = 0; v < GOUGH_LEGS; v++) {
            length[v] = length_at(r, v, r->rows);
            tube[v] = r->acceleration[v] * step * step / 8 + r->length_error[v];
        }
        const gough_status status =
            gough_pose_tube(machine, length, tube, r->rows ? POSE_ROW_STEPS : LENGTHS_STEPS,
                            &r->last, &c, &r->error);
        if (status == GOUGH_ERROR_NUMERICAL) {
            r->lost = true;
            return GOUGH_OK;
        }
        if (status) return status;
        put_row(r, &c);
    }
    return GOUGH_OK;
}

/* ---- telling ---- */

static void say_lost(const pose_record *r) {
    char lengths[200] = "";
    size_t used = 0;
    for (int v = 0; v < GOUGH_LEGS; v++)
        used += (size_t)snprintf(lengths + used, sizeof lengths - used, "%s%.9g", v ? "," : "",
                                 r->length[v][r->rows]);
    complain(r->line->line.verb,
             "%s: the pose is lost before t = %.9g%s, row %zu: %s. The least singular value of the "
             "last pose that is certain is %.3g. --lengths %s --all lists the poses of that row",
             r->line->asked.samples, r->time[r->rows], unit_word(r->unit, GOUGH_UNIT_TIME),
             r->rows + 1, r->error.message,
             pose_least_singular(&r->study->model->machine, &r->last), lengths);
}

static void print_record(const pose_record *r) {
    const char *length = unit_word(r->unit, GOUGH_UNIT_LENGTH);
    double most = 0, error = 0;
    for (int v = 0; v < GOUGH_LEGS; v++) {
        most = fmax(most, r->acceleration[v]);
        error = fmax(error, r->length_error[v]);
    }
    print_title(stdout, r->study->title);
    printf("%s\n\n", units_sentence(r->study, r->unit).text);
    printf("  %-20s %zu of %zu\n", "certain rows", r->rows, r->samples->rows);
    printf("  %-20s %.4g%s at most: %s\n", "acceleration of legs",
           in_units(r->unit, GOUGH_UNIT_ACCELERATION, most),
           unit_word(r->unit, GOUGH_UNIT_ACCELERATION),
           r->given ? "platform.legs.max_acceleration" : "twice that between the rows");
    printf("  %-20s %.3g%s at most\n", "error of lengths",
           in_units(r->unit, GOUGH_UNIT_LENGTH, error), length);
    if (r->rows > 1)
        printf("  %-20s %.3g (1: no change; below 0: several steps from row to row)\n",
               "least margin", r->least_margin);
    if (r->rows > 0)
        printf("  %-20s %.3g%s at most, for the lengths as recorded\n", "error of positions",
               in_units(r->unit, GOUGH_UNIT_LENGTH, r->largest_error), length);
}

static json_t *lost_json(const pose_record *r) {
    json_t *lost = json_object();
    double component[GOUGH_COMPONENTS];
    pose_components(r->study->model, &r->last, component);
    for (int k = 0; k < GOUGH_COMPONENTS; k++)
        component[k] = in_units(r->unit, component_unit(k), component[k]);
    json_object_set_new(lost, "before", json_number(r->time[r->rows]));
    json_object_set_new(lost, "row", json_integer((json_int_t)r->rows + 1));
    json_object_set_new(lost, "pose", json_numbers(component, GOUGH_COMPONENTS));
    json_object_set_new(lost, "least_singular_value",
                        json_number(pose_least_singular(&r->study->model->machine, &r->last)));
    return lost;
}

static int print_json(const pose_record *r) {
    json_t *record = json_object();
    double acceleration[GOUGH_LEGS], error[GOUGH_LEGS];
    for (int v = 0; v < GOUGH_LEGS; v++) {
        acceleration[v] = in_units(r->unit, GOUGH_UNIT_ACCELERATION, r->acceleration[v]);
        error[v] = in_units(r->unit, GOUGH_UNIT_LENGTH, r->length_error[v]);
    }
    json_object_set_new(record, "rows", json_integer((json_int_t)r->samples->rows));
    json_object_set_new(record, "certain", json_integer((json_int_t)r->rows));
    json_object_set_new(record, "acceleration", json_numbers(acceleration, GOUGH_LEGS));
    json_object_set_new(record, "acceleration_given", json_boolean(r->given));
    json_object_set_new(record, "length_error", json_numbers(error, GOUGH_LEGS));
    json_object_set_new(record, "least_margin", json_number(r->rows > 1 ? r->least_margin : NAN));
    json_object_set_new(
        record, "largest_error",
        json_number(r->rows ? in_units(r->unit, GOUGH_UNIT_LENGTH, r->largest_error) : NAN));
    json_object_set_new(record, "lost", r->lost ? lost_json(r) : json_null());
    json_t *object = pose_object(r->study, record);
    json_object_set_new(object, "steps", json_integer(r->steps));
    json_object_set_new(object, "message", json_words(r->lost ? r->error.message : ""));
    return json_print(object);
}

static gough_status write_tables(const pose_record *r) {
    const word_list *outputs = &r->line->line.outputs;
    gough_status status = GOUGH_OK;
    gough_error error = {.message = ""};
    r->table->rows = r->rows;
    for (size_t i = 0; i < outputs->count && !status; i++)
        status = gough_table_write(r->table, r->study->text, outputs->word[i], &error);
    r->table->rows = r->samples->rows;
    if (status) complain(r->line->line.verb, "%s", error.message);
    return status;
}

static gough_status tell(pose_record *r) {
    gough_error_say(&r->error, r->unit);
    const gough_status status = write_tables(r);
    if (status) return status;
    if (r->lost) say_lost(r);
    if (r->line->line.json) {
        if (print_json(r)) return GOUGH_ERROR_FILE;
    } else if (!r->line->line.quiet && strcmp(r->line->line.outputs.word[0], "-") != 0) {
        print_record(r);
    }
    return r->lost ? GOUGH_ERROR_NUMERICAL : GOUGH_OK;
}

gough_status pose_of_record(const pose_line *line, const gough_study *study) {
    pose_record r = {.line = line, .study = study, .unit = &study->units};
    gough_status status;
    for (int v = 0; v < GOUGH_LEGS; v++)
        r.length_error[v] =
            line->asked.given_length_error
                ? gough_unit_read(r.unit, GOUGH_UNIT_LENGTH, line->asked.length_error)
                : study->model->machine.platform.tolerances.length[v];
    status = read_samples(&r);
    if (!status) {
        find_accelerations(&r);
        name_columns(&r);
        status = follow_record(&r);
        if (!status) status = tell(&r);
    }
    gough_table_free(r.table);
    gough_table_free(r.samples);
    return status;
}
