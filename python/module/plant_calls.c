/* Poses from lengths, and a fleet of plants that commands move. Numbers are in the units of the model, SI or dimensionless, angles
 * in radians. */
#define _GNU_SOURCE
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "python_api.h"

_Static_assert(sizeof(gough_state) == 18 * sizeof(double), "a state is eighteen doubles");

/* ---- poses from lengths ------------------------------------------------------------------------------------------- */

/* certificates of followed poses: what is left of a gough_pose_certificate in an array */
enum { CERTIFICATE = 5 };

typedef struct followed {
    const gough_machine *machine;
    array_view length, position, rotation, certificate;
    int most_steps, chained;
} followed;

static void follow_item(followed *f, size_t i, gough_state *state) {
    gough_pose_certificate c = {.reached = 0};
    const gough_status status = gough_pose_from_lengths(
        f->machine, f->length.value + f->length.stride * i, f->most_steps, state, &c, NULL);
    double *out = f->certificate.value + CERTIFICATE * i;
    out[0] = status == GOUGH_ERROR_INPUT ? NAN : c.reached;
    out[1] = c.margin;
    out[2] = c.position_error;
    out[3] = c.angle_error;
    out[4] = (double)status;
}

static void follow_items(void *context, size_t first, size_t last) {
    followed *f = context;
    gough_state state = {.position = {0}};
    for (size_t i = first; i < last; i++) {
        if (i == first || !f->chained) {
            memcpy(state.position, f->position.value + 3 * i, sizeof state.position);
            memcpy(state.rotation, f->rotation.value + 9 * i, sizeof state.rotation);
        }
        follow_item(f, i, &state);
        memcpy(f->position.value + 3 * i, state.position, sizeof state.position);
        memcpy(f->rotation.value + 9 * i, state.rotation, sizeof state.rotation);
    }
}

/* follow(study, items, threads, most_steps, chained, lengths, position, rotation, certificate): positions and rotations are where
 * each begins, and are changed in place; if chained, the first begins there and each other where the one before it ended. */
static PyObject *follow(PyObject *module, PyObject *arguments) {
    followed f = {.machine = NULL};
    PyObject *capsule, *length, *position, *rotation, *certificate;
    Py_ssize_t items;
    int threads;
    (void)module;
    if (!PyArg_ParseTuple(arguments, "OniipOOOO", &capsule, &items, &threads, &f.most_steps,
                          &f.chained, &length, &position, &rotation, &certificate))
        return NULL;
    const gough_study *study = study_of(capsule);
    if (!study) return NULL;
    f.machine = &study->model->machine;
    const size_t count = (size_t)items;
    if (array_open(&f.length, length, count, 6, 0) == 0 &&
        array_open(&f.position, position, count, 3, 1) == 0 &&
        array_open(&f.rotation, rotation, count, 9, 1) == 0 &&
        array_open(&f.certificate, certificate, count, CERTIFICATE, 1) == 0) {
        Py_BEGIN_ALLOW_THREADS share_items(follow_items, &f, count, f.chained ? count + 1 : 16,
                                           threads);
        Py_END_ALLOW_THREADS
    }
    array_close(&f.length);
    array_close(&f.position);
    array_close(&f.rotation);
    array_close(&f.certificate);
    if (PyErr_Occurred()) return NULL;
    Py_RETURN_NONE;
}

/* ---- fleets ------------------------------------------------------------------------------------------------------- */

#define FLEET "gough.fleet"

typedef struct held_fleet {
    void *fleet;
    gough_machine *machine; /* of each plant */
    size_t count;
    PyObject *study; /* whose numbers they point to */
} held_fleet;

static void fleet_free(held_fleet *f) {
    if (!f) return;
    free(f->fleet);
    free(f->machine);
    Py_XDECREF(f->study);
    free(f);
}

static void fleet_release(PyObject *capsule) { fleet_free(PyCapsule_GetPointer(capsule, FLEET)); }

/* a machine with another load: mass, centre of mass and inertia, thirteen numbers */
static gough_status put_load(gough_machine *machine, const double *number, gough_error *error) {
    gough_load load = {.mass = number[0]};
    const gough_platform platform = machine->platform;
    const double gravity[3] = {machine->gravity[0], machine->gravity[1], machine->gravity[2]};
    memcpy(load.center_of_mass, number + 1, sizeof load.center_of_mass);
    memcpy(load.inertia, number + 4, sizeof load.inertia);
    return gough_machine_init(machine, &platform, &load, gravity, error);
}

static held_fleet *fleet_make(PyObject *capsule, const gough_study *study, size_t count) {
    held_fleet *f = calloc(1, sizeof *f);
    if (!f) return NULL;
    f->count = count;
    f->machine = calloc(count ? count : 1, sizeof *f->machine);
    f->fleet = aligned_alloc(64, gough_fleet_size(count));
    f->study = Py_NewRef(capsule);
    if (!f->machine || !f->fleet) {
        fleet_free(f);
        return NULL;
    }
    for (size_t i = 0; i < count; i++) f->machine[i] = study->model->machine;
    return f;
}

static gough_status fleet_start(held_fleet *f, const gough_simulation *simulation,
                                gough_error *error) {
    const gough_machine **each = malloc((f->count ? f->count : 1) * sizeof *each);
    if (!each) return gough_fail(error, GOUGH_ERROR_FILE, "out of memory");
    for (size_t i = 0; i < f->count; i++) each[i] = &f->machine[i];
    const gough_status status = gough_fleet_begin(f->fleet, each, f->count, simulation, error);
    free(each);
    return status;
}

