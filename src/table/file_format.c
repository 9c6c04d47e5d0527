/* Which format a path asks for. */
#define _POSIX_C_SOURCE 200809L

#include <string.h>
#include <strings.h>

#include "table/table.h"

static bool ends_in(const char *path, const char *extension) {
    const size_t length = strlen(path), tail = strlen(extension);
    return length >= tail && strcasecmp(path + length - tail, extension) == 0;
}

gough_status gough_result_write(const gough_result *result, const char *path, gough_error *error) {
    if (strcmp(path, "-") == 0 || ends_in(path, ".csv"))
        return result_write_csv(result, path, error);
    if (ends_in(path, ".h5")) return result_write_hdf5(result, path, error);
    return gough_fail(error, GOUGH_ERROR_INPUT,
                      "%s: the name must end in .h5 (HDF5) or .csv, or be - for CSV on standard "
                      "output",
                      path);
}
