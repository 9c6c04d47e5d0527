/* A private temporary folder that does not outlive the process that opened it, however that ends. */
#ifndef GOUGH_FIGURE_PRIVATE_FOLDER_H
#define GOUGH_FIGURE_PRIVATE_FOLDER_H

#include <sys/types.h>

#include "gough/status.h"

typedef struct workshop {
    char folder[200];
    pid_t keeper; /* a child process that removes the folder */
    int line;     /* to the keeper, which acts when it is closed */
} workshop;

gough_status workshop_open(workshop *shop, gough_error *error);
/* Removes the folder and all files in it. */
void workshop_close(workshop *shop);

#endif
