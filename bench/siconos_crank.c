/* The flat slider-crank of rigid_peers.py for Siconos, which calls these by their names: angles of crank, rod and block from the way, lengths and
 * masses as in rigid_mechanism.py.  M v' + gyroscopic + weight = impulses of the gaps. */
#include <math.h>

static const double crank = 0.153, rod = 0.306, half_length = 0.05, half_height = 0.025, clearance = 1e-3;
static const double crank_mass = 0.038, rod_mass = 0.038, block_mass = 0.076, crank_inertia = 7.4e-5, rod_inertia = 5.9e-4, block_inertia = 2.7e-6;
static const double gravity = 9.81;

static double coupling(void) { return (rod_mass / 2 + block_mass) * crank * rod; }

void mass(unsigned size, double* q, double* m, unsigned parameters, double* z) {
    (void)parameters, (void)z;
    for (unsigned i = 0; i < size * size; ++i) m[i] = 0;
    m[0] = crank_inertia + (crank_mass / 4 + rod_mass + block_mass) * crank * crank;
    m[1] = m[3] = coupling() * cos(q[0] - q[1]);
    m[4] = rod_inertia + (rod_mass / 4 + block_mass) * rod * rod;
    m[8] = block_inertia;
}

void gyroscopic(unsigned size, double* q, double* v, double* f, unsigned parameters, double* z) {
    (void)size, (void)parameters, (void)z;
    double const part = coupling() * sin(q[0] - q[1]);
    f[0] = part * v[1] * v[1];
    f[1] = -part * v[0] * v[0];
    f[2] = 0;
}

/* Derivatives by q and by v, column by column. */
void gyroscopic_by_q(unsigned size, double* q, double* v, double* d, unsigned parameters, double* z) {
    (void)parameters, (void)z;
    for (unsigned i = 0; i < size * size; ++i) d[i] = 0;
    double const part = coupling() * cos(q[0] - q[1]);
    d[0] = part * v[1] * v[1], d[3] = -d[0];
    d[1] = -part * v[0] * v[0], d[4] = -d[1];
}

void gyroscopic_by_v(unsigned size, double* q, double* v, double* d, unsigned parameters, double* z) {
    (void)parameters, (void)z;
    for (unsigned i = 0; i < size * size; ++i) d[i] = 0;
    double const part = coupling() * sin(q[0] - q[1]);
    d[1] = -2 * part * v[0], d[3] = 2 * part * v[1];
}

void weight(double time, unsigned size, double* q, double* v, double* f, unsigned parameters, double* z) {
    (void)time, (void)size, (void)v, (void)parameters, (void)z;
    f[0] = (crank_mass / 2 + rod_mass + block_mass) * gravity * crank * cos(q[0]);
    f[1] = (rod_mass / 2 + block_mass) * gravity * rod * cos(q[1]);
    f[2] = 0;
}

void weight_by_q(double time, unsigned size, double* q, double* v, double* d, unsigned parameters, double* z) {
    (void)time, (void)v, (void)parameters, (void)z;
    for (unsigned i = 0; i < size * size; ++i) d[i] = 0;
    d[0] = -(crank_mass / 2 + rod_mass + block_mass) * gravity * crank * sin(q[0]);
    d[4] = -(rod_mass / 2 + block_mass) * gravity * rod * sin(q[1]);
}

void nothing_by_v(double time, unsigned size, double* q, double* v, double* d, unsigned parameters, double* z) {
    (void)time, (void)q, (void)v, (void)parameters, (void)z;
    for (unsigned i = 0; i < size * size; ++i) d[i] = 0;
}

/* Gap of the corner in front (along = 1) or behind (-1), above (side = 1) or below. */
static void gap(double const* q, double along, double side, double* y) {
    double const height = crank * sin(q[0]) + rod * sin(q[1]) + along * half_length * sin(q[2]) + side * half_height * cos(q[2]);
    y[0] = half_height + clearance - side * height;
}

static void gap_by_q(double const* q, double along, double side, double* d) {
    d[0] = -side * crank * cos(q[0]);
    d[1] = -side * rod * cos(q[1]);
    d[2] = -side * (along * half_length * cos(q[2]) - side * half_height * sin(q[2]));
}

#define CORNER(name, along, side)                                                                              \
    void gap_##name(unsigned size, double* q, unsigned gaps, double* y, unsigned parameters, double* z) {      \
        (void)size, (void)gaps, (void)parameters, (void)z;                                                     \
        gap(q, along, side, y);                                                                                \
    }                                                                                                          \
    void gap_##name##_by_q(unsigned size, double* q, unsigned gaps, double* d, unsigned parameters, double* z) { \
        (void)size, (void)gaps, (void)parameters, (void)z;                                                     \
        gap_by_q(q, along, side, d);                                                                           \
    }

CORNER(upper_front, 1, 1)
CORNER(upper_back, -1, 1)
CORNER(lower_front, 1, -1)
CORNER(lower_back, -1, -1)
