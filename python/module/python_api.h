/* Python's own interface, the part of it that stays the same in all later versions, and numbers in arrays of a caller. */
#ifndef GOUGH_PYTHON_API_H
#define GOUGH_PYTHON_API_H

#define Py_LIMITED_API 0x030B0000 /* 3.11: the first with buffers in it */
#define PY_SSIZE_T_CLEAN
#include <Python.h>

#include "gough/gough.h"

/* ---- errors: _gough.Failure(status, message, key) ---- */

extern PyObject *failure_type;

/* Raises it; returns NULL. `key` may be NULL. */
PyObject *raise_failure(int status, const char *message, const char *key);
PyObject *raise_error(const gough_error *error);

/* ---- objects of the library that Python keeps ---- */

/* The study in a capsule; NULL with an exception if the object is another one. */
gough_study *study_of(PyObject *object);

/* Numbers that belong to another object, as a buffer of doubles with one dimension, which numpy takes without a copy. */
PyObject *column_new(const double *value, size_t count, PyObject *owner);
int column_type_add(PyObject *module);

/* ---- arrays of the caller ---- */

/* An array of items, each so many doubles; or one item that is the same for all. */
typedef struct array_view {
    Py_buffer buffer;
    double *value; /* NULL: None was given */
    size_t stride; /* doubles from one item to the next; 0: the same for all */
} array_view;

/* Views an object for `items` items of `each` doubles: a C-contiguous buffer of float64, or None. Returns 0, or -1 with an
 * exception. */
int array_open(array_view *view, PyObject *object, size_t items, size_t each, int writable);
void array_close(array_view *view);

/* ---- threads ---- */

/* Work on the items from `first` to before `last`. */
typedef void (*item_work)(void *context, size_t first, size_t last);

/* Divides `items` among at most `threads` threads, none with fewer than `least` items; the caller's thread is one of them. Call it
 * without the interpreter's lock. */
void share_items(item_work work, void *context, size_t items, size_t least, int threads);

/* ---- functions of the module ---- */

extern PyMethodDef study_methods[], machine_methods[], plant_methods[];

#endif
