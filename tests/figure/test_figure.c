/* Figures: every kind is drawn whole, text runs nothing, and what cannot be drawn says why.
 * Label: standard.
 * Sanitized: campaign: most of its time is gnuplot's, and figure/stability and figure/sweep draw under sanitizers. */
#define _XOPEN_SOURCE 700
#include <fcntl.h>
#include <sys/stat.h>

#include "gough/report.h"
#include "support/suite.h"
#include "table/by_hand.h"

/* ---- tables by hand -------------------------------------------------------------------------------------------- */

static gough_table *new_table(size_t rows, size_t columns) {
    gough_table *table = calloc(1, sizeof *table);
    *table = (gough_table){.rows = rows, .columns = columns, .end_time = NAN};
    table->title = strdup("A title");
    table->verb = strdup("");
    table->end_cause = strdup("");
    table->name = calloc(columns, sizeof *table->name);
    table->unit = calloc(columns, sizeof *table->unit);
    table->value = calloc(columns, sizeof *table->value);
    for (size_t c = 0; c < columns; c++) {
        table->unit[c] = strdup("");
        table->value[c] = calloc(rows > 0 ? rows : 1, sizeof(double));
    }
    return table;
}

static void set_title(gough_table *table, const char *title) {
    free(table->title);
    table->title = strdup(title);
}

/* All columns of a simulation; legs move apart by `spread`, the six pose components all move. */
static gough_table *run_table(size_t rows, double spread) {
    gough_table *table = new_table(rows, GOUGH_RXX);
    for (int c = 0; c < GOUGH_RXX; c++) {
        table->name[c] = strdup(gough_column(c)->name);
        for (size_t r = 0; r < rows; r++) {
            const double t = 20.0 * (double)r / (double)(rows > 1 ? rows - 1 : 1);
            const int leg = c >= GOUGH_L && c < GOUGH_CONDITION ? (c - GOUGH_L) % GOUGH_LEGS : c;
            table->value[c][r] = c == GOUGH_T ? t
                                              : 1.0 + (leg == c ? 1.0 : 0.3) *
                                                          sin(t + (leg == c ? c : leg * spread));
        }
    }
    return table;
}

static gough_table *gain_table(void) {
    static const char *const names[] = {"G", "position_deviation", "ended"};
    gough_table *table = new_table(5, 3);
    for (int c = 0; c < 3; c++) table->name[c] = strdup(names[c]);
    for (size_t r = 0; r < 5; r++) {
        table->value[0][r] = pow(10.0, (double)r - 2.0);
        table->value[1][r] = pow(10.0, -1.0 - (double)r);
        table->value[2][r] = r == 0 ? 1.0 : 0.0;
    }
    return table;
}

/* ---- drawing --------------------------------------------------------------------------------------------------- */

static gough_status draw(const gough_figure *figure, const gough_table *table, const char *path,
                         gough_error *error) {
    *error = (gough_error){.message = ""};
    return gough_figure_draw(figure, &table, NULL, 1, path, error);
}

static void expect_drawn(const gough_figure *figure, const gough_table *table, const char *path) {
    gough_error error;
    ck_assert_msg(draw(figure, table, path, &error) == GOUGH_OK, "%s", error.message);
}

/* The SVG of a figure as text. */
static char *svg_of(const gough_figure *figure, const gough_table *const *tables,
                    const char *const *labels, size_t count) {
    char folder[PATH_SIZE], path[PATH_SIZE];
    make_folder(folder);
    path_in(folder, "a.svg", path);
    gough_error error = {.message = ""};
    ck_assert_msg(gough_figure_draw(figure, tables, labels, count, path, &error) == GOUGH_OK, "%s",
                  error.message);
    size_t length;
    char *text = read_bytes(path, &length);
    ck_assert(strstr(text, "</svg>") != NULL);
    remove_folder(folder);
    return text;
}

static unsigned big_endian(const char *bytes) {
    const unsigned char *at = (const unsigned char *)bytes;
    return (unsigned)at[0] << 24 | (unsigned)at[1] << 16 | (unsigned)at[2] << 8 | at[3];
}

