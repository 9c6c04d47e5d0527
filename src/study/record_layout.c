/* How a record is written, found from its first lines. A row of names decides, if one is there that names what is looked for; else
 * the first rows that are all numbers. */
#define _POSIX_C_SOURCE 200809L /* strncasecmp */
#include "study/record_layout.h"

#include <string.h>
#include <strings.h>

#include "study/value.h"

enum { MOST_LINES = 200, MOST_BYTES = 1 << 18, NUMBER_BYTES = 64 };

static const char separators[] = {',', ';', '\t', ' '};
enum { SEPARATORS = sizeof separators };

/* The first lines, copied, without those that do not count. */
typedef struct head {
    size_t count;
    gough_piece line[MOST_LINES];
    size_t number[MOST_LINES];
    study_place place[MOST_LINES];
    bool comment[MOST_LINES];
} head;

static size_t length_of(gough_piece p) { return (size_t)(p.end - p.begin); }

static bool is_blank(char c) { return c == ' ' || c == '\t'; }

bool study_layout_leaves_out(const study_layout *layout, gough_piece line) {
    while (line.begin < line.end && is_blank(*line.begin)) line.begin++;
    if (line.begin == line.end) return false;
    if (!layout->comment) return *line.begin == '#' || *line.begin == '%';
    const size_t length = strlen(layout->comment);
    return length > 0 && length_of(line) >= length &&
           memcmp(line.begin, layout->comment, length) == 0;
}

int study_layout_number(const study_layout *layout, gough_piece cell, double *value, char *text) {
    size_t rest;
    char point[NUMBER_BYTES];
    if (length_of(cell) >= 2 && *cell.begin == '"' && cell.end[-1] == '"') cell.begin++, cell.end--;
    const size_t length = length_of(cell);
    if (text) text[0] = '\0';
    if (length >= NUMBER_BYTES) return study_decimal_read(cell.begin, length, value, &rest);
    memcpy(point, cell.begin, length);
    for (size_t i = 0; layout->decimal == ',' && i < length; i++)
        if (point[i] == ',' || point[i] == '.') point[i] = point[i] == ',' ? '.' : ',';
    point[length] = '\0';
    if (text) memcpy(text, point, length + 1);
    return study_decimal_read(point, length, value, &rest);
}

/* ---- names ---- */

gough_piece study_name_bare(gough_piece cell) {
    while (cell.begin < cell.end &&
           (*cell.begin == '#' || *cell.begin == '%' || is_blank(*cell.begin)))
        cell.begin++;
    if (length_of(cell) >= 2 && *cell.begin == '"' && cell.end[-1] == '"') cell.begin++, cell.end--;
    while (cell.begin < cell.end && is_blank(*cell.begin)) cell.begin++;
    while (cell.begin < cell.end && is_blank(cell.end[-1])) cell.end--;
    return cell;
}

static void trim(gough_piece *text) {
    while (text->begin < text->end && is_blank(*text->begin)) text->begin++;
    while (text->begin < text->end &&
           (is_blank(text->end[-1]) || text->end[-1] == '_' || text->end[-1] == ','))
        text->end--;
}

/* Where the bracket opens that the text ends with; NULL if it ends with none. */
static const char *bracket(gough_piece text) {
    if (text.begin == text.end) return NULL;
    const char close = text.end[-1], open = close == ')' ? '(' : close == ']' ? '[' : '\0';
    for (const char *at = text.end - 1; open && at > text.begin; at--)
        if (at[-1] == open) return at - 1;
    return NULL;
}

gough_piece study_name_unit(gough_piece *name) {
    gough_unit unit;
    double size;
    const char *open = bracket(*name);
    if (open) {
        gough_piece found = {open + 1, name->end - 1};
        name->end = open;
        trim(name);
        trim(&found);
        return found;
    }
    for (const char *at = name->end; at > name->begin + 1; at--) {
        if (at[-1] != '_' && at[-1] != ' ') continue;
        if (!gough_unit_named(at, (size_t)(name->end - at), &unit, &size)) break;
        const gough_piece found = {at, name->end};
        name->end = at;
        trim(name);
        return found;
    }
    return (gough_piece){name->end, name->end};
}

