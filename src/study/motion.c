/* The program of a study: formulas, point-to-point moves, or samples from a file; one of the three. */
#include "study/motion.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "gough/dynamics.h"
#include "study/fill.h"
#include "study/samples.h"
#include "study/value.h"

/* Which of the three the motion is; where it is more than one, an error at the second. */
static bool find_kind(study_build *build, study_node *node, gough_motion_kind *kind) {
    const study_node *first = NULL;
    *kind = GOUGH_MOTION_FORMULAS;
    for (study_node *child = node->first; child; child = child->next) {
        bool formula = false;
        for (int c = 0; c < GOUGH_COMPONENTS; c++)
            formula |= strcmp(child->key->text, gough_component_name(c)) == 0;
        const bool moves = strcmp(child->key->text, "moves") == 0;
        const bool samples = strcmp(child->key->text, "samples") == 0;
        if (!formula && !moves && !samples) continue;
        const gough_motion_kind this = formula ? GOUGH_MOTION_FORMULAS
                                       : moves ? GOUGH_MOTION_MOVES
                                               : GOUGH_MOTION_SAMPLES;
        if (first && this != *kind) {
            study_node_say(build->messages, child, study_node_place(child, true),
                           "`motion` has both `%s` and `%s`; give formulas, moves or samples",
                           child->key->text, first->key->text);
            return false;
        }
        if (!first) first = child;
        *kind = this;
    }
    return true;
}

/* limits of a move, in the order of gough_move_limit */
static const char *const move_limits[] = {"speed", "acceleration", "angular_speed",
                                          "angular_acceleration"};

static bool has_limits(const gough_move *move) {
    return move->speed > 0 || move->acceleration > 0 || move->angular_speed > 0 ||
           move->angular_acceleration > 0;
}

/* A duration is a number, or is found from limits. */
static void check_duration(study_build *build, study_node *node, gough_move *move) {
    const study_node *duration = study_node_child(node, "duration");
    move->least = study_is_least(duration);
    if (!duration && !has_limits(move))
        study_node_say(build->messages, node, study_node_place(node, false),
                       "`%s.duration` is missing: the duration of the move, or the word least; or "
                       "give speed or acceleration",
                       study_node_path(build->messages->arena, node));
}

/* A move begins when the one before has ended, up to rounding. */
static void check_start(study_build *build, study_node *node, gough_move *move, double before) {
    study_node *start = study_node_child(node, "start");
    if (!start)
        move->start = before;
    else if (move->start < before - 1e-12 * fabs(before))
        study_node_say(build->messages, start, study_node_place(start, false),
                       "`%s.start` is before the end of the previous move; moves must not overlap",
                       study_node_path(build->messages->arena, node));
    else if (move->start < before)
        move->start = before;
}

static void read_move(study_build *build, study_node *node, gough_move *move) {
    bool any = false;
    study_element_read(move, GOUGH_OWNER_MOVE, &build->study->units, node);
    for (int c = 0; c < GOUGH_COMPONENTS; c++) any = any || move->given[c];
    if (!any)
        study_node_say(build->messages, node, study_node_place(node, false),
                       "`%s` has no target; give one such as heave: 0.1",
                       study_node_path(build->messages->arena, node));
    check_duration(build, node, move);
}

/* The duration that follows from limits; one that is given is compared with those of the move. */
static void find_duration(study_build *build, study_node *node, gough_move *move, size_t index) {
    const gough_model *model = build->study->model;
    const bool given = move->duration > 0;
    gough_error error = {.message = ""};
    gough_move_fit fit;
    const bool found = gough_move_find(&model->machine, &model->motion, index, &fit, sizeof fit,
                                       &error) == GOUGH_OK;
    if (!given && found) {
        move->duration = fit.duration;
    } else if (!given) {
        gough_error_say(&error, &build->study->units);
        study_node_say(build->messages, node, study_node_place(node, false), "%s", error.message);
    } else if (found && fit.duration > move->duration * (1 + 1e-9)) {
        study_node *duration = study_node_child(node, "duration");
        const char *path = study_node_path(build->messages->arena, node);
        study_node_say(build->messages, duration, study_node_place(duration, false),
                       "`%s.duration` is too short for `%s.%s`; leave one of them out", path, path,
                       move_limits[fit.limit]);
    }
}

/* Times of the moves one after the other. Durations need the machine, and are found where all that was read is right. */
void study_moves_place(study_build *build, bool machine) {
    const study_node *list = study_node_at(build->root, "motion.moves");
    double before = 0; /* NaN: not known */
    size_t i = 0;
    if (!list || !build->moves) return;
    for (study_node *item = list->first; item; item = item->next, i++) {
        gough_move *move = &build->moves[i];
        check_start(build, item, move, before);
        if (machine && build->messages->count == 0 && (!(move->duration > 0) || has_limits(move)))
            find_duration(build, item, move, i);
        before = move->duration > 0 ? move->start + move->duration : NAN;
    }
}

bool study_moves_depend(const study_node *root) {
    const study_node *list = study_node_at(root, "motion.moves");
    const study_node *item = list ? list->first : NULL;
    for (; item; item = item->next)
        if (study_is_least(study_node_child(item, "duration"))) return true;
    return false;
}