/* A PNG from signature to end, of at least this width, with more in it than an empty sheet compresses to. */
static void expect_png(const char *path, unsigned width) {
    size_t length;
    char *bytes = read_bytes(path, &length);
    ck_assert_uint_gt(length, 15000);
    ck_assert(memcmp(bytes, "\x89PNG\r\n\x1a\n", 8) == 0);
    ck_assert_uint_eq(big_endian(bytes + 16), width);
    ck_assert_uint_gt(big_endian(bytes + 20), 600);
    ck_assert(memcmp(bytes + length - 8, "IEND", 4) == 0);
    free(bytes);
}

START_TEST(every_kind_is_drawn) {
    char folder[PATH_SIZE], path[PATH_SIZE];
    make_folder(folder);
    path_in(folder, "a.png", path);
    gough_table *run = run_table(401, 1.0), *gain = gain_table();
    int kinds = 0;
    for (const char *const *kind = gough_figure_kinds(); *kind != NULL; kind++, kinds++) {
        char name[40];
        snprintf(name, sizeof name, "%.*s", (int)strcspn(*kind, " "), *kind);
        gough_figure figure = gough_figure_default();
        figure.kind = name;
        figure.columns = strcmp(name, "columns") == 0 ? "z, f1,f2,condition" : NULL;
        if (strcmp(name, "sweep") == 0) continue;  /* test_sweep.c */
        if (strcmp(name, "tuning") == 0) continue; /* tests/cli/test_tune.sh */
        expect_drawn(&figure, strcmp(name, "gain") == 0 ? gain : run, path);
        const bool wide = strcmp(name, "overview") == 0 || strcmp(name, "motion") == 0;
        expect_png(path, wide ? 2080 : 1560);
    }
    ck_assert_int_ge(kinds, 11);
    gough_table_free(run);
    gough_table_free(gain);
    remove_folder(folder);
}
END_TEST

START_TEST(the_kind_is_chosen_by_the_table) {
    gough_table *run = run_table(50, 1.0), *gain = gain_table();
    const gough_figure figure = gough_figure_default();
    const gough_table *table = run;
    char *text = svg_of(&figure, &table, NULL, 1);
    ck_assert(strstr(text, "Leg length") != NULL && strstr(text, "Leg force") != NULL);
    free(text);
    table = gain;
    text = svg_of(&figure, &table, NULL, 1);
    ck_assert(strstr(text, "stiffness") != NULL && strstr(text, "ended early") != NULL);
    free(text);
    gough_table_free(run);
    gough_table_free(gain);
}
END_TEST

START_TEST(every_format_is_complete_and_the_same_each_time) {
    char folder[PATH_SIZE], one[PATH_SIZE], two[PATH_SIZE];
    static const char *const names[][2] = {
        {"a.png", "b.png"}, {"a.svg", "b.svg"}, {"a.pdf", "b.pdf"}};
    static const char *const begins[] = {"\x89PNG", "<?xml", "%PDF-"};
    make_folder(folder);
    gough_table *run = run_table(401, 1.0);
    const gough_figure figure = gough_figure_default();
    for (int i = 0; i < 3; i++) expect_drawn(&figure, run, path_in(folder, names[i][0], one));
    sleep(1); /* a date in the file would differ */
    for (int i = 0; i < 3; i++) {
        expect_drawn(&figure, run, path_in(folder, names[i][1], two));
        path_in(folder, names[i][0], one);
        size_t length, other_length;
        char *bytes = read_bytes(one, &length), *other = read_bytes(two, &other_length);
        ck_assert_int_eq(strncmp(bytes, begins[i], strlen(begins[i])), 0);
        ck_assert_uint_eq(length, other_length);
        ck_assert_msg(memcmp(bytes, other, length) == 0, "%s differs", names[i][0]);
        free(bytes);
        free(other);
    }
    gough_table_free(run);
    remove_folder(folder);
}
END_TEST