bool study_name_is(gough_piece name, const char *known) {
    const size_t length = strlen(known);
    return length_of(name) == length && strncasecmp(name.begin, known, length) == 0;
}

/* ---- lines ---- */

static void take_head(study_lines *lines, const study_record_keys *keys, const study_layout *layout,
                      head *h) {
    size_t bytes = 0;
    while (h->count < MOST_LINES && bytes < MOST_BYTES && study_lines_next(lines)) {
        if (lines->number <= keys->skip) continue;
        gough_piece line = lines->line;
        while (line.begin < line.end && is_blank(*line.begin)) line.begin++;
        if (line.begin == line.end) continue;
        const study_place place = study_lines_place(lines, lines->line.begin);
        const char *text = place.source->text + place.offset;
        if (place.source->length == 0) return; /* out of memory */
        h->line[h->count] = (gough_piece){text, text + length_of(lines->line)};
        h->number[h->count] = lines->number;
        h->place[h->count] = place;
        h->comment[h->count++] = study_layout_leaves_out(layout, lines->line);
        bytes += length_of(lines->line);
    }
}

/* The cells of a line of names: with blanks between them, "(m)" belongs to the name before. */
static size_t split_names(gough_piece line, char separator, gough_piece *cell, size_t most) {
    size_t count = 0;
    gough_piece one;
    const gough_piece bare = study_name_bare(line);
    if (bare.begin > line.begin && *line.begin != '"') line.begin = bare.begin;
    while (gough_csv_cell_by(&line, separator, &one)) {
        /* with blanks between them, no cell but the first is empty */
        const bool unit = separator == ' ' && count > 0 && (*one.begin == '(' || *one.begin == '[');
        if (unit)
            cell[count - 1].end = one.end;
        else if (count < most)
            cell[count++] = one;
        else
            return count + 1;
    }
    return count;
}

static size_t count_cells(gough_piece line, char separator) {
    gough_piece cell;
    size_t count = 0;
    while (gough_csv_cell_by(&line, separator, &cell)) count++;
    return count;
}

/* Cells of a row and how many of them are numbers. */
static size_t count_numbers(const study_layout *layout, gough_piece line, size_t *cells) {
    gough_piece cell;
    size_t numbers = 0;
    double value;
    *cells = 0;
    while (gough_csv_cell_by(&line, layout->separator, &cell)) {
        ++*cells;
        numbers += study_layout_number(layout, cell, &value, NULL) == STUDY_DECIMAL;
    }
    return numbers;
}

/* ---- by names ---- */

static bool is_time(gough_piece name) {
    return study_name_is(name, "t") || study_name_is(name, "time");
}

static bool is_component(gough_piece name) {
    for (int c = 0; c < GOUGH_COMPONENTS; c++)
        if (study_name_is(name, gough_component_name(c))) return true;
    return false;
}

/* Whether a line has the names that the study gives, or without these a time and a component; how many cells do. */
static size_t names_what(const study_record_keys *keys, const gough_piece *cell, size_t count) {
    size_t wanted = 0, found = 0, times = 0, components = 0;
    for (int c = 0; c < STUDY_CHANNELS; c++) {
        const study_column_keys *own = &keys->channel[c];
        if (!own->column || own->number) continue;
        wanted++;
        for (size_t i = 0; i < count; i++) {
            if (!study_name_is(study_name_bare(cell[i]), own->column->text)) continue;
            found++;
            break;
        }
    }
    if (wanted) return found == wanted ? found : 0;
    for (size_t i = 0; i < count; i++) {
        gough_piece name = study_name_bare(cell[i]);
        study_name_unit(&name);
        times += is_time(name);
        components += is_component(name);
    }
    const bool timed = times > 0 || keys->time_step > 0 || keys->channel[STUDY_TIME].number;
    return timed && components > 0 ? times + components : 0;
}

enum { MOST_NAMES = 4096 };

