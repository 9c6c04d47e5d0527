/** @file sizes.h
 *  Sizes of the structs that callers make. Programs in C need nothing of this: the names of functions carry the edition of the
 *  headers (names.h), and functions such as gough_simulation_default() pass the size of what they return. Other languages, which
 *  declare the structs anew, compare their sizes with gough_struct_size().
 *
 *  An error argument may be NULL.
 *
 *  Accuracy: sizes are exact.
 *  Overlap: arguments do not overlap.
 *  Threads: every function may be called from several threads at once; nothing is allocated.
 */
#ifndef GOUGH_SIZES_H
#define GOUGH_SIZES_H

#include "gough/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Bytes of a public struct in the loaded library, whatever the edition.
 *  @param name  such as "gough_model"
 *  @return 0 for other names */
GOUGH_API size_t gough_struct_size(const char *name);

/** Checks the member `size` of a struct.
 *  @param size  the member; 0, as in a zero-filled struct, passes
 *  @param own   sizeof the struct
 *  @param name  of the struct, for the sentence: "gough_simulation"
 *  @return GOUGH_OK, or GOUGH_ERROR_INPUT with a sentence if @p size is neither 0 nor @p own */
GOUGH_API gough_status gough_size_check(size_t size, size_t own, const char *name,
                                        gough_error *error);

/** Marks a struct of unexpected size as unusable: all @p size bytes are set to 0xff. Numbers are then NaN, enumerations and counts
 *  out of range, and a member `size` is that of no struct, so that every function refuses it.
 *  @return GOUGH_ERROR_INPUT */
GOUGH_API gough_status gough_size_refuse(void *of_caller, size_t size);

#ifdef __cplusplus
}
#endif
#endif