static void build_moves(study_build *build, study_node *list) {
    gough_move *move = calloc(list->count, sizeof *move);
    if (!move) {
        build->messages->arena->exhausted = true;
        return;
    }
    build->moves = move;
    size_t count = 0;
    for (study_node *item = list->first; item; item = item->next, count++)
        read_move(build, item, &move[count]);
    build->study->model->motion.move = move;
    build->study->model->motion.moves = count;
}

static study_smoothing read_smoothing(const study_node *motion) {
    const study_node *smooth = study_node_child(motion, "smooth");
    const study_node *cutoff = study_node_child(motion, "cutoff");
    study_smoothing how = {.kind = STUDY_AS_RECORDED};
    if (cutoff && !cutoff->wrong) {
        how.kind = STUDY_SMOOTH_CUTOFF;
        how.cutoff = study_number(cutoff);
    } else if (smooth && !smooth->wrong && smooth->kind == STUDY_MAPPING) {
        how.kind = STUDY_SMOOTH_DEVIATIONS;
        for (int c = 0; c < GOUGH_COMPONENTS; c++) {
            const study_node *deviation = study_node_child(smooth, gough_component_name(c));
            if (deviation) how.deviation[c] = study_number(deviation);
        }
    } else if (smooth && !smooth->wrong) {
        how.kind = strcmp(smooth->text, "rounding") == 0 ? STUDY_SMOOTH_ROUNDING : STUDY_EXACT;
    }
    return how;
}

static gough_order read_order(const study_node *motion) {
    const study_node *order = study_node_child(motion, "order");

    return order && !order->wrong && strcmp(order->text, "xyz") == 0 ? GOUGH_XYZ : GOUGH_ZYX;
}

/* The file of samples, and what the study says about it. Keys of motion that are beside a bare name are inside a mapping. */
static void build_samples(study_build *build, const study_node *motion, study_node *samples) {
    study_messages *messages = build->messages;
    const bool mapping = samples->kind == STUDY_MAPPING;
    study_node *file = mapping ? study_node_child(samples, "file") : samples;
    const char *folder = file->text[0] == '/' ? "" : build->folder;
    const size_t length = strlen(folder), before = messages->count;
    char *path = study_arena_take(messages->arena, length + file->length + 1);
    if (!path) return;
    memcpy(path, folder, length);
    memcpy(path + length, file->text, file->length);
    build->samples_path = path;
    const gough_order order = read_order(motion);
    study_recording recording = {.smoothing = read_smoothing(mapping ? samples : motion),
                                 .units = build->study->units,
                                 .order = order,
                                 .keys = mapping ? study_record_keys_read(messages, samples, order)
                                                 : study_record_keys_none(samples, order),
                                 .file = file->text,
                                 .record = build->record,
                                 .samples = &build->study->model->motion.samples};
    if (messages->count == before)
        study_samples_read(messages, study_node_place(file, false), path, &recording);
    build->samples = recording.memory;
    if (build->samples)
        build->study->record = build->record;
    else
        study_node_mark(file);
}

/* Smoothing is for records, and by one rule. */
static void check_smoothing(study_build *build, const study_node *motion, const char *path) {
    study_node *smooth = study_node_child(motion, "smooth");
    study_node *cutoff = study_node_child(motion, "cutoff");
    if (smooth && cutoff)
        study_node_say(build->messages, cutoff, study_node_place(cutoff, true),
                       "`%s` has both `cutoff` and `smooth`; give only one of them", path);
    if (smooth && !smooth->wrong && smooth->kind == STUDY_MAPPING && !smooth->first)
        study_say_shape(build->messages, smooth, study_shape_phrase(GOUGH_SHAPE_SMOOTH));
}

/* Keys of smoothing beside the samples. */
static void check_place(study_build *build, const study_node *motion) {
    study_node *smooth = study_node_child(motion, "smooth");
    study_node *cutoff = study_node_child(motion, "cutoff");
    study_node *either = smooth ? smooth : cutoff;
    const study_node *samples = study_node_child(motion, "samples");
    check_smoothing(build, motion, "motion");
    if (samples && samples->kind == STUDY_MAPPING) {
        check_smoothing(build, samples, "motion.samples");
        if (either)
            study_node_say(build->messages, either, study_node_place(either, true),
                           "`motion.%s` is for a bare file name; write it into the mapping, as "
                           "`motion.samples.%s`",
                           either->key->text, either->key->text);
    }
    if (either && !samples && !study_node_meant(motion, "samples"))
        study_node_say(build->messages, either, study_node_place(either, true),
                       "`motion.%s` smooths recorded motion, but there is no `motion.samples`",
                       either->key->text);
}

bool study_motion_build(study_build *build) {
    study_node *node = study_node_child(build->root, "motion");
    gough_motion *motion = &build->study->model->motion;
    if (node) study_part_reset(build->study, GOUGH_PART_MOTION);
    motion->angle_unit = gough_unit_read(&build->study->units, GOUGH_UNIT_ANGLE, 1);
    if (!node) return true;
    if (node->kind != STUDY_MAPPING || !find_kind(build, node, &motion->kind)) return false;
    study_node *samples = study_node_child(node, "samples");
    study_node *moves = study_node_child(node, "moves");
    check_place(build, node);
    if (samples && !samples->wrong) build_samples(build, node, samples);
    if (moves && !moves->wrong) build_moves(build, moves);
    study_part_read(build->study, build->root, GOUGH_PART_MOTION);
    return !node->wrong;
}
