/* gough_manual SHELL TEMPLATE OUTPUT: fills the template of the man page ("man") or of a shell's completion ("bash", "zsh",
 * "fish") from the tables of verbs and options. */
#include "cli/manual/manual.h"

#include <stdlib.h>
#include <string.h>

bool manual_has(const manual_entry *entry, size_t verb) { return entry->verbs >> verb & 1; }

void manual_join(FILE *stream, const char *words, const char *between) {
    for (; *words; words++)
        if (*words == ' ')
            fputs(between, stream);
        else
            fputc(*words, stream);
}

static void add(manual *m, const option *o, const char *text, size_t verb) {
    manual_entry *entry = m->entry;
    const manual_entry *const end = m->entry + m->entries;
    while (entry < end &&
           (strcmp(entry->option->name, o->name) != 0 || strcmp(entry->text, text) != 0))
        entry++;
    if (entry == end) {
        if (m->entries == MOST_ENTRIES) abort();
        *entry = (manual_entry){.option = o, .text = text};
        m->entries++;
    }
    entry->verbs |= 1U << verb;
}

static manual collect(void) {
    manual m = {.verbs = 0};
    for (; verb_at(m.verbs); m.verbs++) {
        const group_use *use;
        const option *o;
        for (size_t n = 0; (o = verb_option(verb_at(m.verbs), n, &use)); n++)
            add(&m, o, option_text(o, use), m.verbs);
    }
    return m;
}

static const manual_part *find_parts(const char *name) {
    static const struct {
        const char *name;
        const manual_part *part;
    } kinds[] = {
        {"man", manual_man}, {"bash", manual_bash}, {"zsh", manual_zsh}, {"fish", manual_fish}};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        if (strcmp(name, kinds[i].name) == 0) return kinds[i].part;
    return NULL;
}

/* The part that a line names; NULL where the line is text. */
static const manual_part *part_of(const manual_part *part, const char *line) {
    for (; part->name; part++) {
        const size_t length = strlen(part->name);
        if (line[0] == '@' && strncmp(line + 1, part->name, length) == 0 &&
            strcmp(line + 1 + length, "@\n") == 0)
            return part;
    }
    return NULL;
}

int main(int count, char **argument) {
    const manual m = collect();
    const manual_part *parts = count == 4 ? find_parts(argument[1]) : NULL;
    FILE *in = parts ? fopen(argument[2], "r") : NULL, *out = in ? fopen(argument[3], "w") : NULL;
    char line[1000];
    if (!out) {
        fprintf(stderr, "usage: gough_manual man|bash|zsh|fish TEMPLATE OUTPUT\n");
        return EXIT_FAILURE;
    }
    while (fgets(line, sizeof line, in)) {
        const manual_part *part = part_of(parts, line);
        if (part)
            part->write(out, &m);
        else
            fputs(line, out);
    }
    const bool failed = ferror(in) || ferror(out);
    fclose(in);
    return fclose(out) != 0 || failed ? EXIT_FAILURE : EXIT_SUCCESS;
}
