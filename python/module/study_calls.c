/* Studies and tables: reads a study, runs it in this process, and shows the columns of its table without a copy. */
#define _GNU_SOURCE
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "python_api.h"

#define STUDY "gough.study"
#define RESULT "gough.result"
#define TABLE "gough.table"

static void study_release(PyObject *capsule) {
    gough_study_free(PyCapsule_GetPointer(capsule, STUDY));
}
static void result_release(PyObject *capsule) {
    gough_result_free(PyCapsule_GetPointer(capsule, RESULT));
}
static void table_release(PyObject *capsule) {
    gough_table_free(PyCapsule_GetPointer(capsule, TABLE));
}

gough_study *study_of(PyObject *object) { return PyCapsule_GetPointer(object, STUDY); }

/* ---- reading ------------------------------------------------------------------------------------------------------ */

enum { MOST_SETTINGS = 1000 };

/* The settings of a list of pairs of texts, which must live as long; -1 with an exception. */
static Py_ssize_t settings_of(PyObject *list, gough_setting *setting) {
    const Py_ssize_t count = PyList_Size(list);
    if (count > MOST_SETTINGS) PyErr_SetString(PyExc_ValueError, "too many settings");
    if (count < 0 || count > MOST_SETTINGS) return -1;
    for (Py_ssize_t i = 0; i < count; i++) {
        PyObject *pair = PyList_GetItem(list, i);
        PyObject *key = PyTuple_GetItem(pair, 0), *value = PyTuple_GetItem(pair, 1);
        if (!key || !value) return -1;
        setting[i] = (gough_setting){PyUnicode_AsUTF8AndSize(key, NULL),
                                     PyUnicode_AsUTF8AndSize(value, NULL)};
        if (!setting[i].key || !setting[i].value) return -1;
    }
    return count;
}

/* study_parse(name, text, settings): a study in a capsule. Failure has all messages in one text. */
static PyObject *study_parse(PyObject *module, PyObject *arguments) {
    const char *name, *text;
    Py_ssize_t length;
    PyObject *list;
    gough_study *study = NULL;
    char *messages = NULL;
    (void)module;
    if (!PyArg_ParseTuple(arguments, "sy#O!", &name, &text, &length, &PyList_Type, &list))
        return NULL;
    gough_setting *setting = malloc((MOST_SETTINGS) * sizeof *setting);
    if (!setting) return PyErr_NoMemory();
    const Py_ssize_t count = settings_of(list, setting);
    gough_status status = GOUGH_ERROR_INPUT;
    if (count >= 0) {
        Py_BEGIN_ALLOW_THREADS status = gough_study_parse(name, text, (size_t)length, setting,
                                                          (size_t)count, &study, &messages);
        Py_END_ALLOW_THREADS if (status)
            raise_failure((int)status, messages ? messages : "out of memory", NULL);
    }
    free(setting);
    gough_study_free_messages(messages);
    return status ? NULL : PyCapsule_New(study, STUDY, study_release);
}

/* the words of its five base units, such as ("mm", "N", "kg", "deg", "s") */
static PyObject *base_units(const gough_units *units) {
    PyObject *words = PyTuple_New(GOUGH_BASE_UNITS);
    for (int b = 0; words && b < GOUGH_BASE_UNITS; b++) {
        PyObject *word = PyUnicode_FromString(
            units->dimensionless ? "1" : gough_unit_choice((gough_base_unit)b, units->name[b]));
        if (!word || PyTuple_SetItem(words, b, word) < 0) {
            Py_DECREF(words);
            return NULL;
        }
    }
    return words;
}

/* study_facts(study): what does not need a run */
static PyObject *study_facts(PyObject *module, PyObject *capsule) {
    const gough_study *s = study_of(capsule);
    (void)module;
    if (!s) return NULL;
    return Py_BuildValue("{s:s,s:O,s:N,s:d,s:d,s:d,s:O}", "title", s->title, "dimensionless",
                         s->dimensionless ? Py_True : Py_False, "base_units", base_units(&s->units),
                         "duration", s->simulation.duration, "output_step",
                         s->simulation.output_step, "step", s->simulation.step, "swept",
                         s->swept ? Py_True : Py_False);
}

