/* The four-bar of linkage_peers.py for Siconos, which calls these by their names: angle of the crank, then x, y and angle of coupler and rocker, whose
 * origins are their mass centres.  M v' + weight = impulses of the gaps; M is constant, and nothing is gyroscopic. */
#include <math.h>
#include <string.h>

static const double coupler = 2, rocker = 1.25, post = 3, clearance = 5e-3, gravity = 9.81;

void mass(unsigned size, double* q, double* m, unsigned parameters, double* z) {
    (void)q, (void)parameters, (void)z;
    static const double diagonal[] = {1.0 / 3, 1, 1, 16.0 / 12, 1, 1, 6.25 / 12};
    memset(m, 0, size * size * sizeof *m);
    for (unsigned i = 0; i < size; ++i) m[i * (size + 1)] = diagonal[i];
}

void weight(double time, unsigned size, double* q, double* v, double* f, unsigned parameters, double* z) {
    (void)time, (void)v, (void)parameters, (void)z;
    memset(f, 0, size * sizeof *f);
    f[0] = gravity / 2 * cos(q[0]);
    f[2] = f[5] = gravity;
}

void weight_by_q(double time, unsigned size, double* q, double* v, double* d, unsigned parameters, double* z) {
    (void)time, (void)v, (void)parameters, (void)z;
    memset(d, 0, size * size * sizeof *d);
    d[0] = -gravity / 2 * sin(q[0]);
}

void nothing_by_v(double time, unsigned size, double* q, double* v, double* d, unsigned parameters, double* z) {
    (void)time, (void)q, (void)v, (void)parameters, (void)z;
    memset(d, 0, size * size * sizeof *d);
}

/* Offset of a journal, and its derivatives: of x by all coordinates, then of y. */
static void crank_pin(double const* q, double* e, double d[2][7]) {
    e[0] = cos(q[0]) - (q[1] - coupler * cos(q[3])), e[1] = sin(q[0]) - (q[2] - coupler * sin(q[3]));
    d[0][0] = -sin(q[0]), d[1][0] = cos(q[0]), d[0][1] = d[1][2] = -1, d[0][3] = -coupler * sin(q[3]), d[1][3] = coupler * cos(q[3]);
}
static void coupler_pin(double const* q, double* e, double d[2][7]) {
    e[0] = q[1] + coupler * cos(q[3]) - q[4] - rocker * cos(q[6]), e[1] = q[2] + coupler * sin(q[3]) - q[5] - rocker * sin(q[6]);
    d[0][1] = d[1][2] = 1, d[0][3] = -coupler * sin(q[3]), d[1][3] = coupler * cos(q[3]);
    d[0][4] = d[1][5] = -1, d[0][6] = rocker * sin(q[6]), d[1][6] = -rocker * cos(q[6]);
}
static void rocker_pin(double const* q, double* e, double d[2][7]) {
    e[0] = q[4] - rocker * cos(q[6]) - post, e[1] = q[5] - rocker * sin(q[6]);
    d[0][4] = d[1][5] = 1, d[0][6] = rocker * sin(q[6]), d[1][6] = -rocker * cos(q[6]);
}

#define GAP(pin)                                                                                          \
    void gap_##pin(unsigned size, double* q, unsigned gaps, double* y, unsigned parameters, double* z) {  \
        (void)size, (void)gaps, (void)parameters, (void)z;                                                \
        double e[2], d[2][7];                                                                             \
        pin(q, e, d);                                                                                     \
        y[0] = clearance - hypot(e[0], e[1]);                                                             \
    }                                                                                                     \
    void gap_##pin##_by_q(unsigned size, double* q, unsigned gaps, double* g, unsigned parameters, double* z) { \
        (void)gaps, (void)parameters, (void)z;                                                            \
        double e[2], d[2][7] = {{0}};                                                                     \
        pin(q, e, d);                                                                                     \
        double const inverse = 1 / fmax(hypot(e[0], e[1]), 1e-30);                                        \
        for (unsigned i = 0; i < size; ++i) g[i] = -inverse * (e[0] * d[0][i] + e[1] * d[1][i]);          \
    }

GAP(crank_pin)
GAP(coupler_pin)
GAP(rocker_pin)
