/* gough pose --lengths: the pose joined to home or another, or all poses, for reading and as JSON. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/common/json.h"
#include "cli/common/paragraph.h"
#include "cli/common/scale.h"
#include "cli/common/talk.h"
#include "cli/pose/pose_verb.h"

/* One pose as it is shown. */
typedef struct pose_shown {
    gough_pose pose;
    gough_state state;
    double component[GOUGH_COMPONENTS];
    bool within; /* the limits of legs, joints and platform */
    int joined;  /* to home by the straight line: 1, 0, or −1 for not decided */
} pose_shown;

typedef struct pose_answer {
    const gough_study *study;
    const gough_units *unit;
    double length[GOUGH_LEGS];
    pose_shown shown[GOUGH_POSES];
    int count;
    bool all;
    gough_poses found;                  /* of --all */
    gough_pose_certificate certificate; /* else */
    gough_error error;
    gough_status status;
} pose_answer;

/* ---- limits ---- */

static void leg_direction(const gough_machine *machine, const gough_state *s, int v, bool turned,
                          double n[3]) {
    const gough_platform *p = &machine->platform;
    double l[3], size = 0;
    for (int r = 0; r < 3; r++) {
        l[r] = s->position[r] - p->base[v][r];
        for (int k = 0; k < 3; k++) l[r] += s->rotation[r][k] * p->top[v][k];
        size += l[r] * l[r];
    }
    for (int k = 0; k < 3; k++) {
        n[k] = 0;
        for (int r = 0; r < 3; r++)
            n[k] += (turned ? s->rotation[r][k] : r == k) * l[r] / sqrt(size);
    }
}

/* the angle of a leg from its direction at home, in base axes or in those of the top */
static double swing_of(const gough_machine *machine, const gough_state *s, int v, bool turned) {
    const gough_state home = gough_state_home(machine);
    double a[3], b[3], dot = 0, cross = 0;
    leg_direction(machine, &home, v, turned, a);
    leg_direction(machine, s, v, turned, b);
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        const double c = a[i] * b[j] - a[j] * b[i];
        dot += a[k] * b[k], cross += c * c;
    }
    return atan2(sqrt(cross), dot);
}

static bool within_limits(const gough_model *model, const double length[GOUGH_LEGS],
                          const gough_state *state) {
    const gough_limits l = gough_limits_of(&model->machine, &model->motion);
    gough_model at_point = {.machine = model->machine, .motion = {.order = model->motion.order}};
    double component[GOUGH_COMPONENTS];
    bool within = true;
    memcpy(at_point.motion.about, l.about, sizeof l.about);
    pose_components(&at_point, state, component);
    for (int v = 0; v < GOUGH_LEGS; v++) {
        within &= length[v] >= l.length[v][0] && length[v] <= l.length[v][1];
        within &= swing_of(&model->machine, state, v, false) <= l.base_swing[v];
        within &= swing_of(&model->machine, state, v, true) <= l.top_swing[v];
    }
    for (int c = 0; c < GOUGH_COMPONENTS; c++)
        within &= component[c] >= l.pose[c][0] && component[c] <= l.pose[c][1];
    return within;
}

static void show(pose_answer *a, const gough_pose *pose, int joined) {
    pose_shown *shown = &a->shown[a->count++];
    *shown = (pose_shown){.pose = *pose, .joined = joined};
    memcpy(shown->state.position, pose->position, sizeof pose->position);
    memcpy(shown->state.rotation, pose->rotation, sizeof pose->rotation);
    pose_components(a->study->model, &shown->state, shown->component);
    shown->within = within_limits(a->study->model, a->length, &shown->state);
}

/* ---- finding ---- */

static void find_joined(pose_answer *a, const pose_asked *asked) {
    const gough_machine *machine = &a->study->model->machine;
    gough_state state = pose_begin(asked, a->study);
    gough_pose_certificate *c = &a->certificate;
    gough_pose pose;
    a->status = gough_pose_from_lengths(machine, a->length, LENGTHS_STEPS, &state, c, &a->error);
    if (a->status) return;
    pose = (gough_pose){.position_error = c->position_error,
                        .angle_error = c->angle_error,
                        .unique_position = c->unique_position,
                        .unique_angle = c->unique_angle};
    memcpy(pose.position, state.position, sizeof pose.position);
    memcpy(pose.rotation, state.rotation, sizeof pose.rotation);
    gough_conditioning(machine, &state, &pose.condition, &pose.determinant);
    show(a, &pose, asked->given_near ? -1 : 1);
}

