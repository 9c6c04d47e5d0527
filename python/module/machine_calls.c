/* One machine in many poses: a call computes all items of its arrays in threads, without the interpreter's lock. Numbers are in the
 * units of the model, SI or dimensionless, angles in radians; frames are those of gough/dynamics.h. */
#define _GNU_SOURCE
#include <math.h>
#include <stdatomic.h>
#include <string.h>

#include "python_api.h"

/* what a call reads, in the order of its arguments, and how many doubles an item has */
enum {
    POSITION,
    ROTATION,
    VELOCITY,
    ANGULAR_VELOCITY,
    ACCELERATION,
    ANGULAR_ACCELERATION,
    FORCE,
    WRENCH,
    INPUTS,
    OUTPUTS = 4
};
static const size_t input_size[INPUTS] = {3, 9, 3, 3, 3, 3, 6, 6};

typedef struct call {
    const gough_machine *machine;
    array_view in[INPUTS], out[OUTPUTS];
    atomic_size_t
        refused; /* one more than the first item that is no rotation; 0: there is no such item */
    int (*one)(struct call *call, size_t item, const gough_state *state); /* gough_status */
} call;

static const double *input(const call *c, int which, size_t item) {
    const array_view *view = &c->in[which];
    return view->value ? view->value + item * view->stride : NULL;
}

static double *output(const call *c, int which, size_t item, size_t each) {
    return c->out[which].value ? c->out[which].value + item * each : NULL;
}

static void copy_input(const call *c, int which, size_t item, double *to, size_t count) {
    const double *from = input(c, which, item);
    for (size_t i = 0; i < count; i++) to[i] = from ? from[i] : 0;
}

static gough_acceleration acceleration_of(const call *c, size_t item) {
    gough_acceleration a;
    copy_input(c, ACCELERATION, item, a.linear, 3);
    copy_input(c, ANGULAR_ACCELERATION, item, a.angular, 3);
    return a;
}

static const gough_wrench *wrench_of(const call *c, size_t item, gough_wrench *wrench) {
    if (!c->in[WRENCH].value) return NULL;
    memcpy(wrench, input(c, WRENCH, item), sizeof *wrench);
    return wrench;
}

static void blank(const call *c, int which, size_t item, size_t each) {
    double *to = output(c, which, item, each);
    for (size_t i = 0; to && i < each; i++) to[i] = NAN;
}

/* ---- one item of each function ------------------------------------------------------------------------------------ */

static int one_kinematics(call *c, size_t i, const gough_state *state) {
    const gough_acceleration a = acceleration_of(c, i);
    return (int)gough_leg_kinematics(c->machine, state, c->out[2].value ? &a : NULL,
                                     output(c, 0, i, 6), output(c, 1, i, 6), output(c, 2, i, 6));
}

static int one_jacobian(call *c, size_t i, const gough_state *state) {
    double jacobian[GOUGH_LEGS][6];
    const gough_status status = gough_jacobian(c->machine, state, jacobian);
    if (!status) memcpy(output(c, 0, i, 36), jacobian, sizeof jacobian);
    return (int)status;
}

static int one_conditioning(call *c, size_t i, const gough_state *state) {
    return (int)gough_conditioning(c->machine, state, output(c, 0, i, 1), output(c, 1, i, 1));
}

/* forces, and on request the condition number and the lengths */
static int one_inverse(call *c, size_t i, const gough_state *state) {
    const gough_acceleration a = acceleration_of(c, i);
    gough_wrench wrench;
    const gough_status status = gough_inverse_dynamics(
        c->machine, state, &a, wrench_of(c, i, &wrench), output(c, 0, i, 6), output(c, 1, i, 1));
    if (status) blank(c, 0, i, 6);
    if (c->out[2].value)
        (void)gough_leg_kinematics(c->machine, state, NULL, output(c, 2, i, 6), NULL, NULL);
    return (int)status;
}

static int one_forward(call *c, size_t i, const gough_state *state) {
    gough_acceleration a;
    gough_wrench wrench;
    double force[GOUGH_LEGS];
    copy_input(c, FORCE, i, force, 6);
    const gough_status status =
        gough_forward_dynamics(c->machine, state, force, wrench_of(c, i, &wrench), &a);
    if (status) {
        blank(c, 0, i, 3);
        blank(c, 1, i, 3);
    } else {
        memcpy(output(c, 0, i, 3), a.linear, sizeof a.linear);
        memcpy(output(c, 1, i, 3), a.angular, sizeof a.angular);
    }
    return (int)status;
}

