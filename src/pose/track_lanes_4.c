/* Paths to all poses, 4 side by side. */
#define NUMBER_LANES 4
#include "pose/track.h"

void path_track_4(const path_system *from, const path_system *to, const path_point *start,
                  int count, path_end *end) {
    path_track(from, to, start, count, end);
}
