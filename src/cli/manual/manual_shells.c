/* The parts of the completions that follow from the tables: verbs, options, what completes their values and arguments. */
#include <string.h>

#include "cli/manual/manual.h"

/* The beginning of a text that says what an option does, in one line: up to what explains it further. */
static size_t gist(const char *text) {
    static const char *const end[] = {"; ", " (", ", as in", ": ."};
    size_t length = strlen(text);
    for (size_t i = 0; i < sizeof end / sizeof *end; i++) {
        const char *found = strstr(text, end[i]);
        if (found && (size_t)(found - text) < length) length = (size_t)(found - text);
    }
    return length;
}

/* Text inside quotes of a shell: characters of `marked` get `mark` in front. */
static void write_quoted(FILE *stream, const char *text, size_t length, const char *marked,
                         const char *mark) {
    for (size_t i = 0; i < length; i++) {
        if (strchr(marked, text[i])) fputs(mark, stream);
        fputc(text[i], stream);
    }
}

/* Of the entries of one name only the first; entries differ in their texts. */
static bool is_first(const manual *m, size_t e) {
    for (size_t k = 0; k < e; k++)
        if (strcmp(m->entry[k].option->name, m->entry[e].option->name) == 0) return false;
    return true;
}

static bool completes(const option *o, const char *choices) {
    return o->choices && strcmp(o->choices, choices) == 0;
}

static bool has_words(const option *o) {
    return o->choices && !completes(o, CHOICES_FILES) && !completes(o, CHOICES_FIGURES) &&
           !completes(o, CHOICES_KEYS);
}

/* ---- bash --------------------------------------------------------------------------------------------------------- */

static void write_bash_verbs(FILE *stream, const manual *m) {
    fputs("    local verbs=\"", stream);
    for (size_t v = 0; v < m->verbs; v++) fprintf(stream, "%s%s", v ? " " : "", verb_at(v)->name);
    fputs("\"\n", stream);
}

static void write_bash_options(FILE *stream, const manual *m) {
    for (size_t v = 0; v < m->verbs; v++) {
        fprintf(stream, "        %s) options=\"", verb_at(v)->name);
        const char *between = "";
        for (size_t e = 0; e < m->entries; e++) {
            if (!manual_has(&m->entry[e], v)) continue;
            fprintf(stream, "%s--%s", between, m->entry[e].option->name);
            between = " ";
        }
        fputs("\" ;;\n", stream);
    }
}

static void write_bash_values(FILE *stream, const manual *m) {
    const char *between = "        ";
    for (size_t e = 0; e < m->entries; e++) {
        const option *o = m->entry[e].option;
        if (!has_words(o) || !is_first(m, e)) continue;
        fprintf(stream,
                "        --%s) mapfile -t COMPREPLY < <(compgen -W \"%s\" -- \"$current\"); return "
                ";;\n",
                o->name, o->choices);
    }
    for (size_t e = 0; e < m->entries; e++) {
        const option *o = m->entry[e].option;
        if (!o->value || o->choices || !is_first(m, e)) continue;
        fprintf(stream, "%s--%s", between, o->name);
        between = " | ";
    }
    fputs(") return ;;\n", stream);
}

static void write_bash_endings(FILE *stream, const manual *m) {
    for (size_t v = 0; v < m->verbs; v++) {
        if (!verb_at(v)->endings) continue;
        fprintf(stream, "            %s) endings='@(", verb_at(v)->name);
        manual_join(stream, verb_at(v)->endings, "|");
        fputs(")' ;;\n", stream);
    }
}

const manual_part manual_bash[] = {{"verbs", write_bash_verbs},
                                   {"options", write_bash_options},
                                   {"values", write_bash_values},
                                   {"endings", write_bash_endings},
                                   {0}};

/* ---- zsh ---------------------------------------------------------------------------------------------------------- */

static void write_zsh_verbs(FILE *stream, const manual *m) {
    for (size_t v = 0; v < m->verbs; v++)
        fprintf(stream, "        '%s:%s'\n", verb_at(v)->name, verb_at(v)->sentence);
}

