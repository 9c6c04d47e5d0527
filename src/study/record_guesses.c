/* What was found in a record without being told, in one line each. */
#include "study/record_guesses.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "gough/text.h"
#include "study/record_text.h"

enum { TEXT = GOUGH_REMARK_TEXT - 40 };

/* A list of parts that is cut where it would be too long. */
typedef struct parts {
    char text[TEXT];
    size_t used;
} parts;

static void add(parts *list, const char *format, ...) __attribute__((format(printf, 2, 3)));

static void add(parts *list, const char *format, ...) {
    va_list values;
    va_start(values, format);
    const size_t room = TEXT - list->used;
    const int wrote = vsnprintf(list->text + list->used, room, format, values);
    va_end(values);
    if ((size_t)wrote >= room)
        list->text[list->used] = '\0';
    else
        list->used += (size_t)wrote;
}

static void say_marks(const study_recording *recording, const study_layout *layout) {
    const study_record_keys *keys = &recording->keys;
    const char separator = layout->separator;
    parts list = {"", 0};
    if (!keys->separator && separator != ',')
        add(&list, "%s between its columns",
            separator == ';'    ? "semicolons"
            : separator == '\t' ? "tabs"
                                : "blanks");
    if (!keys->decimal && layout->decimal == ',')
        add(&list, "%sdecimal commas", list.used ? " and " : "");
    if (layout->units_row) add(&list, "%sa row of units", list.used ? " and " : "");
    if (list.used) study_record_say(recording, false, "motion.samples has %s", list.text);
}

/* A column whose name or unit was understood, though the study does not say it. */
static void add_column(const study_recording *recording, const study_layout *layout,
                       const study_channel *channel, int quantity, parts *list) {
    const study_column_keys *own = &recording->keys.channel[quantity];
    const char *name = layout->named ? layout->name[channel->column] : "";
    const char *known = study_quantity_name(quantity);
    const bool by_name = !own->column && strcmp(name, known) != 0;
    const bool by_unit = !own->unit && *channel->unit;
    char shown[60], unit[40];
    if (!channel->used || (!by_name && !by_unit)) return;
    gough_text_show(name, strlen(name), shown, sizeof shown);
    gough_text_show(channel->unit, strlen(channel->unit), unit, sizeof unit);
    add(list, "%s`%s` as %s", list->used ? ", " : "", shown,
        quantity == STUDY_TIME ? "the time" : known);
    if (*unit) add(list, " in %s", unit);
}

void study_guesses_say(const study_recording *recording, const study_layout *layout,
                       const study_columns *columns) {
    parts list = {"", 0};
    say_marks(recording, layout);
    add_column(recording, layout, &columns->channel[STUDY_TIME], STUDY_TIME, &list);
    for (int q = 0; q < STUDY_QUANTITIES; q++)
        add_column(recording, layout, &columns->channel[q], q, &list);
    if (list.used) study_record_say(recording, false, "motion.samples: read %s", list.text);
}
