/* Rows of the stability map: 400 stiffnesses by 200 amplitudes, on one thread and on two. Once each, by the clock on the wall: it
 * takes longer than all else. */
#include <math.h>
#include <stdlib.h>

#include "bench/bench.h"
#include "gough/map.h"

static void prepare(bench *b, void *memory) {
    (void)b;
    (void)memory;
}

static gough_map_options options_of(const bench *b, int threads) {
    gough_map_options o = gough_map_options_default();

    o.stiffness = (gough_map_range){0, 4, b->quick ? 40 : 400, false};
    o.axis = GOUGH_MAP_AMPLITUDE; /* of heave 0.2 sin t */
    o.second = (gough_map_range){0, 2, b->quick ? 4 : 200, false};
    o.threads = threads;
    return o;
}

static gough_map map_for(const gough_map_options *o) {
    const size_t rows = gough_map_rows(o), points = rows * o->stiffness.count;

    return (gough_map){.point = bench_memory(points * sizeof(gough_map_point)),
                       .row = bench_memory(rows * sizeof(gough_map_row)),
                       .interval = bench_memory(rows * o->intervals * sizeof(gough_interval))};
}

static void drop(gough_map *map, void *memory) {
    free(map->point);
    free(map->row);
    free(map->interval);
    free(memory);
}

static void row(bench *b, int threads, double *first) {
    const gough_map_options o = options_of(b, threads);
    const size_t rows = gough_map_rows(&o);
    gough_map map = map_for(&o);
    size_t bytes, intervals = 0;
    double wall, processor;
    void *memory;

    if (gough_map_size(&b->ref.model, &o, &bytes, NULL) != GOUGH_OK) bench_fail("no map");
    memory = bench_memory(bytes);
    measure_unpin();
    wall = clock_wall(), processor = clock_process();
    if (gough_map_find(&b->ref.model, &o, &map, memory, NULL) != GOUGH_OK) bench_fail("no map");
    wall = clock_wall() - wall, processor = clock_process() - processor;
    (void)measure_pin();

    for (size_t r = 0; r < rows; r++) intervals += map.row[r].intervals;
    if (threads == 1) *first = wall;
    table_begin_row(&b->out, "%zu stiffnesses by %zu amplitudes", o.stiffness.count, rows);
    table_value(&b->out, threads);
    table_value(&b->out, wall);
    table_value(&b->out, processor);
    table_value(&b->out, *first / wall);
    table_value(&b->out, (double)intervals);
    b->figures.map = (double)(rows * o.stiffness.count) / wall;
    drop(&map, memory);
}

static void report(bench *b, void *memory) {
    static const table_column columns[] = {{"threads", AS_PLAIN},
                                           {"s", AS_PLAIN},
                                           {"s of processors", AS_PLAIN},
                                           {"against one", AS_PLAIN},
                                           {"intervals found", AS_PLAIN}};
    double first = NAN;

    (void)memory;
    table_section(&b->out, "A stability map, its tongues found", 5, columns);
    for (int threads = 1; threads <= 2 && threads <= measure_processors(); threads++)
        row(b, threads, &first);
}

const bench_section section_map = {"map", 0, prepare, report};