START_TEST(a_comma_locale_changes_no_byte) {
    char folder[PATH_SIZE];
    make_folder(folder);
    gough_table *run = run_table(101, 0.5);
    const gough_table *table = run;
    const gough_figure figure = gough_figure_default();
    char *before = svg_of(&figure, &table, NULL, 1);
    enter_comma_locale(folder);
    char *within = svg_of(&figure, &table, NULL, 1);
    leave_comma_locale();
    ck_assert_str_eq(before, within);
    free(before);
    free(within);
    gough_table_free(run);
    remove_folder(folder);
}
END_TEST

START_TEST(legs_that_coincide_are_one_line) {
    gough_figure figure = gough_figure_default();
    figure.kind = "forces";
    gough_table *equal = run_table(101, 0.0);
    const gough_table *table = equal;
    char *text = svg_of(&figure, &table, NULL, 1);
    ck_assert(strstr(text, "legs 1–6 (equal)") != NULL);
    free(text);

    /* one leg of six differs by more than round-off */
    equal->value[GOUGH_F + 3][50] *= 1.0 + 1e-6;
    text = svg_of(&figure, &table, NULL, 1);
    ck_assert(strstr(text, "equal") == NULL);
    ck_assert(strstr(text, "1, 2, 3, 5, 6") != NULL);
    free(text);
    gough_table_free(equal);
}
END_TEST

START_TEST(tables_are_compared_by_their_labels) {
    gough_table *one = run_table(101, 0.2), *two = run_table(201, 0.2);
    const gough_table *tables[] = {one, two};
    const char *labels[] = {"stiff & soft", "open loop"};
    const gough_figure figure = gough_figure_default();
    char *text = svg_of(&figure, tables, labels, 2);
    ck_assert(strstr(text, "stiff &amp; soft") != NULL && strstr(text, "open loop") != NULL);
    free(text);
    gough_table_free(one);
    gough_table_free(two);
}
END_TEST

START_TEST(fonts_of_an_svg_have_substitutes) {
    gough_table *run = run_table(20, 0.2);
    const gough_table *table = run;
    const gough_figure figure = gough_figure_default();
    char *text = svg_of(&figure, &table, NULL, 1);
    const char *plain = "font-family=\"DejaVu Sans, Verdana, sans-serif\"";
    int plain_count = 0, all_count = 0;
    for (const char *at = text; (at = strstr(at, "font-family=")) != NULL; at++) {
        all_count++;
        plain_count += strncmp(at, plain, strlen(plain)) == 0;
    }
    ck_assert_int_gt(all_count, 10);
    ck_assert_int_eq(plain_count, all_count);
    ck_assert(strstr(text, "font-weight=\"bold\"") != NULL);
    free(text);
    gough_table_free(run);
}
END_TEST

START_TEST(an_early_end_is_told) {
    gough_table *run = run_table(101, 0.2);
    free(run->end_cause);
    run->end_cause = strdup("singular");
    run->end_time = 17.15;
    const gough_table *table = run;
    const gough_figure figure = gough_figure_default();
    char *text = svg_of(&figure, &table, NULL, 1);
    ck_assert(strstr(text, "ended at t = 17.15: singular pose") != NULL);
    free(text);
    gough_table_free(run);
}
END_TEST

START_TEST(a_long_note_takes_several_lines) {
    static const char message[] =
        "legs 1, 2, 3, 4 and 5 get shorter than their least length 1.17851667 m from t = 7.0605083 "
        "to 8.12345678 s; limits are exceeded 1234 times";
    gough_table *run = run_table(101, 0.2);
    free(run->end_cause);
    free(run->end_message);
    run->end_cause = strdup("leg_short");
    run->end_message = strdup(message);
    run->end_time = 7.06;
    const gough_table *table = run;
    gough_figure figure = gough_figure_default();
    figure.kind = "forces";
    char *text = svg_of(&figure, &table, NULL, 1), word[40];
    for (const char *at = message; *at != '\0'; at += strspn(at, " ")) {
        snprintf(word, sizeof word, "%.*s", (int)strcspn(at, " "), at);
        ck_assert_msg(strstr(text, word) != NULL, "'%s' is cut off", word);
        at += strcspn(at, " ");
    }
    ck_assert(strstr(text, "…") == NULL);
    free(text);
    gough_table_free(run);
}
END_TEST

