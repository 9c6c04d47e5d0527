/* Paths to all poses, one by one. */
#define NUMBER_DOUBLE
#include "pose/track.h"

void path_track_1(const path_system *from, const path_system *to, const path_point *start,
                  int count, path_end *end) {
    path_track(from, to, start, count, end);
}
