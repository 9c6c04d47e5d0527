/* The module gough._gough: what the package calls in C. Its functions take and give plain objects and arrays; the package in
 * ../gough gives them names, units and sentences. */
#define _GNU_SOURCE
#include <pthread.h>
#include <string.h>

#include "python_api.h"

PyObject *failure_type;

PyObject *raise_failure(int status, const char *message, const char *key) {
    PyObject *arguments = Py_BuildValue("(isz)", status, message, key);
    if (arguments) PyErr_SetObject(failure_type, arguments);
    Py_XDECREF(arguments);
    return NULL;
}

PyObject *raise_error(const gough_error *error) {
    return raise_failure((int)error->status, error->message, error->key);
}

/* ---- columns ---- */

typedef struct column {
    PyObject_HEAD const double *value;
    Py_ssize_t count, stride;
    PyObject *owner;
} column;

static PyObject *column_type;

static void column_free(PyObject *self) {
    PyTypeObject *type = Py_TYPE(self);
    Py_XDECREF(((column *)self)->owner);
    freefunc release = (freefunc)PyType_GetSlot(type, Py_tp_free);
    release(self);
    Py_DECREF(type);
}

/* without `format` a buffer of doubles would be one of bytes */
static int column_buffer(PyObject *self, Py_buffer *view, int flags) {
    static double nothing;
    column *c = (column *)self;
    const double *value = c->value ? c->value : &nothing;
    char *start;
    memcpy(&start, &value, sizeof start); /* read only: the view says so */
    if (PyBuffer_FillInfo(view, self, start, c->count * c->stride, 1, flags) < 0) return -1;
    view->itemsize = c->stride;
    static char doubles[] = "d";
    view->format = flags & PyBUF_FORMAT ? doubles : NULL;
    view->shape = &c->count;
    view->strides = flags & PyBUF_STRIDES ? &c->stride : NULL;
    return 0;
}

int column_type_add(PyObject *module) {
    static PyType_Slot slots[] = {{Py_tp_dealloc, (void *)column_free},
                                  {Py_bf_getbuffer, (void *)column_buffer},
                                  {Py_tp_doc, (void *)"Numbers of a table, as a buffer."},
                                  {0, NULL}};
    static PyType_Spec spec = {"gough._gough.Column", sizeof(column), 0,
                               Py_TPFLAGS_DEFAULT | Py_TPFLAGS_DISALLOW_INSTANTIATION, slots};
    column_type = PyType_FromSpec(&spec);
    return column_type ? PyModule_AddObjectRef(module, "Column", column_type) : -1;
}

PyObject *column_new(const double *value, size_t count, PyObject *owner) {
    allocfunc allocate = (allocfunc)PyType_GetSlot((PyTypeObject *)column_type, Py_tp_alloc);
    column *c = (column *)(void *)allocate((PyTypeObject *)column_type, 0);
    if (!c) return NULL;
    c->value = value;
    c->count = (Py_ssize_t)count;
    c->stride = sizeof(double);
    c->owner = Py_NewRef(owner);
    return (PyObject *)c;
}

/* ---- arrays ---- */

int array_open(array_view *view, PyObject *object, size_t items, size_t each, int writable) {
    *view = (array_view){.value = NULL};
    if (object == Py_None) return 0;
    const int flags = PyBUF_C_CONTIGUOUS | PyBUF_FORMAT | (writable ? PyBUF_WRITABLE : 0);
    if (PyObject_GetBuffer(object, &view->buffer, flags) < 0) return -1;
    const size_t size = (size_t)view->buffer.len, one = each * sizeof(double);
    const char *format = view->buffer.format;
    if (view->buffer.itemsize != sizeof(double) || !format || strcmp(format, "d") != 0 ||
        (size != one * items && (writable || size != one))) {
        PyErr_Format(PyExc_ValueError,
                     "an array must be of float64 and have %zu numbers for each of %zu items; it "
                     "has %zu numbers",
                     each, items, size / sizeof(double));
        PyBuffer_Release(&view->buffer);
        return -1;
    }
    view->value = view->buffer.buf;
    view->stride = size == one * items && items != 1 ? each : 0;
    return 0;
}

void array_close(array_view *view) {
    if (view->value) PyBuffer_Release(&view->buffer);
    view->value = NULL;
}

/* ---- threads ---- */

enum { MOST_THREADS = 64 };

typedef struct share {
    item_work work;
    void *context;
    size_t first, last;
} share;

static void *work_share(void *context) {
    const share *s = context;
    s->work(s->context, s->first, s->last);
    return NULL;
}

void share_items(item_work work, void *context, size_t items, size_t least, int threads) {
    pthread_t thread[MOST_THREADS];
    share part[MOST_THREADS];
    int started[MOST_THREADS];
    size_t parts = threads > MOST_THREADS ? MOST_THREADS : (size_t)threads;

    if (parts > items / least) parts = items / least;
    if (parts < 1) parts = 1;
    for (size_t i = 0; i < parts; i++)
        part[i] = (share){work, context, items * i / parts, items * (i + 1) / parts};
    for (size_t i = 1; i < parts; i++)
        started[i] = pthread_create(&thread[i], NULL, work_share, &part[i]) == 0;
    (void)work_share(&part[0]);
    for (size_t i = 1; i < parts; i++) {
        if (started[i])
            (void)pthread_join(thread[i], NULL);
        else
            (void)work_share(&part[i]); /* the system had no thread for it */
    }
}

/* ---- the module ---- */

static int fill_module(PyObject *module) {
    failure_type = PyErr_NewException("gough._gough.Failure", NULL, NULL);
    if (!failure_type || PyModule_AddObjectRef(module, "Failure", failure_type) < 0) return -1;
    if (PyModule_AddStringConstant(module, "version", gough_version()) < 0) return -1;
    if (PyModule_AddFunctions(module, study_methods) < 0 ||
        PyModule_AddFunctions(module, machine_methods) < 0 ||
        PyModule_AddFunctions(module, plant_methods) < 0)
        return -1;
    return column_type_add(module);
}

PyMODINIT_FUNC PyInit__gough(void); /* Python looks it up by name */

PyMODINIT_FUNC PyInit__gough(void) {
    static PyModuleDef definition = {PyModuleDef_HEAD_INIT,
                                     "gough._gough",
                                     "The library of gough for the package gough.",
                                     -1,
                                     NULL,
                                     NULL,
                                     NULL,
                                     NULL,
                                     NULL};
    PyObject *module = PyModule_Create(&definition);
    if (module && fill_module(module) < 0) {
        Py_DECREF(module);
        return NULL;
    }
    return module;
}
