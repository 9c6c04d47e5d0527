/* Modes in words: which components move, in which proportion. A symmetric machine has modes in pairs of one value, where every
 * mixture is a mode too: there the two are told that move along one axis each. */
#include <complex.h>
#include <math.h>
#include <string.h>

#include "cli/common/paragraph.h"
#include "cli/common/scale.h"
#include "cli/stability/stability_report.h"

enum { AXES = 6 };
static const double DEGREES = 57.295779513082320877;
static const char *const axis_name[AXES] = {"surge", "sway", "heave", "roll", "pitch", "yaw"};

/* what moves a joint by less than this share of the rest is not told */
static const double least_told = 0.005;

static void append(char words[MODE_WORDS], const char *text) {
    const size_t used = strlen(words);
    snprintf(words + used, MODE_WORDS - used, "%s", text);
}

/* " 0.53", " -31 deg", " 0.2 (80 deg ahead)"; a phase beyond a right angle is told by the sign. */
static void append_ratio(char words[MODE_WORDS], double complex ratio, const char *unit) {
    const double sign = creal(ratio) < 0 ? -1 : 1, phase = carg(sign * ratio) * DEGREES;
    char text[64];
    if (fabs(phase) < 0.5)
        snprintf(text, sizeof text, " %.3g%s", sign * cabs(ratio), unit);
    else
        snprintf(text, sizeof text, " %.3g%s (%.0f deg %s)", sign * cabs(ratio), unit, fabs(phase),
                 phase > 0 ? "ahead" : "behind");
    append(words, text);
}

/* How much each component moves a joint. */
static double component_size(const double complex shape[AXES], int axis, double arm) {
    return cabs(shape[axis]) * (axis < 3 ? 1.0 : arm);
}

static int largest_component(const double complex shape[AXES], double arm) {
    int largest = 0;
    for (int a = 1; a < AXES; a++) /* of those that round-off alone tells apart, the first */
        if (component_size(shape, a, arm) > (1 + 1e-9) * component_size(shape, largest, arm))
            largest = a;
    return largest;
}

/* What the component that moves a joint most is given as: 0.1, 0.1 m or 10 degrees; in other units the power of ten below that. */
static double given_size(const gough_units *units, int axis) {
    const gough_units usual = gough_units_si();
    const gough_unit unit = component_unit(axis);
    const double size = axis < 3 ? 0.1 : gough_unit_read(&usual, unit, 10);
    if (units->dimensionless) return axis < 3 ? size : 10;
    return pow(10, floor(log10(in_units(units, unit, size)) + 1e-9));
}

/* "surge 0.1 m with pitch -3.1 deg", "yaw alone" */
static void append_shape(char words[MODE_WORDS], const double complex shape[AXES], double arm,
                         const gough_units *units) {
    const int lead = largest_component(shape, arm);
    const double least = least_told * component_size(shape, lead, arm);
    /* shifts are in the units of the output already, rotations in radians */
    const double turn = gough_unit_factor(units, GOUGH_UNIT_ANGLE), given = given_size(units, lead);
    const double complex factor = given / (lead < 3 ? 1 : turn) / shape[lead];
    int told = 0;
    for (int a = 0; a < AXES; a++) told += component_size(shape, a, arm) > least;
    append(words, axis_name[lead]);
    if (told <= 1) {
        append(words, " alone");
        return;
    }
    append_ratio(words, given, unit_word(units, component_unit(lead)));
    const char *joint = " with ";
    for (int a = 0; a < AXES; a++) {
        if (a == lead || !(component_size(shape, a, arm) > least)) continue;
        append(words, joint);
        append(words, axis_name[a]);
        append_ratio(words, (a < 3 ? 1 : turn) * factor * shape[a],
                     unit_word(units, component_unit(a)));
        joint = ", ";
    }
}

/* The combination of v and w whose components i and j are 1 and 0; false where no combination has them. */
static bool combine(const double complex v[AXES], const double complex w[AXES], int i, int j,
                    double complex combination[AXES]) {
    const double complex determinant = v[i] * w[j] - w[i] * v[j];
    double size = 0;
    for (int a = 0; a < AXES; a++) size = fmax(size, cabs(v[a]) * cabs(w[a]));
    if (!(cabs(determinant) > 1e-6 * size)) return false;
    for (int a = 0; a < AXES; a++) combination[a] = (v[a] * w[j] - w[a] * v[j]) / determinant;
    return true;
}

void stability_mode_words(const gough_mode *const *mode, int count, double arm,
                          const gough_units *units, char words[MODE_WORDS]) {
    double complex shape[2][AXES], along[2][AXES];
    words[0] = '\0';
    for (int m = 0; m < 2 && m < count; m++)
        for (int a = 0; a < AXES; a++)
            shape[m][a] = mode[m]->shape[a][0] + I * mode[m]->shape[a][1];
    for (int i = 0; count == 2 && i <= 3; i += 3) {
        if (!combine(shape[0], shape[1], i, i + 1, along[0]) ||
            !combine(shape[0], shape[1], i + 1, i, along[1]))
            continue;
        memcpy(shape, along, sizeof shape);
        break;
    }
    for (int m = 0; m < 2 && m < count; m++) {
        if (m) append(words, "; ");
        append_shape(words, shape[m], arm, units);
    }
}

void stability_pad(FILE *stream, const char *text, int width) {
    const int shown = text_columns(text);
    fprintf(stream, "%s%*s", text, width > shown ? width - shown : 0, "");
}
