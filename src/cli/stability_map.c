/* gough stability --sweep-stiffness: the stability map, its tongues, its data and its picture. */
#include "cli/stability.h"

gough_status stability_map(const command_line *line, const gough_study *study) {
    (void)study;
    complain(line->verb, "there is no map yet");
    return GOUGH_ERROR_INPUT;
}
