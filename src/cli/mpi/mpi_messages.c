/* Sending, waiting and packing for gough-mpi. Processes that wait sleep between two looks: where there are more processes than
 * processors, those that compute need them. */
#define _GNU_SOURCE
#include "cli/mpi/mpi_messages.h"

#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

double mpi_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

void mpi_rest(void) {
    static const struct timespec moment = {0, 200000};
    nanosleep(&moment, NULL);
}

int mpi_await(int rank, int *sender, size_t *length) {
    MPI_Status about;
    int there = 0, bytes = 0;
    const int source = rank < 0 ? MPI_ANY_SOURCE : rank;
    while (MPI_Iprobe(source, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &about), !there) mpi_rest();
    MPI_Get_count(&about, MPI_BYTE, &bytes);
    *sender = about.MPI_SOURCE;
    *length = (size_t)bytes;
    return about.MPI_TAG;
}

bool mpi_waits(int rank, int tag) {
    int there = 0;
    MPI_Iprobe(rank < 0 ? MPI_ANY_SOURCE : rank, tag < 0 ? MPI_ANY_TAG : tag, MPI_COMM_WORLD,
               &there, MPI_STATUS_IGNORE);
    return there != 0;
}

void mpi_send(int rank, int tag, const void *bytes, size_t length) {
    MPI_Send(bytes, (int)length, MPI_BYTE, rank, tag, MPI_COMM_WORLD);
}

void mpi_receive(int rank, int tag, void *bytes, size_t length) {
    MPI_Recv(bytes, (int)length, MPI_BYTE, rank, tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
}

/* mpirun may bind a process to some processors; those that are not bound share the machine's. */
int mpi_threads(void) {
    MPI_Comm beside;
    int processes = 1;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &beside);
    MPI_Comm_size(beside, &processes);
    MPI_Comm_free(&beside);
    const long share = sysconf(_SC_NPROCESSORS_ONLN) / processes;
    const int allowed = gough_batch_threads(0);
    return share < 1 ? 1 : share < allowed ? (int)share : allowed;
}

/* ---- a job ------------------------------------------------------------------------------------------------------- */

static void put_text(FILE *stream, const char *text) {
    const uint64_t length = strlen(text);
    fwrite(&length, sizeof length, 1, stream);
    fwrite(text, 1, length + 1, stream);
}

void *mpi_job_pack(const gough_sweep *sweep, const gough_sweep_options *options, size_t *length) {
    const gough_study *study = gough_sweep_study(sweep);
    size_t count;
    const gough_setting *setting = gough_sweep_settings(sweep, &count);
    const uint64_t settings = count;
    char *bytes = NULL;
    FILE *stream = open_memstream(&bytes, length);
    if (stream == NULL) return NULL;
    fwrite(options, sizeof *options, 1, stream);
    put_text(stream, study->name);
    put_text(stream, study->text);
    fwrite(&settings, sizeof settings, 1, stream);
    for (size_t i = 0; i < count; i++) {
        put_text(stream, setting[i].key);
        put_text(stream, setting[i].value);
    }
    if (fclose(stream) == 0) return bytes;
    free(bytes);
    return NULL;
}

static const char *get_text(const char **at, size_t *length) {
    uint64_t size;
    memcpy(&size, *at, sizeof size);
    const char *text = *at + sizeof size;
    *length = size;
    *at = text + size + 1;
    return text;
}

gough_status mpi_job_take(const void *bytes, size_t length, gough_sweep **sweep,
                          gough_sweep_options *options, gough_error *error) {
    const char *at = bytes;
    size_t size, text_length;
    uint64_t settings;
    (void)length;
    memcpy(options, at, sizeof *options);
    at += sizeof *options;
    const char *name = get_text(&at, &size), *text = get_text(&at, &text_length);
    memcpy(&settings, at, sizeof settings);
    at += sizeof settings;
    gough_setting *setting = calloc(settings + 1, sizeof *setting);
    if (setting == NULL) return gough_fail(error, GOUGH_ERROR_FILE, "out of memory");
    for (size_t i = 0; i < settings; i++) {
        setting[i].key = get_text(&at, &size);
        setting[i].value = get_text(&at, &size);
    }
    char *messages = NULL;
    const gough_status status =
        gough_sweep_parse(name, text, text_length, setting, settings, sweep, &messages);
    if (status != GOUGH_OK)
        gough_fail(error, status, "%.*s", messages ? (int)strcspn(messages, "\n") : 13,
                   messages ? messages : "out of memory");
    free(messages);
    free(setting);
    return status;
}