/* The first line that names the wanted columns, and its separator; false if no line does. */
static bool find_names(study_arena *arena, const study_record_keys *keys, const head *h,
                       study_layout *layout, size_t *at) {
    gough_piece *cell = study_arena_take(arena, MOST_NAMES * sizeof *cell);
    for (size_t i = 0; cell && i < h->count; i++) {
        size_t best = 0;
        for (int s = 0; s < SEPARATORS; s++) {
            if (keys->separator && keys->separator != separators[s]) continue;
            const size_t count = split_names(h->line[i], separators[s], cell, MOST_NAMES);
            const size_t found = count <= MOST_NAMES ? names_what(keys, cell, count) : 0;
            if (found <= best) continue;
            best = found;
            layout->separator = separators[s];
            layout->columns = count;
        }
        *at = i;
        if (best) return true;
    }
    return false;
}

/* ---- by numbers ---- */

/* Numbers in the rows from the first one that is all numbers, of this separator and decimal mark; `partly`: half numbers, and two
 * or more. */
static size_t find_numbers(const study_layout *layout, const head *h, bool partly, size_t *at) {
    size_t columns = 0, sum = 0;
    for (size_t i = 0; i < h->count; i++) {
        size_t cells;
        if (h->comment[i]) continue;
        const size_t numbers = count_numbers(layout, h->line[i], &cells);
        const bool row = partly ? numbers >= 2 && 2 * numbers >= cells : numbers == cells;
        if (!columns && row) *at = i, columns = cells;
        if (columns && cells == columns) sum += numbers;
    }
    return sum;
}

/* The separator and the decimal mark with which most of the first lines are numbers. */
static bool find_rows(const study_record_keys *keys, const head *h, bool partly,
                      study_layout *layout, size_t *at) {
    static const char order[] = {'\t', ';', ',', ' '}, decimals[] = {'.', ','};
    study_layout best = *layout;
    size_t most = 0;
    for (int s = 0; s < SEPARATORS; s++)
        for (int d = 0; d < 2; d++) {
            study_layout tried = *layout;
            size_t first = 0;
            tried.separator = order[s];
            tried.decimal = decimals[d];
            if (keys->separator && keys->separator != tried.separator) continue;
            if (keys->decimal && keys->decimal != tried.decimal) continue;
            if (tried.separator == ',' && tried.decimal == ',' && !keys->decimal) continue;
            const size_t sum = find_numbers(&tried, h, partly, &first);
            if (sum <= most) continue;
            most = sum;
            best = tried;
            *at = first;
            best.columns = count_cells(h->line[first], tried.separator);
        }
    if (best.columns == 1) best.separator = ',';
    *layout = best;
    return most > 0;
}

/* ---- the layout ---- */

/* The word of a cell in a row of units, which may stand in brackets; empty for nothing or a dash. */
static gough_piece unit_in(gough_piece cell) {
    gough_piece word = study_name_bare(cell), name = word;
    if (bracket(name) == name.begin) word = study_name_unit(&name);
    if (length_of(word) == 1 && *word.begin == '-') word.end = word.begin;
    return word;
}

/* Whether a line is a row of units: words of units, or nothing. */
static bool has_units(const study_layout *layout, gough_piece line) {
    gough_piece cell;
    size_t known = 0, count = 0;
    gough_unit unit;
    double size;
    while (gough_csv_cell_by(&line, layout->separator, &cell)) {
        const gough_piece word = unit_in(cell);
        count++;
        if (word.begin == word.end) continue;
        if (!gough_unit_named(word.begin, length_of(word), &unit, &size)) return false;
        known++;
    }
    return known > 0 && count == layout->columns;
}

/* A terminated copy, in which a NUL byte stands as another control character. */
static const char *copy_of(study_arena *arena, gough_piece text) {
    char *copy = study_arena_copy(arena, text.begin, length_of(text));
    for (size_t i = 0; copy && i < length_of(text); i++)
        if (copy[i] == '\0') copy[i] = '\1';
    return copy;
}