/* ---- running ------------------------------------------------------------------------------------------------------ */

/* Rows on their way into the table; now and then Python is asked whether the user has interrupted the run. */
typedef struct running {
    gough_result *result;
    PyObject *law; /* a callable, or NULL */
    size_t rows;
    int memory_out, raised;
} running;

enum { ROWS_BETWEEN_SIGNALS = 256 };

static int take_row(void *context, const gough_row *row) {
    running *run = context;
    if (gough_result_add(run->result, row) != 0) run->memory_out = 1;
    if (++run->rows % ROWS_BETWEEN_SIGNALS == 0 && !run->raised) {
        const PyGILState_STATE lock = PyGILState_Ensure();
        if (PyErr_CheckSignals() != 0) run->raised = 1;
        PyGILState_Release(lock);
    }
    return run->memory_out || run->raised;
}

static PyObject *six(const double value[GOUGH_LEGS]) {
    return Py_BuildValue("(dddddd)", value[0], value[1], value[2], value[3], value[4], value[5]);
}

/* what the callable returns: six numbers */
static int six_from(PyObject *object, double value[GOUGH_LEGS]) {
    PyObject *list = object ? PySequence_List(object) : NULL;
    if (list && PyList_Size(list) != GOUGH_LEGS)
        PyErr_SetString(PyExc_ValueError, "a control law returns six forces, one for each leg");
    for (int v = 0; list && !PyErr_Occurred() && v < GOUGH_LEGS; v++)
        value[v] = PyFloat_AsDouble(PyList_GetItem(list, v));
    Py_XDECREF(list);
    return PyErr_Occurred() ? -1 : 0;
}

/* gough_law: the callable's command, or the model's where it returns None or fails; a failure ends the run at the next row */
static void call_law(void *context, const gough_sample *s, double command[GOUGH_LEGS]) {
    running *run = context;
    double own[GOUGH_LEGS];
    if (run->raised) return;
    const PyGILState_STATE lock = PyGILState_Ensure();
    PyObject *sample = Py_BuildValue(
        "{s:K,s:d,s:N,s:N,s:N,s:N,s:N,s:N}", "number", (unsigned long long)s->number, "time",
        s->time, "length", six(s->length), "rate", six(s->rate), "program_force",
        six(s->program_force), "program_length", six(s->program_length), "program_rate",
        six(s->program_rate), "command", six(command));
    PyObject *answer = sample ? PyObject_CallFunctionObjArgs(run->law, sample, NULL) : NULL;
    if (answer != Py_None && six_from(answer, own) == 0) memcpy(command, own, sizeof own);
    if (PyErr_Occurred()) run->raised = 1;
    Py_XDECREF(answer);
    Py_XDECREF(sample);
    if (run->raised) { /* the exception waits in this thread until the run has ended */
        for (int v = 0; v < GOUGH_LEGS; v++) command[v] = NAN;
    }
    PyGILState_Release(lock);
}

/* what the limit is a number of, at which a run ended */
static gough_unit unit_of_limit(const gough_end *end) {
    const int turns = end->component > 3;
    switch (end->cause) {
    case GOUGH_END_LEG_SHORT:
    case GOUGH_END_LEG_LONG:
        return GOUGH_UNIT_LENGTH;
    case GOUGH_END_LEG_SPEED:
        return GOUGH_UNIT_SPEED;
    case GOUGH_END_LEG_FORCE:
        return GOUGH_UNIT_FORCE;
    case GOUGH_END_LEG_ACCELERATION:
        return GOUGH_UNIT_ACCELERATION;
    case GOUGH_END_BASE_SWING:
    case GOUGH_END_TOP_SWING:
        return GOUGH_UNIT_ANGLE;
    case GOUGH_END_PLATFORM_POSE:
        return turns ? GOUGH_UNIT_ANGLE : GOUGH_UNIT_LENGTH;
    case GOUGH_END_PLATFORM_SPEED:
        return turns ? GOUGH_UNIT_ANGULAR_SPEED : GOUGH_UNIT_SPEED;
    case GOUGH_END_PLATFORM_ACCELERATION:
        return turns ? GOUGH_UNIT_ANGULAR_ACCELERATION : GOUGH_UNIT_ACCELERATION;
    default:
        return GOUGH_UNIT_NONE;
    }
}