/* The curve of a run without errors to correct, far below the accuracy. */
START_TEST(tuning_says_what_it_leaves_out_and_how_it_was_checked) {
    static const char *const name[] = {"feedforward", "G",      "position_deviation",
                                       "asked",       "named",  "force",
                                       "ended",       "stable", "judged"};
    enum { ROWS = 4, COLUMNS = sizeof name / sizeof name[0] };
    gough_table *curve = gough_table_new("Curve", "tune", COLUMNS, ROWS);
    for (size_t c = 0; c < COLUMNS; c++) {
        double *value = gough_table_name(curve, c, name[c], c == 1 ? "N/m" : c == 2 ? "m" : "1");
        for (size_t r = 0; r < ROWS; r++)
            value[r] = c == 1   ? 100.0 * (double)(r + 1)
                       : c == 2 ? 3e-11 / (double)(r + 1)
                       : c == 3 ? 1e-4
                       : c == 4 ? r == ROWS - 1
                       : c == 8 ? (r == 0 ? 2 : r == ROWS - 1)
                                : c != 6;
    }
    const gough_table *table = curve;
    gough_figure figure = gough_figure_default();
    figure.kind = "tuning";
    char *text = svg_of(&figure, &table, NULL, 1);
    ck_assert(strstr(text, "deviations below 1e-08 m are not drawn; the least is") != NULL);
    ck_assert(strstr(text, "accuracy asked for") != NULL);
    ck_assert(strstr(text, "chosen G = 400 N/m") != NULL);
    free(text);

    double *deviation = curve->value[2]; /* no lower than four decades below it: all are drawn */
    for (size_t r = 0; r < ROWS; r++) deviation[r] = 2e-8 * (double)(r + 1);
    text = svg_of(&figure, &table, NULL, 1);
    ck_assert(strstr(text, "not drawn") == NULL);
    ck_assert(strstr(text, "stability checked: 1 point along the program, 2 points by whether "
                           "their runs reached their end") != NULL);
    free(text);
    gough_table_free(curve);
}
END_TEST

START_TEST(long_tables_stay_small_files) {
    char folder[PATH_SIZE], path[PATH_SIZE];
    make_folder(folder);
    gough_table *run = run_table(60001, 1.0);
    const gough_figure figure = gough_figure_default();
    struct stat about;
    expect_drawn(&figure, run, path_in(folder, "a.svg", path));
    ck_assert_int_eq(stat(path, &about), 0);
    ck_assert_int_lt(about.st_size, 1000000);
    expect_drawn(&figure, run, path_in(folder, "a.pdf", path));
    ck_assert_int_eq(stat(path, &about), 0);
    ck_assert_int_lt(about.st_size, 500000);
    gough_table_free(run);
    remove_folder(folder);
}
END_TEST

/* ---- text runs nothing ----------------------------------------------------------------------------------------- */

/* Every way that gnuplot or a shell has to run something, each asking for the file `touched`. */
static const char *const attacks[] = {
    "`touch %s`",
    "$(touch %s)",
    "\"`touch %s`\"",
    "'`touch %s`'",
    "' ; system('touch %s') ; '",
    "'.system('touch %s').'",
    "\"; system \"touch %s\"",
    "x\n!touch %s\n",
    "x\nsystem \"touch %s\"\n",
    "x'\n!touch %s\n#'",
    "\\'; !touch %s",
    "@system('touch %s')",
    "| touch %s",
    "{/:Bold `touch %s`}",
    "%%d `touch %s`",
};

