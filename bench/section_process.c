/* Rows of the command: whole processes from start to end, reading and writing included. */
#define _GNU_SOURCE
#include <fcntl.h>
#include <math.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench/bench.h"

enum { COMMANDS = 5, WORDS = 8 };

typedef struct {
    const char *command;
    const char *word[WORDS];
    const char *output; /* of standard output, or NULL */
    int item;
} process;

typedef struct {
    process process[COMMANDS];
    char folder[64], study[96], table[2][96];
} own;

extern char **environ;

static void go(void *context) {
    const process *p = context;
    posix_spawn_file_actions_t actions;
    char *words[WORDS + 2];
    int state = 0, count = 0;
    pid_t child;

    words[count++] = (char *)(size_t)(const void *)p->command;
    for (int i = 0; i < WORDS && p->word[i]; i++) {
        words[count++] = (char *)(size_t)(const void *)p->word[i];
    }
    words[count] = NULL;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 1, p->output ? p->output : "/dev/null",
                                     O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (posix_spawn(&child, p->command, &actions, NULL, words, environ) != 0 ||
        waitpid(child, &state, 0) != child || !WIFEXITED(state) || WEXITSTATUS(state) != 0) {
        bench_fail("the command did not end well");
    }
    posix_spawn_file_actions_destroy(&actions);
}

static void prepare(bench *b, void *memory) {
    own *o = memory;

    if (b->command == NULL) return;
    snprintf(o->folder, sizeof o->folder, "/tmp/gough-bench-XXXXXX");
    if (mkdtemp(o->folder) == NULL) bench_fail("no temporary folder");
    snprintf(o->study, sizeof o->study, "%s/heave.yaml", o->folder);
    snprintf(o->table[0], sizeof o->table[0], "%s/heave.h5", o->folder);
    snprintf(o->table[1], sizeof o->table[1], "%s/heave.csv", o->folder);

    process example = {b->command, {"example", "paper-heave"}, o->study, -1};
    go(&example);
    const process processes[COMMANDS] = {
        {b->command, {"--version"}, NULL, -1},
        {b->command, {"forces", o->study, "-q", "-o", o->table[0]}, NULL, -1},
        {b->command, {"simulate", o->study, "-q", "-o", o->table[0]}, NULL, -1},
        {b->command, {"simulate", o->study, "-q", "-o", o->table[1]}, NULL, -1},
        {b->command,
         {"simulate", o->study, "-q", "--precision", "quad", "-o", o->table[1]},
         NULL,
         -1},
    };
    for (int i = 0; i < COMMANDS; i++) {
        o->process[i] = processes[i];
        o->process[i].item = measure_add(&b->time, go, &o->process[i], 1);
        b->time.item[o->process[i].item].wall = true;
    }
}

static void report(bench *b, void *memory) {
    static const table_column columns[] = {{"ms", AS_PLAIN}, {"quietest", AS_PLAIN}};
    static const char *const name[COMMANDS] = {
        "nothing but starting", "forces of the paper's heave, HDF5",
        "simulate the paper's heave, HDF5", "simulate the paper's heave, CSV",
        "simulate the paper's heave, quadruple, CSV"};
    own *o = memory;

    if (b->command == NULL) return;
    table_section(&b->out, "The command, whole processes", 2, columns);
    for (int i = 0; i < COMMANDS; i++) {
        const timing t = measure_of(&b->time, o->process[i].item);
        table_begin_row(&b->out, "%s", name[i]);
        table_value(&b->out, 1e3 * t.median);
        table_value(&b->out, 1e3 * t.quietest);
    }
    for (int i = 0; i < 2; i++) (void)unlink(o->table[i]);
    (void)unlink(o->study);
    (void)rmdir(o->folder);
}

const bench_section section_process = {"process", sizeof(own), prepare, report};
