/* An HDF5 file that goes straight into an output, so that memory does not grow with the file. */
#ifndef GOUGH_TABLE_HDF5_OUTPUT_H
#define GOUGH_TABLE_HDF5_OUTPUT_H

#include <hdf5.h>

#include "table/table.h"

/* Where the bytes go. After a write that fails, `failed` is its errno and nothing more is written, but HDF5 is told that all went
 * well: the library (1.10) crashes when it closes a file that it could not write. */
typedef struct hdf5_output {
    int file;
    int failed;
    bool finished;             /* nothing more is written */
    unsigned long long length; /* allocated by HDF5 */
} hdf5_output;

/* Makes a list of access properties write into this; the driver is to be closed when the file is. Negative on failure. */
hid_t hdf5_output_set(hid_t access, hdf5_output *output);
void hdf5_output_close(hid_t driver);

/* To be called when the open file has been flushed: the bytes stay as they are, and those that HDF5 has allocated but not written
 * are zeros. Closing the file would give unused space at its end back, and files of earlier versions have it. */
void hdf5_output_finish(hdf5_output *output);

#endif
