/* Feeds every file of the folders named on the command line to a fuzzing target, each followed by its first half: inputs
 * that once found a fault stay in the corpus, and any compiler can replay them. Fails on a folder without files. */
#define _POSIX_C_SOURCE 200809L
#include <dirent.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static int replay_file(const char *path) {
    FILE *file = fopen(path, "rb");
    struct stat status;
    if (!file || fstat(fileno(file), &status) != 0 || !S_ISREG(status.st_mode)) {
        if (file) fclose(file);
        return 0;
    }
    size_t size = (size_t)status.st_size;
    uint8_t *data = malloc(size ? size : 1);
    if (!data || fread(data, 1, size, file) != size) {
        fprintf(stderr, "%s: cannot be read\n", path);
        exit(3);
    }
    fclose(file);
    /* a block of exactly the size, so that a read past the end is seen */
    LLVMFuzzerTestOneInput(data, size);
    uint8_t *half = malloc(size / 2 ? size / 2 : 1);
    if (!half) exit(3);
    memcpy(half, data, size / 2);
    LLVMFuzzerTestOneInput(half, size / 2);
    free(half);
    free(data);
    return 1;
}

int main(int count, char **argument) {
    for (int i = 1; i < count; i++) {
        DIR *folder = opendir(argument[i]);
        int files = 0;
        for (struct dirent *entry; folder && (entry = readdir(folder));) {
            char path[4096];
            snprintf(path, sizeof path, "%s/%s", argument[i], entry->d_name);
            files += replay_file(path);
        }
        if (folder) closedir(folder);
        if (files == 0) {
            fprintf(stderr, "%s: no corpus\n", argument[i]);
            return 1;
        }
        printf("%s: %d inputs\n", argument[i], files);
    }
    return 0;
}