/* (cause, time, leg, component, limit, message), in the units of the table; the sentence of the end itself is then in them, too */
static PyObject *end_of(gough_end *end, const gough_units *units) {
    const gough_end_words words = {
        gough_unit_word(units, GOUGH_UNIT_LENGTH),
        gough_unit_word(units, GOUGH_UNIT_SPEED),
        gough_unit_word(units, GOUGH_UNIT_ACCELERATION),
        gough_unit_word(units, GOUGH_UNIT_FORCE),
        gough_unit_word(units, GOUGH_UNIT_TIME),
        gough_unit_word(units, GOUGH_UNIT_ANGLE),
        gough_unit_word(units, GOUGH_UNIT_ANGULAR_SPEED),
        gough_unit_word(units, GOUGH_UNIT_ANGULAR_ACCELERATION),
    };
    gough_end shown = *end;
    shown.time *= gough_unit_factor(units, GOUGH_UNIT_TIME);
    shown.limit *= gough_unit_factor(units, unit_of_limit(end));
    gough_end_say(&shown, &words);
    memcpy(end->message, shown.message, sizeof end->message);
    return Py_BuildValue("(sdiids)", gough_cause_name(end->cause), shown.time, end->leg,
                         end->component, shown.limit, end->message);
}

typedef struct request {
    gough_study
        study; /* its parts are those of the study that Python keeps; how to run it is as asked for */
    int simulated, dimensionless, reactions, joints, actuators, quad;
    gough_units units;
} request;

static void put_options(request *r, running *run) {
    gough_simulation *simulation = &r->study.simulation;
    simulation->reactions |= r->reactions;
    simulation->joints |= r->joints;
    simulation->actuators |= r->actuators;
    if (r->quad) simulation->precision = GOUGH_QUADRUPLE;
    if (!run->law) return;
    simulation->law = call_law;
    simulation->law_context = run;
}

static gough_status run_request(const request *r, running *run, gough_end *end,
                                gough_error *error) {
    const gough_study *s = &r->study;
    gough_status status;
    Py_BEGIN_ALLOW_THREADS status =
        r->simulated
            ? gough_simulate(s->model, &s->simulation, take_row, run, end, error)
            : gough_forces(s->model, &s->simulation, take_row, run, NULL, NULL, end, error);
    Py_END_ALLOW_THREADS return status;
}

/* the exception for a run without an answer, if there is not one already */
static void raise_for(gough_status status, const running *run, const request *r,
                      gough_error *error) {
    if (PyErr_Occurred()) return;
    if (run->memory_out) {
        PyErr_SetString(PyExc_MemoryError, "not enough memory for the table; a longer "
                                           "simulation.output_step needs less");
    } else if (status != GOUGH_OK && status != GOUGH_ERROR_NUMERICAL) {
        gough_error_say(error, &r->study.units);
        raise_error(error);
    }
}

/* run(study, verb, dimensionless, reactions, joints, actuators, quad, law): (table in a capsule, how the run ended) */
static PyObject *run(PyObject *module, PyObject *arguments) {
    const char *verb;
    PyObject *capsule, *law;
    request r = {.simulated = 0};
    running going = {.law = NULL};
    gough_end end = {.cause = GOUGH_END_DONE};
    gough_error error = {.message = ""};
    (void)module;
    if (!PyArg_ParseTuple(arguments, "OspppppO", &capsule, &verb, &r.dimensionless, &r.reactions,
                          &r.joints, &r.actuators, &r.quad, &law))
        return NULL;
    const gough_study *study = study_of(capsule);
    if (!study) return NULL;
    r.study = *study;
    r.simulated = strcmp(verb, "simulate") == 0;
    going.law = law == Py_None ? NULL : law;
    put_options(&r, &going);
    if (gough_units_of_study(study, r.dimensionless, &r.units, &error)) return raise_error(&error);
    if (!(going.result = gough_result_new(&r.study, verb, &r.units))) return PyErr_NoMemory();

    const gough_status status = run_request(&r, &going, &end, &error);
    raise_for(status, &going, &r, &error);
    PyObject *ended = PyErr_Occurred() ? NULL : end_of(&end, &r.units);
    if (ended) gough_result_set_end(going.result, &end);
    PyObject *table = ended ? PyCapsule_New(going.result, RESULT, result_release) : NULL;
    if (table) return Py_BuildValue("(NN)", table, ended);
    Py_XDECREF(ended);
    gough_result_free(going.result);
    return NULL;
}

