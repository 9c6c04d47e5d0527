/* A user's program of the second library: reads a study and prints its title. */
#include <gough/gough.h>
#include <stdio.h>

int main(int count, char **argument) {
    gough_study *study = NULL;
    char *messages = NULL;
    if (count < 2 || gough_study_read(argument[1], NULL, 0, &study, &messages) != GOUGH_OK) {
        fprintf(stderr, "%s\n", messages ? messages : "no study");
        return 1;
    }
    puts(study->title);
    gough_study_free(study);
    return 0;
}