static int one_joints(call *c, size_t i, const gough_state *state) {
    const gough_acceleration a = acceleration_of(c, i);
    gough_wrench wrench;
    double top[GOUGH_LEGS][3], base[GOUGH_LEGS][3];
    const gough_status status =
        gough_joint_forces(c->machine, state, &a, wrench_of(c, i, &wrench), output(c, 0, i, 6), top,
                           base, output(c, 3, i, 6));
    if (status) {
        const size_t each[OUTPUTS] = {6, 18, 18, 6};
        for (int o = 0; o < OUTPUTS; o++) blank(c, o, i, each[o]);
    } else {
        memcpy(output(c, 1, i, 18), top, sizeof top);
        memcpy(output(c, 2, i, 18), base, sizeof base);
    }
    return (int)status;
}

static const struct {
    const char *name;
    int (*one)(call *call, size_t item, const gough_state *state);
    size_t out[OUTPUTS];
} functions[] = {
    {"kinematics", one_kinematics, {6, 6, 6, 0}},
    {"jacobian", one_jacobian, {36, 0, 0, 0}},
    {"conditioning", one_conditioning, {1, 1, 0, 0}},
    {"inverse_dynamics", one_inverse, {6, 1, 6, 0}},
    {"forward_dynamics", one_forward, {3, 3, 0, 0}},
    {"joint_forces", one_joints, {6, 18, 18, 6}},
};

/* ---- all items ---------------------------------------------------------------------------------------------------- */

static void refuse(call *c, size_t item) {
    size_t before = atomic_load(&c->refused);
    while ((before == 0 || item + 1 < before) &&
           !atomic_compare_exchange_weak(&c->refused, &before, item + 1)) {
    }
}

static void work_items(void *context, size_t first, size_t last) {
    call *c = context;
    gough_state state;
    for (size_t i = first; i < last; i++) {
        copy_input(c, POSITION, i, state.position, 3);
        copy_input(c, ROTATION, i, state.rotation[0], 9);
        copy_input(c, VELOCITY, i, state.velocity, 3);
        copy_input(c, ANGULAR_VELOCITY, i, state.angular_velocity, 3);
        if (c->one(c, i, &state) == (int)GOUGH_ERROR_INPUT) refuse(c, i);
    }
}

enum { LEAST_ITEMS = 256 /* of a thread: starting it takes about as long as 50 */ };

/* each(function, study, items, threads, eight inputs, four outputs): None, or the number of the first item that is refused, from 0.
 * Inputs are position, rotation, velocity, angular velocity, acceleration, angular acceleration, leg forces, wrench; None is 0. */
static PyObject *each(PyObject *module, PyObject *const *argument, Py_ssize_t count) {
    call c = {.machine = NULL};
    gough_study *study;
    (void)module;
    if (count != 4 + INPUTS + OUTPUTS) {
        PyErr_SetString(PyExc_TypeError, "each() takes 16 arguments");
        return NULL;
    }
    const long which = PyLong_AsLong(argument[0]);
    const size_t items = PyLong_AsSize_t(argument[2]);
    const int threads = (int)PyLong_AsLong(argument[3]);
    if (PyErr_Occurred() || !(study = study_of(argument[1]))) return NULL;
    if (which < 0 || which >= (long)(sizeof functions / sizeof functions[0])) {
        PyErr_SetString(PyExc_ValueError, "there is no such function");
        return NULL;
    }
    c.machine = &study->model->machine;
    c.one = functions[which].one;
    atomic_init(&c.refused, 0);
    int failed = 0;
    for (int i = 0; i < INPUTS && !failed; i++)
        failed = array_open(&c.in[i], argument[4 + i], items, input_size[i], 0);
    for (int i = 0; i < OUTPUTS && !failed; i++)
        failed = array_open(&c.out[i], argument[4 + INPUTS + i], items, functions[which].out[i], 1);
    if (!failed && items > 0) {
        if (items < 2 * LEAST_ITEMS) { /* so short that giving the lock away would cost more */
            work_items(&c, 0, items);
        } else {
            Py_BEGIN_ALLOW_THREADS share_items(work_items, &c, items, LEAST_ITEMS, threads);
            Py_END_ALLOW_THREADS
        }
    }
    for (int i = 0; i < INPUTS; i++) array_close(&c.in[i]);
    for (int i = 0; i < OUTPUTS; i++) array_close(&c.out[i]);
    if (failed) return NULL;
    const size_t refused = atomic_load(&c.refused);
    if (refused) return PyLong_FromSize_t(refused - 1);
    Py_RETURN_NONE;
}

