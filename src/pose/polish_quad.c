/* Roots in quadruple precision: residuals in 33 digits, corrections by an inverse in 16, (pose-11). */
#define NUMBER_QUAD
#define SCALAR_COMPLEX
#include "pose/polish.h"

#include "pose/frame.h"
#include "pose/soma.h"

/* the most corrections made; a correction below NOTHING_LEFT is not made: it is far below the roundings of double */
enum { CORRECTIONS = 4 };
static const double NOTHING_LEFT = 1e-21;

/* ε of a value; see point.h */
static const double ROUNDINGS = 64 * 1.93e-34;

/* (pose-2) with lengths; returns the largest sum of the moduli of a row's coefficients */
static double rows_of(const gough_machine *machine, const pose_frame *f,
                      const double length[GOUGH_LEGS], number row[GOUGH_LEGS][PRODUCTS]) {
    double greatest = 4;

    for (int v = 0; v < GOUGH_LEGS; v++) {
        const number l = number_of(length[v]) / number_of(f->scale);
        number b[3], a[3];
        double sum = 4;
        pose_frame_joints(f, machine, v, b, a);
        soma_row(b, a, row[v]);
        for (int n = 0; n < 4; n++) row[v][n] = row[v][n] - l * l;
        for (int n = 0; n < PRODUCTS; n++)
            sum += (n > SQUARE ? 2 : 1) * (double)number_magnitude(row[v][n]);
        greatest = greatest > sum ? greatest : sum;
    }
    return greatest;
}

/* F at x: six rows, e·g, and the unknown that is 1, which is exact; rounded to double, which does not lose what is small */
static void residual(number row[GOUGH_LEGS][PRODUCTS], const scalar x[SOMA], double F[SOMA][2]) {
    scalar twice[PRODUCTS], sum;

    for (int n = 0; n < PRODUCTS; n++) twice[n] = scalar_of(0);
    soma_products(x, x, twice);
    for (int v = 0; v < GOUGH_LEGS; v++) {
        sum = scalar_of(0);
        for (int n = 0; n < PRODUCTS; n++) sum = plus(sum, multiple(row[v][n], twice[n]));
        F[v][0] = (double)(sum.re / 2), F[v][1] = (double)(sum.im / 2);
    }
    sum = soma_dot(x, x + 4, 4);
    F[6][0] = (double)sum.re, F[6][1] = (double)sum.im;
    F[7][0] = F[7][1] = 0;
}

/* larger_or_nan() of double */
static double larger(double most, double x) { return (x > most ? x : most) + (x - x); }

/* Y F, and its norm */
static double correction(double Y[8][8][2], double F[8][2], double d[8][2]) {
    double most = 0;

    for (int i = 0; i < SOMA; i++) {
        double re = 0, im = 0;
        for (int k = 0; k < SOMA; k++) {
            re += Y[i][k][0] * F[k][0] - Y[i][k][1] * F[k][1];
            im += Y[i][k][0] * F[k][1] + Y[i][k][1] * F[k][0];
        }
        d[i][0] = re, d[i][1] = im;
        most = larger(most, fabs(re) + fabs(im));
    }
    return most;
}

void pose_polish(const gough_machine *machine, const pose_frame *frame,
                 const double length[GOUGH_LEGS], pose_root *root) {
    number row[GOUGH_LEGS][PRODUCTS];
    double F[8][2], d[8][2], largest = 0;
    const double greatest = rows_of(machine, frame, length, row);
    scalar x[SOMA];

    for (int k = 0; k < SOMA; k++)
        x[k] = (scalar){number_of(root->x[k][0]), number_of(root->x[k][1])};
    for (int n = 0;; n++) {
        residual(row, x, F);
        root->beta = correction(root->Y, F, d);
        if (n == CORRECTIONS || !(root->beta > NOTHING_LEFT)) break;
        d[root->chart][0] = d[root->chart][1] = 0;
        for (int k = 0; k < SOMA; k++) {
            x[k].re = x[k].re - number_of(d[k][0]);
            x[k].im = x[k].im - number_of(d[k][1]);
        }
    }

    root->far = root->off = 0;
    for (int k = 0; k < SOMA; k++) {
        const double re = (double)x[k].re, im = (double)x[k].im;
        const double moved = fabs((double)(x[k].re - number_of(root->x[k][0]))) +
                             fabs((double)(x[k].im - number_of(root->x[k][1])));
        const double off =
            fabs((double)(x[k].re - number_of(re))) + fabs((double)(x[k].im - number_of(im)));
        root->far = larger(root->far, moved), root->off = larger(root->off, off);
        largest = larger(largest, fabs(re) + fabs(im));
        root->x[k][0] = re, root->x[k][1] = im;
    }
    root->beta += root->size * ROUNDINGS * greatest * largest * largest;
}