/* ---- tables ------------------------------------------------------------------------------------------------------- */

/* adds (name, what it is, unit, numbers) to a list */
static int add_column(PyObject *list, const char *name, const char *what, const char *unit,
                      PyObject *numbers) {
    PyObject *entry = numbers ? Py_BuildValue("(sssN)", name, what, unit, numbers) : NULL;
    const int failed = !entry || PyList_Append(list, entry) < 0;
    Py_XDECREF(entry);
    return failed ? -1 : 0;
}

/* result_columns(table of run()) */
static PyObject *result_columns(PyObject *module, PyObject *capsule) {
    gough_result *result = PyCapsule_GetPointer(capsule, RESULT);
    PyObject *list = result ? PyList_New(0) : NULL;
    gough_result_column c;
    (void)module;
    for (int i = 0; list && gough_result_column_at(result, i, &c); i++) {
        if (add_column(list, c.name, c.long_name, c.unit, column_new(c.value, c.rows, capsule)) ==
            0)
            continue;
        Py_DECREF(list);
        return NULL;
    }
    return list;
}

/* table_read(path): (columns, facts) of a file that the command or another program wrote */
static PyObject *table_read(PyObject *module, PyObject *arguments) {
    const char *path;
    gough_table *table = NULL;
    gough_error error = {.message = ""};
    gough_status status;
    (void)module;
    if (!PyArg_ParseTuple(arguments, "s", &path)) return NULL;
    Py_BEGIN_ALLOW_THREADS status = gough_table_read(path, &table, &error);
    Py_END_ALLOW_THREADS if (status) return raise_error(&error);
    PyObject *owner = PyCapsule_New(table, TABLE, table_release),
             *list = owner ? PyList_New(0) : NULL;
    int failed = !list;
    for (size_t i = 0; !failed && i < table->columns; i++)
        failed = add_column(list, table->name[i], "", table->unit[i],
                            column_new(table->value[i], table->rows, owner)) < 0;
    PyObject *facts =
        failed ? NULL
               : Py_BuildValue("{s:s,s:s,s:s,s:z,s:d,s:d,s:d,s:d,s:d}", "title", table->title,
                               "verb", table->verb, "end_cause", table->end_cause, "end_message",
                               table->end_message, "end_time", table->end_time, "tolerance",
                               table->tolerance, "step", table->step, "max_speed", table->max_speed,
                               "max_force", table->max_force);
    PyObject *both = facts ? Py_BuildValue("(OO)", list, facts) : NULL;
    Py_XDECREF(facts);
    Py_XDECREF(list);
    Py_XDECREF(owner);
    return both;
}

/* result_write(table of run(), path) */
static PyObject *result_write(PyObject *module, PyObject *arguments) {
    const char *path;
    PyObject *capsule;
    gough_error error = {.message = ""};
    (void)module;
    if (!PyArg_ParseTuple(arguments, "Os", &capsule, &path)) return NULL;
    const gough_result *result = PyCapsule_GetPointer(capsule, RESULT);
    if (!result) return NULL;
    if (gough_result_write(result, path, &error)) return raise_error(&error);
    Py_RETURN_NONE;
}

PyMethodDef study_methods[] = {{"study_parse", study_parse, METH_VARARGS, NULL},
                               {"study_facts", study_facts, METH_O, NULL},
                               {"run", run, METH_VARARGS, NULL},
                               {"result_columns", result_columns, METH_O, NULL},
                               {"result_write", result_write, METH_VARARGS, NULL},
                               {"table_read", table_read, METH_VARARGS, NULL},
                               {NULL, NULL, 0, NULL}};