/* threads(wanted): how many a call uses for 0 */
static PyObject *threads_for(PyObject *module, PyObject *wanted) {
    (void)module;
    const long threads = PyLong_AsLong(wanted);
    if (PyErr_Occurred()) return NULL;
    return PyLong_FromLong(gough_batch_threads((int)threads));
}

/* ---- angles ------------------------------------------------------------------------------------------------------- */

/* rotations(order, items, angles, rotation) */
static PyObject *rotations(PyObject *module, PyObject *arguments) {
    int order;
    Py_ssize_t items;
    PyObject *from, *to;
    array_view angles, rotation;
    (void)module;
    if (!PyArg_ParseTuple(arguments, "inOO", &order, &items, &from, &to)) return NULL;
    if (array_open(&angles, from, (size_t)items, 3, 0) < 0) return NULL;
    if (array_open(&rotation, to, (size_t)items, 9, 1) < 0) {
        array_close(&angles);
        return NULL;
    }
    for (size_t i = 0; i < (size_t)items; i++) {
        double r[3][3];
        gough_rotation_in_order((gough_order)order, angles.value + 3 * i, r);
        memcpy(rotation.value + 9 * i, r, sizeof r);
    }
    array_close(&angles);
    array_close(&rotation);
    Py_RETURN_NONE;
}

/* angles_of(order, items, rotation, angles): None, or the first item that is no rotation */
static PyObject *angles_of(PyObject *module, PyObject *arguments) {
    int order;
    Py_ssize_t items, refused = -1;
    PyObject *from, *to;
    array_view rotation, angles;
    (void)module;
    if (!PyArg_ParseTuple(arguments, "inOO", &order, &items, &from, &to)) return NULL;
    if (array_open(&rotation, from, (size_t)items, 9, 0) < 0) return NULL;
    if (array_open(&angles, to, (size_t)items, 3, 1) < 0) {
        array_close(&rotation);
        return NULL;
    }
    for (Py_ssize_t i = 0; i < items && refused < 0; i++) {
        double r[3][3];
        memcpy(r, rotation.value + 9 * i, sizeof r);
        if (gough_angles_in_order((gough_order)order, r, angles.value + 3 * i)) refused = i;
    }
    array_close(&rotation);
    array_close(&angles);
    if (refused >= 0) return PyLong_FromSsize_t(refused);
    Py_RETURN_NONE;
}

/* ---- the machine -------------------------------------------------------------------------------------------------- */

/* machine_facts(study): numbers of the machine, in the units of the model */
static PyObject *machine_facts(PyObject *module, PyObject *capsule) {
    const gough_study *study = study_of(capsule);
    (void)module;
    if (!study) return NULL;
    const gough_machine *m = &study->model->machine;
    return Py_BuildValue(
        "{s:d,s:d,s:d,s:N,s:N,s:N,s:N,s:i}", "height", m->platform.height, "base_radius",
        m->base_radius, "mass", m->load.mass, "base", column_new(m->platform.base[0], 18, capsule),
        "top", column_new(m->platform.top[0], 18, capsule), "home_length",
        column_new(m->home_length, 6, capsule), "gravity", column_new(m->gravity, 3, capsule),
        "order", (int)study->model->motion.order);
}

PyMethodDef machine_methods[] = {{"each", (PyCFunction)(void (*)(void))each, METH_FASTCALL, NULL},
                                 {"threads", threads_for, METH_O, NULL},
                                 {"rotations", rotations, METH_VARARGS, NULL},
                                 {"angles_of", angles_of, METH_VARARGS, NULL},
                                 {"machine_facts", machine_facts, METH_O, NULL},
                                 {NULL, NULL, 0, NULL}};