/* whether a pose is one that was followed from home: it has the same lengths and lies where no other does */
static bool same_pose(const gough_pose *pose, const gough_state *followed,
                      const gough_pose_certificate *c) {
    double square = 0, turn = 0;
    for (int r = 0; r < 3; r++) {
        square += pow(pose->position[r] - followed->position[r], 2);
        for (int k = 0; k < 3; k++) turn += pow(pose->rotation[r][k] - followed->rotation[r][k], 2);
    }
    return sqrt(square) < c->unique_position && 2 * asin(fmin(1, sqrt(turn / 8))) < c->unique_angle;
}

static void find_all(pose_answer *a) {
    const gough_machine *machine = &a->study->model->machine;
    gough_state home = gough_state_home(machine);
    gough_pose pose[GOUGH_POSES];
    gough_pose_certificate c;
    a->status = gough_poses_all(machine, a->length, pose, &a->found, &a->error);
    if (a->status) return;
    const bool joined =
        gough_pose_from_lengths(machine, a->length, LENGTHS_STEPS, &home, &c, NULL) == GOUGH_OK;
    for (int i = 0; i < a->found.real; i++)
        show(a, &pose[i], joined ? same_pose(&pose[i], &home, &c) : -1);
}

/* ---- for reading ---- */

static void print_components(const pose_answer *a, const pose_shown *shown) {
    for (int c = 0; c < GOUGH_COMPONENTS; c++)
        printf("  %-20s %.9g%s\n", gough_component_name(c),
               in_units(a->unit, component_unit(c), shown->component[c]),
               unit_word(a->unit, component_unit(c)));
}

static void print_certificate(const pose_answer *a, const pose_shown *shown) {
    const char *length = unit_word(a->unit, GOUGH_UNIT_LENGTH),
               *angle = unit_word(a->unit, GOUGH_UNIT_ANGLE);
    const gough_pose *p = &shown->pose;
    printf("  %-20s %.3g%s, %.3g%s at most\n", "error",
           in_units(a->unit, GOUGH_UNIT_LENGTH, p->position_error), length,
           in_units(a->unit, GOUGH_UNIT_ANGLE, p->angle_error), angle);
    printf("  %-20s within %.3g%s and %.3g%s\n", "no other pose",
           in_units(a->unit, GOUGH_UNIT_LENGTH, p->unique_position), length,
           in_units(a->unit, GOUGH_UNIT_ANGLE, p->unique_angle), angle);
    printf("  %-20s %.6g (1 is best, 1e8 counts as singular)\n", "condition", p->condition);
    printf("  %-20s %s\n", "limits", shown->within ? "kept" : "exceeded");
}

static void print_one(const pose_answer *a, const pose_asked *asked) {
    const gough_pose_certificate *c = &a->certificate;
    printf("\nThe pose of these lengths that is joined to %s\n",
           asked->given_near ? "that of --near" : "home");
    print_components(a, &a->shown[0]);
    print_certificate(a, &a->shown[0]);
    printf("  %-20s %d certified step%s\n", "way", c->steps, c->steps == 1 ? "" : "s");
}

static void print_counts(const pose_answer *a) {
    const gough_poses *f = &a->found;
    printf("\n%d real pose%s, %d complex, %d paths at infinity, %d in doubt\n", f->real,
           f->real == 1 ? "" : "s", f->nonreal, f->infinite, f->singular);
    switch (f->complete) {
    case GOUGH_COMPLETE_PROVED:
        printf("It is proved that there are no others.\n");
        break;
    case GOUGH_COMPLETE_COUNTED:
        print_paragraph(stdout, "", 0,
                        "Each of the 40 paths ended at a certified pose or at infinity, so nothing "
                        "points to another pose; this is not a proof.");
        break;
    default:
        print_paragraph(stdout, "", 0,
                        "There may be others: some paths ended in doubt, as they do at singular "
                        "poses.");
    }
}

static void print_all(const pose_answer *a) {
    static const char *const side[] = {"-", "0", "+"};
    print_counts(a);
    printf("\n   ");
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        const table_heading head =
            heading_of(gough_component_name(c), unit_word(a->unit, component_unit(c)));
        printf(" %12s", head.text);
    }
    printf(" det limit  home\n");
    for (int i = 0; i < a->count; i++) {
        const pose_shown *s = &a->shown[i];
        printf("%3d", i + 1);
        for (int c = 0; c < GOUGH_COMPONENTS; c++)
            printf(" %12.6g", in_units(a->unit, component_unit(c), s->component[c]));
        printf("  %s  %s%s\n", side[1 + (s->pose.determinant > 0) - (s->pose.determinant < 0)],
               s->within ? "kept" : "over", s->joined > 0 ? "   joined" : "");
    }
}

/* ---- JSON ---- */

static json_t *length_and_angle(const pose_answer *a, double length, double angle) {
    json_t *object = json_object();
    json_object_set_new(object, "position",
                        json_number(in_units(a->unit, GOUGH_UNIT_LENGTH, length)));
    json_object_set_new(object, "angle", json_number(in_units(a->unit, GOUGH_UNIT_ANGLE, angle)));
    return object;
}