START_TEST(study_text_runs_nothing) {
    char folder[PATH_SIZE], full[1024], touched[1100];
    make_folder(folder);
    ck_assert(realpath(folder, full) != NULL);
    snprintf(touched, sizeof touched, "%s/touched", full);
    const gough_figure figure = gough_figure_default();
    for (size_t i = 0; i < sizeof attacks / sizeof attacks[0]; i++) {
        char text[1300];
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
        snprintf(text, sizeof text, attacks[i], touched);
#pragma GCC diagnostic pop
        gough_table *one = run_table(20, 0.3), *two = run_table(20, 0.3);
        set_title(one, text);
        set_title(two, text);
        free(one->end_cause);
        one->end_cause = strdup(text);
        one->end_time = 3.0;
        const gough_table *tables[] = {one, two};
        const char *labels[] = {text, text};
        char *alone = svg_of(&figure, tables, NULL, 1);
        /* the text did reach the figure */
        ck_assert_msg(strstr(alone, "touch") != NULL, "%s", text);
        free(alone);
        char *compared = svg_of(&figure, tables, labels, 2);
        ck_assert(strstr(compared, "touch") != NULL);
        free(compared);

        /* names and units of columns come from files too */
        gough_figure columns = gough_figure_default();
        columns.columns = "z";
        free(one->name[GOUGH_T]);
        one->name[GOUGH_T] = strdup(text);
        free(one->unit[GOUGH_Z]);
        one->unit[GOUGH_Z] = strdup(text);
        free(svg_of(&columns, tables, NULL, 1));
        ck_assert_msg(access(touched, F_OK) != 0, "%s ran", text);
        gough_table_free(one);
        gough_table_free(two);
    }
    remove_folder(folder);
}
END_TEST

START_TEST(columns_of_other_hands_are_drawn_by_their_names) {
    gough_table *table = run_table(50, 0.1);
    gough_figure figure = gough_figure_default();
    const gough_table *const tables[] = {table};

    free(table->name[GOUGH_Z]);
    table->name[GOUGH_Z] = strdup("leg 1 (kN)");
    figure.columns = " leg 1 (kN) , x,";
    char *svg = svg_of(&figure, tables, NULL, 1);
    ck_assert_msg(strstr(svg, "leg 1 (kN)") != NULL, "%s", svg);
    free(svg);
    gough_table_free(table);
}
END_TEST

/* ---- what cannot be drawn -------------------------------------------------------------------------------------- */

static void expect_refused(const gough_figure *figure, const gough_table *table, const char *path,
                           gough_status status, const char *message) {
    gough_error error;
    ck_assert_int_eq(draw(figure, table, path, &error), status);
    ck_assert_msg(strstr(error.message, message) != NULL, "found: %s\nnot: %s", error.message,
                  message);
}

START_TEST(wrong_wishes_are_answered_with_what_would_be_right) {
    gough_table *run = run_table(20, 1.0), *gain = gain_table(), *empty = run_table(0, 0.0);
    gough_figure figure = gough_figure_default();
    expect_refused(&figure, run, "a.gif", GOUGH_ERROR_INPUT, ".png, .svg or .pdf");
    expect_refused(&figure, empty, "a.png", GOUGH_ERROR_INPUT, "no rows");
    figure.kind = "force";
    expect_refused(&figure, run, "a.png", GOUGH_ERROR_INPUT, "did you mean forces");
    figure.kind = "columns";
    expect_refused(&figure, run, "a.png", GOUGH_ERROR_INPUT, "give the columns");
    figure.columns = "z,conditon";
    expect_refused(&figure, run, "a.png", GOUGH_ERROR_INPUT, "did you mean condition?");
    figure.kind = "motion";
    expect_refused(&figure, gain, "a.png", GOUGH_ERROR_INPUT, "no column x");
    figure = gough_figure_default();
    figure.from = 100.0;
    expect_refused(&figure, run, "a.png", GOUGH_ERROR_INPUT, "in this range");
    ck_assert(access("a.png", F_OK) != 0);
    gough_table_free(run);
    gough_table_free(gain);
    gough_table_free(empty);
}
END_TEST

START_TEST(files_that_cannot_be_written_are_named) {
    char folder[PATH_SIZE], path[PATH_SIZE];
    make_folder(folder);
    gough_table *run = run_table(20, 1.0);
    const gough_figure figure = gough_figure_default();
    expect_refused(&figure, run, "no/such/folder/a.png", GOUGH_ERROR_FILE, "no/such/folder");
    ck_assert_int_eq(symlink("/dev/full", path_in(folder, "full.svg", path)), 0);
    expect_refused(&figure, run, path, GOUGH_ERROR_FILE, "No space left");
    gough_table_free(run);
    remove_folder(folder);
}
END_TEST

