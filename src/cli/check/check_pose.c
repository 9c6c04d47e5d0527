/* A pose of the machine at rest for reading and as JSON, in the study's units. Forces are those that hold it there; angles of the
 * matrices are in radians whatever the study's are (in SI, N/m, N/rad, N and N m/rad). */
#include "cli/check/check_pose.h"

#include <math.h>
#include <string.h>

#include "cli/check/check_resolution.h"
#include "cli/common/json.h"
#include "cli/common/leg_table.h"
#include "cli/common/scale.h"
#include "cli/common/talk.h"

/* below this part of the largest number of its block, an element of a matrix is rounding */
static const double NOTHING = 1e-12;

void pose_view_find(const gough_model *model, const gough_units *unit, pose_view *view) {
    double component[GOUGH_COMPONENTS];
    for (int c = 0; c < GOUGH_COMPONENTS; c++)
        component[c] = gough_unit_read(unit, component_unit(c), view->pose[c]);
    view->why = (gough_error){.message = ""};
    view->found = gough_stiffness_at_rest(model, component, &view->at, &view->why) == GOUGH_OK;
    gough_error_say(&view->why, unit);
}

/* Shares of a leg's stroke and of its greatest or least force, in percent; NaN without such a limit. */
static double stroke_share(const gough_limits *limits, int v, double length) {
    const double *end = limits->length[v];
    return end[0] > 0 && isfinite(end[1]) ? 100 * (length - end[0]) / (end[1] - end[0]) : NAN;
}

static double force_share(const gough_limits *limits, int v, double force) {
    const double end = limits->force[v][force > 0];
    return isfinite(end) ? 100 * force / end : NAN;
}

/* Whether length or force of a leg is beyond its limits. */
static bool is_beyond(const gough_limits *limits, const gough_stiffness *at, int v) {
    return at->length[v] < limits->length[v][0] || at->length[v] > limits->length[v][1] ||
           at->force[v] < limits->force[v][0] || at->force[v] > limits->force[v][1];
}

static void print_legs(FILE *stream, const gough_model *model, const gough_units *unit,
                       const pose_view *view) {
    const gough_limits limits = gough_limits_of(&model->machine, &model->motion);
    const table_heading length = heading_of("length", unit_word(unit, GOUGH_UNIT_LENGTH)),
                        force = heading_of("static force", unit_word(unit, GOUGH_UNIT_FORCE));
    table_column column[] = {{"", length.text, {0}, 6},
                             {"", "of stroke %", {0}, 3},
                             {"", force.text, {0}, 6},
                             {"", "of greatest %", {0}, 3},
                             {0}};
    for (int v = 0; v < GOUGH_LEGS; v++) {
        column[0].value[v] = in_units(unit, GOUGH_UNIT_LENGTH, view->at.length[v]);
        column[1].value[v] = stroke_share(&limits, v, view->at.length[v]);
        column[2].value[v] = in_units(unit, GOUGH_UNIT_FORCE, view->at.force[v]);
        column[3].value[v] = force_share(&limits, v, view->at.force[v]);
    }
    table_print(stream, column, false);
    for (int v = 0; v < GOUGH_LEGS; v++) {
        if (is_beyond(&limits, &view->at, v))
            fprintf(stream, "  leg %d                is outside its limits\n", v + 1);
    }
    fprintf(stream, "  condition            %.6g (1 is best, 1e8 counts as singular)\n",
            view->at.condition);
}

/* Row i of a stiffness is a force or a moment, column j a displacement or an angle in radians; a compliance is the other way
 * round. */
static void scale_matrix(const gough_units *unit, const double matrix[6][6], bool stiffness,
                         double scaled[6][6]) {
    const double force[2] = {gough_unit_factor(unit, GOUGH_UNIT_FORCE),
                             gough_unit_factor(unit, GOUGH_UNIT_MOMENT)};
    const double length[2] = {gough_unit_factor(unit, GOUGH_UNIT_LENGTH), 1};
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++)
            scaled[i][j] = matrix[i][j] * (stiffness ? force[i / 3] / length[j / 3]
                                                     : length[i / 3] / force[j / 3]);
}

/* " [N/m, N/rad; N, N m/rad]", or that of a compliance */
static void print_matrix_units(FILE *stream, const gough_units *unit, bool stiffness) {
    const char *length = unit_word(unit, GOUGH_UNIT_LENGTH);
    const char *force = unit_word(unit, GOUGH_UNIT_FORCE),
               *moment = unit_word(unit, GOUGH_UNIT_MOMENT);
    if (!*length)
        fprintf(stream, ", angles in radians");
    else if (stiffness)
        fprintf(stream, " [%s/%s, %s/rad; %s, %s/rad]", force + 1, length + 1, force + 1, force + 1,
                moment + 1);
    else
        fprintf(stream, " [%s/%s, 1/%s; rad/%s, rad/(%s)]", length + 1, force + 1, force + 1,
                force + 1, moment + 1);
}