static json_t *pose_json(const pose_answer *a, const pose_shown *s) {
    json_t *object = json_object(), *rows = json_array();
    double position[3];
    for (int r = 0; r < 3; r++) {
        position[r] = in_units(a->unit, GOUGH_UNIT_LENGTH, s->pose.position[r]);
        json_array_append_new(rows, json_numbers(s->pose.rotation[r], 3));
    }
    json_object_set_new(object, "position", json_numbers(position, 3));
    json_object_set_new(object, "rotation", rows);
    for (int c = 0; c < GOUGH_COMPONENTS; c++)
        json_object_set_new(object, gough_component_name(c),
                            json_number(in_units(a->unit, component_unit(c), s->component[c])));
    json_object_set_new(object, "determinant", json_number(s->pose.determinant));
    json_object_set_new(object, "condition", json_number(s->pose.condition));
    json_object_set_new(object, "error",
                        length_and_angle(a, s->pose.position_error, s->pose.angle_error));
    json_object_set_new(object, "unique_within",
                        length_and_angle(a, s->pose.unique_position, s->pose.unique_angle));
    json_object_set_new(object, "within_limits", json_boolean(s->within));
    json_object_set_new(object, "joined_to_home",
                        s->joined < 0 ? json_null() : json_boolean(s->joined));
    return object;
}

json_t *pose_object(const gough_study *study, json_t *record) {
    static const char *const key[] = {"lengths",  "poses",    "real",     "nonreal",
                                      "infinite", "singular", "complete", "steps",
                                      "reached",  "margin",   "message"};
    json_t *object = json_object();
    json_object_set_new(object, "verb", json_string("pose"));
    json_object_set_new(object, "title", json_words(study->title));
    json_object_set_new(object, "units", json_units(&study->units));
    for (size_t i = 0; i < sizeof key / sizeof *key; i++)
        json_object_set_new(object, key[i], json_null());
    json_object_set_new(object, "record", record ? record : json_null());
    return object;
}

static int print_json(const pose_answer *a) {
    json_t *object = pose_object(a->study, NULL), *poses = json_array();
    double length[GOUGH_LEGS];
    for (int v = 0; v < GOUGH_LEGS; v++)
        length[v] = in_units(a->unit, GOUGH_UNIT_LENGTH, a->length[v]);
    for (int i = 0; i < a->count; i++) json_array_append_new(poses, pose_json(a, &a->shown[i]));
    json_object_set_new(object, "lengths", json_numbers(length, GOUGH_LEGS));
    json_object_set_new(object, "poses", poses);
    if (a->all) {
        const gough_poses *f = &a->found;
        json_object_set_new(object, "real", json_integer(f->real));
        json_object_set_new(object, "nonreal", json_integer(f->nonreal));
        json_object_set_new(object, "infinite", json_integer(f->infinite));
        json_object_set_new(object, "singular", json_integer(f->singular));
        json_object_set_new(object, "complete", json_string(gough_completeness_name(f->complete)));
        json_object_set_new(object, "steps", json_integer(f->steps));
    } else {
        json_object_set_new(object, "steps", json_integer(a->certificate.steps));
        json_object_set_new(object, "reached", json_number(a->certificate.reached));
        json_object_set_new(object, "margin", json_number(a->certificate.margin));
    }
    json_object_set_new(object, "message", json_words(a->status ? a->error.message : ""));
    return json_print(object);
}

/* ---- together ---- */

gough_status pose_of_lengths(const pose_line *line, const gough_study *study) {
    pose_answer a = {.study = study, .unit = &study->units, .all = line->asked.all};
    for (int v = 0; v < GOUGH_LEGS; v++)
        a.length[v] = gough_unit_read(a.unit, GOUGH_UNIT_LENGTH, line->asked.lengths.length[v]);
    if (a.all)
        find_all(&a);
    else
        find_joined(&a, &line->asked);
    gough_error_say(&a.error, a.unit);
    if (a.status)
        complain(line->line.verb, "%s%s", a.error.message,
                 a.all || a.status == GOUGH_ERROR_INPUT
                     ? ""
                     : "; --all lists every pose of these lengths");
    if (a.status == GOUGH_ERROR_INPUT) return a.status;
    if (line->line.json) {
        if (print_json(&a)) return GOUGH_ERROR_FILE;
    } else if (!line->line.quiet && !a.status) {
        print_title(stdout, study->title);
        printf("%s\n", units_sentence(study, a.unit).text);
        if (a.all)
            print_all(&a);
        else
            print_one(&a, &line->asked);
    }
    return a.status;
}