/* Puts a program called gnuplot before the real one. */
static void fake_gnuplot(const char *folder, const char *script) {
    char path[PATH_SIZE], full[1024];
    write_bytes(path_in(folder, "gnuplot", path), script, strlen(script));
    ck_assert_int_eq(chmod(path, 0700), 0);
    ck_assert(realpath(folder, full) != NULL);
    setenv("PATH", full, 1);
}

START_TEST(a_missing_or_failing_gnuplot_is_told) {
    char folder[PATH_SIZE], *search = strdup(getenv("PATH"));
    make_folder(folder);
    gough_table *run = run_table(20, 1.0);
    const gough_figure figure = gough_figure_default();
    setenv("PATH", "no-such-folder", 1);
    expect_refused(&figure, run, "a.png", GOUGH_ERROR_FILE, "gnuplot-nox");
    fake_gnuplot(folder, "#!/bin/sh\necho 'this is what is wrong' >&2\nexit 1\n");
    expect_refused(&figure, run, "a.png", GOUGH_ERROR_FILE, "this is what is wrong");
    fake_gnuplot(folder, "#!/bin/sh\nexit 0\n");
    expect_refused(&figure, run, "a.png", GOUGH_ERROR_FILE, "wrote no figure");
    ck_assert(access("a.png", F_OK) != 0);
    setenv("PATH", search, 1);
    free(search);
    gough_table_free(run);
    remove_folder(folder);
}
END_TEST

START_TEST(nothing_is_left_behind) {
    char folder[PATH_SIZE], full[1024], path[PATH_SIZE];
    make_folder(folder);
    ck_assert(realpath(folder, full) != NULL);
    setenv("TMPDIR", full, 1);
    gough_table *run = run_table(20, 1.0);
    const gough_figure figure = gough_figure_default();
    expect_drawn(&figure, run, path_in(folder, "a.png", path));
    expect_refused(&figure, run, "no/such/folder/a.png", GOUGH_ERROR_FILE, "no/such/folder");
    ck_assert_int_eq(count_entries(folder), 1);
    unsetenv("TMPDIR");
    gough_table_free(run);
    remove_folder(folder);
}
END_TEST

/* Numbers that no run should have, but a file may: the figure is drawn all the same. */
START_TEST(any_numbers_are_drawn) {
    static const double odd[] = {0.0, NAN, INFINITY, -INFINITY, 1e308, -1e308, 1e-300, -3.5};
    char folder[PATH_SIZE], path[PATH_SIZE];
    make_folder(folder);
    path_in(folder, "a.svg", path);
    for (size_t k = 0; k < sizeof odd / sizeof odd[0] + 1; k++) {
        gough_table *run = run_table(30, 1.0);
        for (int c = 1; c < GOUGH_RXX; c++) {
            for (size_t r = 0; r < run->rows; r++)
                run->value[c][r] = odd[k < 8 ? k : (r + (size_t)c) % 8];
        }
        gough_figure figure = gough_figure_default();
        expect_drawn(&figure, run, path);
        figure.kind = "deviation";
        figure.logarithmic = true;
        expect_drawn(&figure, run, path);
        gough_table_free(run);
    }
    gough_table *single = run_table(1, 1.0);
    const gough_figure figure = gough_figure_default();
    expect_drawn(&figure, single, path);
    gough_table_free(single);
    remove_folder(folder);
}
END_TEST

int main(void) {
    return SUITE_RUN(
        "figure/figure", 200, every_kind_is_drawn, the_kind_is_chosen_by_the_table,
        every_format_is_complete_and_the_same_each_time, a_comma_locale_changes_no_byte,
        legs_that_coincide_are_one_line, tables_are_compared_by_their_labels,
        fonts_of_an_svg_have_substitutes, an_early_end_is_told, a_long_note_takes_several_lines,
        tuning_says_what_it_leaves_out_and_how_it_was_checked, long_tables_stay_small_files,
        study_text_runs_nothing, columns_of_other_hands_are_drawn_by_their_names,
        wrong_wishes_are_answered_with_what_would_be_right, files_that_cannot_be_written_are_named,
        a_missing_or_failing_gnuplot_is_told, nothing_is_left_behind, any_numbers_are_drawn);
}