static void print_matrix(FILE *stream, const gough_units *unit, const char *name, bool labelled,
                         bool stiffness, const double given[6][6]) {
    double matrix[6][6];
    double largest[2][2] = {{0, 0}, {0, 0}};
    scale_matrix(unit, given, stiffness, matrix);
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++)
            largest[i / 3][j / 3] = fmax(largest[i / 3][j / 3], fabs(matrix[i][j]));
    fprintf(stream, "\n  %s", name);
    if (labelled) print_matrix_units(stream, unit, stiffness);
    fprintf(stream, "\n        ");
    for (int j = 0; j < 6; j++) fprintf(stream, "%12s", gough_component_name(j));
    fprintf(stream, "\n");
    for (int i = 0; i < 6; i++) {
        fprintf(stream, "  %-6s", gough_component_name(i));
        for (int j = 0; j < 6; j++) {
            const double x = matrix[i][j];
            fprintf(stream, "%12.5g", fabs(x) > NOTHING * largest[i / 3][j / 3] ? x : 0.0);
        }
        fprintf(stream, "\n");
    }
}

static void print_where(FILE *stream, const gough_units *unit, const pose_view *view) {
    const char *joint = "";
    fprintf(stream, "\nAt rest at ");
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        if (!(fabs(view->pose[c]) > 0)) continue;
        fprintf(stream, "%s%s %.6g%s", joint, gough_component_name(c), view->pose[c],
                unit_word(unit, component_unit(c)));
        joint = ", ";
    }
    fprintf(stream, "%s\n", *joint ? "" : "home");
}

void pose_view_print(FILE *stream, const gough_model *model, const gough_units *unit,
                     const pose_view *view) {
    print_where(stream, unit, view);
    if (!view->found) {
        print_line(stream, "  not determined       %s", view->why.message);
        return;
    }
    print_legs(stream, model, unit, view);
    print_matrix(stream, unit, "of the control and of the static forces together", true, true,
                 view->at.total);
    print_matrix(stream, unit, "of these, of the static forces alone", false, true,
                 view->at.geometric);
    if (view->at.firm)
        print_matrix(stream, unit, "compliance", true, false, view->at.compliance);
    else
        fprintf(stream,
                "\n  compliance           none: some displacement is not resisted; with more "
                "control.stiffness\n"
                "                       it may be\n");
    resolution_print(stream, model, unit, &view->at.state);
}

static json_t *matrix_array(const gough_units *unit, const double given[6][6], bool stiffness,
                            bool known) {
    double matrix[6][6];
    json_t *rows = json_array();
    if (known) scale_matrix(unit, given, stiffness, matrix);
    for (int i = 0; known && i < 6; i++) json_array_append_new(rows, json_numbers(matrix[i], 6));
    if (known) return rows;
    json_decref(rows);
    return json_null();
}

json_t *pose_view_object(const gough_model *model, const gough_units *unit, const pose_view *view) {
    const gough_limits limits = gough_limits_of(&model->machine, &model->motion);
    const gough_stiffness *s = &view->at;
    double stroke[GOUGH_LEGS], used[GOUGH_LEGS], length[GOUGH_LEGS], force[GOUGH_LEGS];
    json_t *object = json_object();
    for (int v = 0; v < GOUGH_LEGS; v++) {
        stroke[v] = view->found ? stroke_share(&limits, v, s->length[v]) : NAN;
        used[v] = view->found ? force_share(&limits, v, s->force[v]) : NAN;
        length[v] = in_units(unit, GOUGH_UNIT_LENGTH, s->length[v]);
        force[v] = in_units(unit, GOUGH_UNIT_FORCE, s->force[v]);
    }
    json_object_set_new(object, "component", json_numbers(view->pose, GOUGH_COMPONENTS));
    json_object_set_new(object, "length",
                        view->found ? json_numbers(length, GOUGH_LEGS) : json_null());
    json_object_set_new(object, "stroke_used", json_numbers(stroke, GOUGH_LEGS));
    json_object_set_new(object, "force",
                        view->found ? json_numbers(force, GOUGH_LEGS) : json_null());
    json_object_set_new(object, "force_used", json_numbers(used, GOUGH_LEGS));
    json_object_set_new(object, "condition", json_number(view->found ? s->condition : NAN));
    json_object_set_new(object, "stiffness", matrix_array(unit, s->total, true, view->found));
    json_object_set_new(object, "static_stiffness",
                        matrix_array(unit, s->geometric, true, view->found));
    json_object_set_new(object, "compliance",
                        matrix_array(unit, s->compliance, false, view->found && s->firm));
    json_object_set_new(object, "resolution",
                        view->found ? resolution_object(model, unit, &s->state) : json_null());
    json_object_set_new(object, "message", json_words(view->found ? "" : view->why.message));
    return object;
}