/* fleet_new(study, count, step, method): plants of the study's machine, at rest at home */
static PyObject *fleet_new(PyObject *module, PyObject *arguments) {
    PyObject *capsule;
    Py_ssize_t count;
    double step;
    const char *method;
    gough_error error = {.message = ""};
    gough_simulation simulation = gough_simulation_default();
    (void)module;
    if (!PyArg_ParseTuple(arguments, "Onds", &capsule, &count, &step, &method)) return NULL;
    const gough_study *study = study_of(capsule);
    if (!study) return NULL;
    simulation.method = GOUGH_METHODS;
    for (int m = 0; m < (int)GOUGH_METHODS; m++)
        if (strcmp(method, gough_method_name(m)) == 0) simulation.method = (gough_method)m;
    simulation.step = step;
    held_fleet *f = fleet_make(capsule, study, (size_t)count);
    if (!f) return PyErr_NoMemory();
    if (fleet_start(f, &simulation, &error)) {
        fleet_free(f);
        return raise_error(&error);
    }
    return PyCapsule_New(f, FLEET, fleet_release);
}

static gough_status put_plant(held_fleet *f, size_t plant, const double *state, const double *load,
                              gough_error *error) {
    gough_state s;
    memcpy(&s, state, sizeof s);
    if (!load) return gough_fleet_put(f->fleet, plant, NULL, &s, error);
    if (plant >= f->count) return gough_fleet_put(f->fleet, plant, NULL, &s, error);
    const gough_status status = put_load(&f->machine[plant], load, error);
    return status ? status : gough_fleet_put(f->fleet, plant, &f->machine[plant], &s, error);
}

/* fleet_put(fleet, plants, states, loads): puts the plants of these numbers into states, eighteen numbers each, with loads of
 * thirteen numbers each or None */
static PyObject *fleet_put(PyObject *module, PyObject *arguments) {
    PyObject *capsule, *plants, *states, *loads;
    array_view state, load;
    gough_error error = {.message = ""};
    (void)module;
    if (!PyArg_ParseTuple(arguments, "OO!OO", &capsule, &PyList_Type, &plants, &states, &loads))
        return NULL;
    held_fleet *f = PyCapsule_GetPointer(capsule, FLEET);
    if (!f) return NULL;
    const size_t count = (size_t)PyList_Size(plants);
    if (array_open(&state, states, count, 18, 0) < 0) return NULL;
    if (array_open(&load, loads, count, 13, 0) < 0) {
        array_close(&state);
        return NULL;
    }
    gough_status status = GOUGH_OK;
    for (size_t i = 0; i < count && status == GOUGH_OK && !PyErr_Occurred(); i++) {
        const size_t plant = PyLong_AsSize_t(PyList_GetItem(plants, (Py_ssize_t)i));
        if (!PyErr_Occurred())
            status = put_plant(f, plant, state.value + state.stride * i,
                               load.value ? load.value + load.stride * i : NULL, &error);
    }
    array_close(&state);
    array_close(&load);
    if (PyErr_Occurred()) return NULL;
    if (status) return raise_error(&error);
    Py_RETURN_NONE;
}

/* the bytes of `ended`, one for each plant */
static int bytes_open(Py_buffer *view, PyObject *object, size_t count) {
    if (PyObject_GetBuffer(object, view, PyBUF_C_CONTIGUOUS | PyBUF_WRITABLE) < 0) return -1;
    if ((size_t)view->len == count) return 0;
    PyErr_Format(PyExc_ValueError, "there must be %zu bytes, one for each plant", count);
    PyBuffer_Release(view);
    return -1;
}

/* fleet_move(fleet, steps, threads, command, wrench, state, length, rate, ended); the wrench may be None */
static PyObject *fleet_move(PyObject *module, PyObject *arguments) {
    PyObject *capsule, *given[5], *bytes;
    long long steps;
    int threads;
    array_view view[5] = {{.value = NULL}};
    static const size_t each[5] = {6, 6, 18, 6, 6};
    Py_buffer ended;
    gough_error error = {.message = ""};
    gough_status status = GOUGH_OK;
    (void)module;
    if (!PyArg_ParseTuple(arguments, "OLiOOOOOO", &capsule, &steps, &threads, &given[0], &given[1],
                          &given[2], &given[3], &given[4], &bytes))
        return NULL;
    held_fleet *f = PyCapsule_GetPointer(capsule, FLEET);
    if (!f || bytes_open(&ended, bytes, f->count) < 0) return NULL;
    int failed = 0;
    for (int i = 0; i < 5 && !failed; i++)
        failed = array_open(&view[i], given[i], f->count, each[i], 1);
    if (!failed && view[0].value) {
        Py_BEGIN_ALLOW_THREADS status = gough_fleet_move(
            f->fleet, steps, view[0].value, view[1].value, threads,
            (gough_state *)(void *)view[2].value, view[3].value, view[4].value, ended.buf, &error);
        Py_END_ALLOW_THREADS
    }
    for (int i = 0; i < 5; i++) array_close(&view[i]);
    PyBuffer_Release(&ended);
    if (failed) return NULL;
    if (status) return raise_error(&error);
    Py_RETURN_NONE;
}

PyMethodDef plant_methods[] = {{"follow", follow, METH_VARARGS, NULL},
                               {"fleet_new", fleet_new, METH_VARARGS, NULL},
                               {"fleet_put", fleet_put, METH_VARARGS, NULL},
                               {"fleet_move", fleet_move, METH_VARARGS, NULL},
                               {NULL, NULL, 0, NULL}};
