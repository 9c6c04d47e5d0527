/* The parts of the man page that follow from the tables: synopsis, verbs, options. */
#include <ctype.h>
#include <string.h>

#include "cli/manual/manual.h"

/* ---- text as roff ------------------------------------------------------------------------------------------------- */

/* One word: options are bold, with dashes that can be copied. */
static void write_word(FILE *stream, const char *word, size_t length) {
    size_t bare = 0; /* without the punctuation at its end */
    if (word[0] == '-' && length > 1)
        for (bare = length; bare && strchr(".,;:)", word[bare - 1]);) bare--;
    if (bare) fputs("\\fB", stream);
    for (size_t i = 0; i < length; i++) {
        if (bare && i == bare) fputs("\\fR", stream);
        if (word[i] == '\\')
            fputs("\\e", stream);
        else if (word[i] == '-' && i < bare)
            fputs("\\-", stream);
        else
            fputc(word[i], stream);
    }
    if (bare == length) fputs("\\fR", stream);
}

/* A paragraph, one sentence a line; its first letter is made a capital, and its end a full stop. */
static void write_text(FILE *stream, const char *text, size_t length) {
    bool start = true;
    for (size_t at = 0; at < length;) {
        const size_t rest = length - at, found = strcspn(text + at, " ");
        const size_t bytes = found < rest ? found : rest;
        if (start) fputs("\\&", stream); /* no dot or quote begins a line */
        if (at == 0 && islower((unsigned char)*text) && bytes > 1) {
            fputc(toupper((unsigned char)*text), stream);
            write_word(stream, text + 1, bytes - 1);
        } else {
            write_word(stream, text + at, bytes);
        }
        at += bytes + 1;
        start = text[at - 2] == '.' && at < length;
        if (at < length) fputc(start ? '\n' : ' ', stream);
    }
    fputs(text[length - 1] == '.' ? "\n" : ".\n", stream);
}

/* ---- synopsis and verbs ------------------------------------------------------------------------------------------- */

static void write_synopsis(FILE *stream, const manual *m) {
    for (size_t v = 0; v < m->verbs; v++)
        fprintf(stream, "%s.B gough %s\n.I %s\n.RI [ option ]...\n", v ? ".br\n" : "",
                verb_at(v)->name, verb_at(v)->arguments);
}

static void write_verbs(FILE *stream, const manual *m) {
    for (size_t v = 0; v < m->verbs; v++) {
        const char *text = verb_at(v)->text, *after = strchr(text, '\v');
        fprintf(stream, ".TP\n.BI \"%s \" %s\n", verb_at(v)->name, verb_at(v)->arguments);
        write_text(stream, text, after ? (size_t)(after - text) : strlen(text));
        if (after) write_text(stream, after + 1, strlen(after + 1));
    }
}

/* ---- options ------------------------------------------------------------------------------------------------------ */

/* "Of forces and simulate" */
static void write_heading(FILE *stream, const manual *m, unsigned verbs) {
    size_t count = 0, named = 0;
    for (size_t v = 0; v < m->verbs; v++) count += verbs >> v & 1;
    fputs(".SS \"Of ", stream);
    for (size_t v = 0; v < m->verbs && count < m->verbs; v++) {
        if (!(verbs >> v & 1)) continue;
        const char *before = named == 0 ? "" : named + 1 == count ? " and " : ", ";
        fprintf(stream, "%s%s", before, verb_at(v)->name);
        named++;
    }
    fprintf(stream, "%s\"\n", named ? "" : "all verbs");
}

static void write_dashes(FILE *stream, const char *name) {
    for (fputs("\\-\\-", stream); *name; name++)
        if (*name == '-')
            fputs("\\-", stream);
        else
            fputc(*name, stream);
}

static void write_option(FILE *stream, const manual_entry *entry) {
    const option *o = entry->option;
    fputs(o->value ? ".TP\n.BI " : ".TP\n.BR ", stream);
    if (o->letter && o->value)
        fprintf(stream, "\\-%c \" %s\\fR, \" ", o->letter, o->value);
    else if (o->letter)
        fprintf(stream, "\\-%c \", \" ", o->letter);
    write_dashes(stream, o->name);
    fprintf(stream, o->value ? "= \"%s\"\n" : "\n", o->value);
    write_text(stream, entry->text, strlen(entry->text));
}

/* All options of the same verbs under one heading; those of all verbs first, where argp's own are. */
static void write_options_of(FILE *stream, const manual *m, bool all) {
    const unsigned every = (1U << m->verbs) - 1;
    for (size_t first = 0; first < m->entries; first++) {
        const unsigned verbs = m->entry[first].verbs;
        bool before = false;
        for (size_t e = 0; e < first; e++) before = before || m->entry[e].verbs == verbs;
        if (before || (verbs == every) != all) continue;
        if (!all) write_heading(stream, m, verbs);
        for (size_t e = first; e < m->entries; e++)
            if (m->entry[e].verbs == verbs) write_option(stream, &m->entry[e]);
    }
}

static void write_common(FILE *stream, const manual *m) { write_options_of(stream, m, true); }
static void write_options(FILE *stream, const manual *m) { write_options_of(stream, m, false); }

const manual_part manual_man[] = {{"synopsis", write_synopsis},
                                  {"verbs", write_verbs},
                                  {"common options", write_common},
                                  {"options", write_options},
                                  {0}};
