/* A file driver of HDF5 that writes to a descriptor which is open already: that of an output, which has no name before it is
 * complete. It has the features of HDF5's driver in memory, which lays files out in the same way, byte for byte. */
#define _POSIX_C_SOURCE 200809L
#include "table/hdf5_output.h"

#include <errno.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#if H5_VERSION_GE(1, 13, 0)
#include <H5FDdevelop.h>
#endif

/* HDF5's part comes first. */
typedef struct driver_file {
    H5FD_t pub;
    hdf5_output *output;
    haddr_t end; /* of what is written */
} driver_file;

/* Properties hold a pointer to the output. */
typedef struct driver_info {
    hdf5_output *output;
} driver_info;

static H5FD_t *open_file(const char *name, unsigned flags, hid_t access, haddr_t most) {
    (void)name, (void)flags, (void)most;
    const driver_info *info = H5Pget_driver_info(access);
    driver_file *file = info ? calloc(1, sizeof *file) : NULL;
    if (file == NULL) return NULL;
    file->output = info->output;
    return &file->pub;
}

/* The descriptor is the output's. */
static herr_t close_file(H5FD_t *given) {
    free(given);
    return 0;
}

static herr_t query(const H5FD_t *given, unsigned long *flags) {
    (void)given;
    *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
             H5FD_FEAT_AGGREGATE_SMALLDATA;
    return 0;
}

static haddr_t get_allocated(const H5FD_t *given, H5FD_mem_t type) {
    (void)type;
    return ((const driver_file *)given)->output->length;
}

static herr_t set_allocated(H5FD_t *given, H5FD_mem_t type, haddr_t address) {
    (void)type;
    ((driver_file *)given)->output->length = address;
    return 0;
}

static haddr_t get_end(const H5FD_t *given, H5FD_mem_t type) {
    (void)type;
    return ((const driver_file *)given)->end;
}

/* Beyond the end of the file are zeros. */
static herr_t read_bytes(H5FD_t *given, H5FD_mem_t type, hid_t transfer, haddr_t address,
                         size_t size, void *bytes) {
    (void)type, (void)transfer;
    const driver_file *file = (const driver_file *)given;
    size_t done = 0;
    while (done < size) {
        const ssize_t got =
            pread(file->output->file, (char *)bytes + done, size - done, (off_t)(address + done));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return -1;
        if (got == 0) break;
        done += (size_t)got;
    }
    memset((char *)bytes + done, 0, size - done);
    return 0;
}

static herr_t write_bytes(H5FD_t *given, H5FD_mem_t type, hid_t transfer, haddr_t address,
                          size_t size, const void *bytes) {
    (void)type, (void)transfer;
    driver_file *file = (driver_file *)given;
    hdf5_output *output = file->output;
    const bool wanted = output->failed == 0 && !output->finished;
    for (size_t done = 0; done < size && wanted && output->failed == 0;) {
        const ssize_t written =
            pwrite(output->file, (const char *)bytes + done, size - done, (off_t)(address + done));
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0)
            output->failed = written < 0 && errno ? errno : ENOSPC;
        else
            done += (size_t)written;
    }
    if (address + size > file->end) file->end = address + size;
    return 0;
}

/* The file ends where HDF5 has allocated its last byte, written or not. */
static void settle_length(hdf5_output *output) {
    if (output->failed == 0 && !output->finished &&
        ftruncate(output->file, (off_t)output->length) != 0)
        output->failed = errno;
}

static herr_t truncate_file(H5FD_t *given, hid_t transfer, hbool_t closing) {
    (void)transfer, (void)closing;
    driver_file *file = (driver_file *)given;
    settle_length(file->output);
    file->end = file->output->length;
    return 0;
}

void hdf5_output_finish(hdf5_output *output) {
    settle_length(output);
    output->finished = true;
}

static const H5FD_class_t driver_class = {
#ifdef H5FD_CLASS_VERSION
    .version = H5FD_CLASS_VERSION,
    .value = (H5FD_class_value_t)600, /* 512 and above are nobody's */
#endif
    .name = "gough-output",
    .maxaddr = (haddr_t)INT64_MAX,
    .fc_degree = H5F_CLOSE_WEAK,
    .fapl_size = sizeof(driver_info),
    .open = open_file,
    .close = close_file,
    .query = query,
    .get_eoa = get_allocated,
    .set_eoa = set_allocated,
    .get_eof = get_end,
    .read = read_bytes,
    .write = write_bytes,
    .truncate = truncate_file,
    .fl_map = H5FD_FLMAP_DICHOTOMY};

hid_t hdf5_output_set(hid_t access, hdf5_output *output) {
    const driver_info info = {output};
    const hid_t driver = H5FDregister(&driver_class);
    if (driver >= 0 && H5Pset_driver(access, driver, &info) >= 0) return driver;
    hdf5_output_close(driver);
    return -1;
}

void hdf5_output_close(hid_t driver) {
    if (driver >= 0) H5FDunregister(driver);
}