/* '*--set=[override a key]:KEY=VALUE:' inside quotes, where ' is '\'' */
static void write_zsh_option(FILE *stream, const manual_entry *entry) {
    const option *o = entry->option;
    fputs(o->many ? " \\\n                '*" : " \\\n                '", stream);
    if (o->letter)
        fprintf(stream, "'{-%c,--%s%s}'[", o->letter, o->name, o->value ? "=" : "");
    else
        fprintf(stream, "--%s%s[", o->name, o->value ? "=" : "");
    const size_t length = gist(entry->text);
    for (size_t i = 0; i < length; i++)
        if (entry->text[i] == '\'')
            fputs("'\\''", stream);
        else
            write_quoted(stream, entry->text + i, 1, "[]", "\\");
    fputc(']', stream);
    if (o->value) {
        fputc(':', stream);
        write_quoted(stream, o->value, strlen(o->value), ":[]", "\\");
        fputc(':', stream);
    }
    if (has_words(o))
        fprintf(stream, "(%s)", o->choices);
    else if (o->choices)
        fputs(completes(o, CHOICES_FILES)  ? "_files"
              : completes(o, CHOICES_KEYS) ? "_gough_settings"
                                           : "_gough_figures",
              stream);
    fputc('\'', stream);
}

static void write_zsh_options(FILE *stream, const manual *m) {
    const unsigned every = (1U << m->verbs) - 1;
    for (size_t v = 0; v < m->verbs; v++) {
        fprintf(stream, "        %s)\n            _arguments $always", verb_at(v)->name);
        for (size_t e = 0; e < m->entries; e++)
            if (manual_has(&m->entry[e], v) && m->entry[e].verbs != every)
                write_zsh_option(stream, &m->entry[e]);
        fprintf(stream, " \\\n                '%s:", verb_at(v)->most_files > 1 ? "*" : "1");
        if (verb_at(v)->endings) {
            fputs("file:_files -g \"*.(", stream);
            manual_join(stream, verb_at(v)->endings, "|");
            fputs(")\"'\n            ;;\n", stream);
        } else {
            fprintf(stream, "%s:_gough_%ss'\n            ;;\n", verb_at(v)->words,
                    verb_at(v)->words);
        }
    }
}

const manual_part manual_zsh[] = {{"verbs", write_zsh_verbs}, {"options", write_zsh_options}, {0}};

/* ---- fish --------------------------------------------------------------------------------------------------------- */

static void write_fish_verbs(FILE *stream, const manual *m) {
    fputs("set -l verbs", stream);
    for (size_t v = 0; v < m->verbs; v++) fprintf(stream, " %s", verb_at(v)->name);
    fputc('\n', stream);
    for (size_t v = 0; v < m->verbs; v++)
        fprintf(stream,
                "complete -c gough -n \"not __fish_seen_subcommand_from $verbs\" -a %s -d \"%s\"\n",
                verb_at(v)->name, verb_at(v)->sentence);
}

static void write_fish_options(FILE *stream, const manual *m) {
    for (size_t e = 0; e < m->entries; e++) {
        const option *o = m->entry[e].option;
        fputs("complete -c gough -n \"__fish_seen_subcommand_from", stream);
        for (size_t v = 0; v < m->verbs; v++)
            if (manual_has(&m->entry[e], v)) fprintf(stream, " %s", verb_at(v)->name);
        fputs("\" ", stream);
        if (o->letter) fprintf(stream, "-s %c ", o->letter);
        fprintf(stream, "-l %s ", o->name);
        if (completes(o, CHOICES_FILES))
            fputs("-r -F ", stream);
        else if (has_words(o))
            fprintf(stream, "-x -a \"%s\" ", o->choices);
        else if (completes(o, CHOICES_FIGURES))
            fputs("-x -a \"(__gough_figures)\" ", stream);
        else if (completes(o, CHOICES_KEYS))
            fputs("-x -a \"(__gough_settings)\" ", stream);
        else if (o->value)
            fputs("-x ", stream);
        fputs("-d \"", stream);
        write_quoted(stream, m->entry[e].text, gist(m->entry[e].text), "\"$\\", "\\");
        fputs("\"\n", stream);
    }
}

static void write_fish_endings(FILE *stream, const manual *m) {
    for (size_t v = 0; v < m->verbs; v++) {
        if (!verb_at(v)->endings) {
            fprintf(stream,
                    "complete -c gough -n \"__fish_seen_subcommand_from %s\" -a "
                    "\"(__gough_%ss)\"\n",
                    verb_at(v)->name, verb_at(v)->words);
            continue;
        }
        fprintf(stream,
                "complete -c gough -n \"__fish_seen_subcommand_from %s\" -a "
                "\"(__fish_complete_suffix .%.*s)\"\n",
                verb_at(v)->name, (int)strcspn(verb_at(v)->endings, " "), verb_at(v)->endings);
    }
}

const manual_part manual_fish[] = {{"verbs", write_fish_verbs},
                                   {"options", write_fish_options},
                                   {"endings", write_fish_endings},
                                   {0}};
