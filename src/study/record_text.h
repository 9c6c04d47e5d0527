/* The sentences about a record. */
#ifndef STUDY_RECORD_TEXT_H
#define STUDY_RECORD_TEXT_H

#include "study/record.h"

/* Angles that jumped and were made continuous, and those that still jump: the spline is prepared. */
void study_record_say_jumps(const study_record_table *table, const study_recording *recording);

/* Rounding that makes accelerations, and smoothing that does nothing. */
void study_record_say_rest(const study_record_table *table, const study_recording *recording);

/* A sentence about a record. */
void study_record_say(const study_recording *recording, bool warning, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