/* The names of a line and their units; below it a line of units has more to say. */
static void take_names(study_arena *arena, const head *h, size_t at, study_layout *layout) {
    const size_t columns = layout->columns;
    gough_piece *cell = study_arena_take(arena, (columns + 1) * sizeof *cell);
    layout->name = study_arena_take(arena, columns * sizeof *layout->name);
    layout->unit = study_arena_take(arena, columns * sizeof *layout->unit);
    layout->place_of = study_arena_take(arena, columns * sizeof *layout->place_of);
    layout->place = h->place[at];
    if (arena->exhausted) return;
    split_names(h->line[at], layout->separator, cell, columns);
    const bool below = at + 1 < h->count && has_units(layout, h->line[at + 1]);
    gough_piece row = below ? h->line[at + 1] : (gough_piece){NULL, NULL}, own = row;
    for (size_t i = 0; i < columns; i++) {
        gough_piece name = study_name_bare(cell[i]), rest = name;
        gough_piece unit = study_name_unit(&rest);
        if (below) gough_csv_cell_by(&row, layout->separator, &own);
        if (below && unit.begin == unit.end) unit = unit_in(own);
        layout->place_of[i] = cell[i].begin;
        layout->name[i] = copy_of(arena, name);
        layout->unit[i] = copy_of(arena, unit);
    }
    layout->named = true;
    layout->units_row = below;
    layout->first = h->number[at + below] + 1;
}

/* With cells apart by anything but commas, a comma among digits is the decimal mark. */
static char decimal_below(const head *h, size_t at, char separator) {
    bool comma = false;
    for (size_t i = at + 1; i < h->count && separator != ','; i++) {
        if (h->comment[i]) continue;
        if (memchr(h->line[i].begin, '.', length_of(h->line[i]))) return '.';
        comma |= memchr(h->line[i].begin, ',', length_of(h->line[i])) != NULL;
    }
    return comma ? ',' : '.';
}

/* A row of names, or one of names above one of units, before the first row of numbers. */
static void find_names_above(study_arena *arena, const head *h, size_t first,
                             study_layout *layout) {
    gough_piece *cell = study_arena_take(arena, (layout->columns + 1) * sizeof *cell);
    size_t cells;
    layout->place = h->place[first];
    const size_t back = first > 1 && has_units(layout, h->line[first - 1]) ? 2 : 1;
    const gough_piece line = h->line[first - back];
    if (!cell || split_names(line, layout->separator, cell, layout->columns) != layout->columns)
        return;
    /* a single word behind the mark of a comment is a comment */
    if (layout->columns < 2 && h->comment[first - back]) return;
    if (count_numbers(layout, line, &cells) < cells) take_names(arena, h, first - back, layout);
}

bool study_layout_find(study_lines *lines, const study_record_keys *keys, study_layout *layout) {
    study_arena *arena = lines->messages->arena;
    head *h = study_arena_take(arena, sizeof *h);
    size_t at = 0;
    *layout = (study_layout){.decimal = keys->decimal, .comment = keys->comment};
    if (!h) return false;
    take_head(lines, keys, layout, h);
    if (lines->broken || arena->exhausted) return false;
    if (h->count == 0) {
        study_say(lines->messages, GOUGH_ERROR_INPUT, study_lines_last_place(lines),
                  "the first row must name the columns, as in t,heave");
        return false;
    }
    if (find_names(arena, keys, h, layout, &at)) {
        if (!keys->decimal) layout->decimal = decimal_below(h, at, layout->separator);
        take_names(arena, h, at, layout);
        layout->any = at + layout->units_row + 1 < h->count;
    } else if (find_rows(keys, h, false, layout, &at) || find_rows(keys, h, true, layout, &at)) {
        layout->first = h->number[at];
        layout->any = true;
        if (at > 0) find_names_above(arena, h, at, layout);
        layout->place = layout->named ? layout->place : h->place[at];
    } else {
        layout->place = h->place[0];
        layout->separator = ',';
        layout->columns = count_cells(h->line[0], ',');
        layout->decimal = '.';
        take_names(arena, h, 0, layout);
    }
    return !arena->exhausted;
}
