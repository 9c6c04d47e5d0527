/* Rotations of a record: from quaternions, matrices and angles of another order to the angles of the study, and poses counted
 * from the first row. */
#ifndef STUDY_RECORD_ROTATION_H
#define STUDY_RECORD_ROTATION_H

#include "gough/model.h"
#include "study/quantum.h"

/* Angles in degrees, in an order, of a quaternion w, x, y, z of any length; false if all are 0 or one is not finite. */
bool study_quaternion_angles(const double q[4], gough_order order, double angle[3]);

/* Of a matrix R, row after row, that is a rotation up to the rounding of its digits: the angles of its orthonormal factor, found
 * by Newton's iteration. False if R is not a rotation: RᵀR differs from 1 by more than 0.1, or its determinant is negative. */
bool study_matrix_angles(const double r[9], gough_order order, double angle[3]);

/* What errors of quaternions or matrices are for angles, in degrees: their step and the greatest |pitch| of the record. */
study_quantum study_quaternion_step(study_quantum step, double pitch);
study_quantum study_matrix_step(study_quantum step, double pitch);

/* The rows' angles, in degrees and the order `from`, as those of the order `to`; `stride` apart. */
void study_angles_reorder(size_t count, double *angle, size_t stride, gough_order from,
                          gough_order to);

/* (motion-11): the poses of six components, angles in degrees, as seen from the first row's: R₁ᵀ (p − p₁) and R₁ᵀ R. The
 * steps of the six columns become those of what they are now. */
void study_poses_from_first(size_t count, double *value, gough_order order,
                            study_quantum step[GOUGH_COMPONENTS]);

#endif
