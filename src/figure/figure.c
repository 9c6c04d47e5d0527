/* A figure of tables: chosen kind, panels, gnuplot in a private folder, the picture written complete or not at all. */
#define _XOPEN_SOURCE 700

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "figure/difference.h"
#include "figure/private_folder.h"
#include "figure/sheet.h"
#include "gough/sizes.h"

gough_status gough_figure_init(gough_figure *figure, size_t size) {
    if (size != sizeof *figure) return gough_size_refuse(figure, size);
    *figure = (gough_figure){.size = size,
                             .kind = NULL,
                             .title = NULL,
                             .columns = NULL,
                             .from = NAN,
                             .to = NAN,
                             .max_speed = NAN,
                             .max_force = NAN,
                             .style = NULL,
                             .width = NAN,
                             .font = NAN,
                             .dpi = NAN,
                             .split = false,
                             .difference = false};
    return GOUGH_OK;
}

static bool find_format(const char *path, sheet_format *format) {
    static const char *const extensions[] = {
        [SHEET_PNG] = ".png", [SHEET_SVG] = ".svg", [SHEET_PDF] = ".pdf"};
    const size_t length = strlen(path);
    for (int f = SHEET_PNG; f <= SHEET_PDF; f++) {
        if (length > 4 && strcasecmp(path + length - 4, extensions[f]) == 0) {
            *format = (sheet_format)f;
            return true;
        }
    }
    return false;
}

static gough_status finish_picture(char *bytes, size_t length, sheet_format format,
                                   const sheet_facts *facts, const char *path, gough_error *error) {
    if (format == SHEET_PDF) sheet_blank_date(bytes, length);
    if (format != SHEET_SVG) return gough_write_file(path, bytes, length, error);
    char *named = sheet_name_fonts(bytes, &length);
    char *sized = named != NULL ? sheet_set_size(named, &length, facts) : NULL;
    char *told = sized != NULL ? sheet_set_words(sized, &length, facts) : NULL;
    gough_status status = GOUGH_OK;
    if (told == NULL)
        status = gough_fail(error, GOUGH_ERROR_FILE, "%s: out of memory", path);
    else
        status = gough_write_file(path, told, length, error);
    free(told);
    free(sized);
    free(named);
    return status;
}

/* Copies the picture that gnuplot left to where it is wanted. */
static gough_status take_picture(const char *folder, sheet_format format, const sheet_facts *facts,
                                 const char *path, gough_error *error) {
    char from[256];
    snprintf(from, sizeof from, "%s/figure", folder);
    FILE *file = fopen(from, "rb");
    if (file == NULL)
        return gough_fail(error, GOUGH_ERROR_FILE, "%s: gnuplot wrote no figure", path);
    gough_status status = GOUGH_ERROR_FILE;
    long length = -1;
    if (fseek(file, 0, SEEK_END) == 0) length = ftell(file);
    rewind(file);
    char *bytes = length > 0 ? malloc((size_t)length) : NULL;
    if (bytes != NULL && fread(bytes, 1, (size_t)length, file) == (size_t)length)
        status = finish_picture(bytes, (size_t)length, format, facts, path, error);
    else
        status = gough_fail(error, status, "%s: gnuplot wrote no figure", path);
    free(bytes);
    fclose(file);
    return status;
}

gough_status sheet_draw(sheet_writer write, const void *content, const char *path,
                        gough_error *error) {
    sheet_format format;
    if (!find_format(path, &format))
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "%s: the name of a figure must end in .png, .svg or .pdf", path);
    workshop shop;
    gough_status status = workshop_open(&shop, error);
    if (status != GOUGH_OK) return status;
    sheet_facts facts = {0};
    status = write(content, format, shop.folder, &facts, error);
    if (status == GOUGH_OK) status = sheet_run_gnuplot(shop.folder, error);
    if (status == GOUGH_OK) status = take_picture(shop.folder, format, &facts, path, error);
    workshop_close(&shop);
    return status;
}

/* ---- tables for figures -------------------------------------------------------------------------------------------- */

/* A smaller file is read whole: its numbers take little memory. */
enum { LARGE_FILE = 16 << 20 };

/* A gough_table_sink: a table without numbers of the names, if they are those of a sweep. */
static int take_heads(void *context, const gough_table *part) {
    gough_table **heads = context, *table = NULL;
    if (!sheet_is_sweep(part)) return 1;
    table = gough_table_new(part->title, part->verb, part->columns, 0);
    bool good = table != NULL;
    for (size_t c = 0; c < part->columns && good; c++)
        good = gough_table_name(table, c, part->name[c], part->unit[c]) != NULL;
    if (good) {
        for (size_t c = 0; c < table->columns; c++) free(table->value[c]);
        free(table->value);
        table->value = NULL;
        table->tolerance = part->tolerance;
        table->step = part->step;
        *heads = table;
    } else {
        gough_table_free(table);
    }
    return 1;
}

/* Whether a figure draws a sweep of this file from its rows in parts. */
static bool draws_parts(const gough_figure *figure, const char *path) {
    struct stat about;
    if (figure->kind != NULL && strcmp(figure->kind, "sweep") != 0) return false;
    return strcmp(path, "-") != 0 && stat(path, &about) == 0 && S_ISREG(about.st_mode) &&
           about.st_size >= LARGE_FILE;
}

gough_status gough_figure_read(const gough_figure *figure, const char *path, gough_table **table,
                               gough_error *error) {
    gough_table *heads = NULL;
    *table = NULL;
    if (gough_size_check(figure->size, sizeof(gough_figure), "gough_figure", error) != GOUGH_OK)
        return GOUGH_ERROR_INPUT;
    if (draws_parts(figure, path)) {
        const gough_status status = gough_table_scan(path, NULL, take_heads, &heads, error);
        if (status != GOUGH_OK) return status;
    }
    if (heads == NULL) return gough_table_read(path, table, error);
    heads->source = strdup(path);
    if (heads->source == NULL) {
        gough_table_free(heads);
        return gough_fail(error, GOUGH_ERROR_FILE, "%s: out of memory", path);
    }
    *table = heads;
    return GOUGH_OK;
}

static gough_status write_sheet(const void *content, sheet_format format, const char *folder,
                                sheet_facts *facts, gough_error *error) {
    return sheet_write_script(content, format, folder, facts, error);
}

static gough_status check_range(const char *name, double value, double least, double greatest,
                                const char *unit, gough_error *error) {
    if (isnan(value) || (value >= least && value <= greatest)) return GOUGH_OK;
    return gough_fail(error, GOUGH_ERROR_INPUT, "the %s of a figure is %g %s to %g %s; got %g %s",
                      name, least, unit, greatest, unit, value, unit);
}

/* Size of the picture and style of its lines. */
static gough_status set_print(sheet *s, const gough_figure *f, gough_error *error) {
    gough_status status = check_range("width", f->width, 40.0, 1000.0, "mm", error);
    if (status == GOUGH_OK) status = check_range("text", f->font, 4.0, 40.0, "points", error);
    if (status == GOUGH_OK)
        status = check_range("resolution", f->dpi, 30.0, 2400.0, "dots per inch", error);
    if (status != GOUGH_OK) return status;
    if (f->style != NULL && strcmp(f->style, "screen") != 0 && strcmp(f->style, "print") != 0)
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "the style of a figure is screen or print; got '%s'", f->style);
    s->print = f->style != NULL && strcmp(f->style, "print") == 0;
    s->dpi = isnan(f->dpi) ? 0.0 : f->dpi;
    if (isnan(f->width) && isnan(f->font)) return GOUGH_OK;
    /* text of TEXT nominal pixels is 8.64 points high where a pixel is a hundredth of an inch */
    const double points = isnan(f->font) ? 8.0 : f->font, inch = points / 8.64;
    const double width = isnan(f->width) ? (s->columns > 1 ? 264.16 : 198.12) : f->width;
    s->width = (int)floor(width / 0.254 / inch);
    s->inch = width / 0.254 / s->width;
    const double least = 260 * 0.254 * inch;
    if (width < least)
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "a figure with text of %g points is at least %.0f mm wide; got %g mm",
                          points, ceil(least), width);
    return GOUGH_OK;
}

gough_status gough_figure_draw(const gough_figure *figure, const gough_table *const *tables,
                               const char *const *labels, size_t table_count, const char *path,
                               gough_error *error) {
    sheet_format format;
    if (gough_size_check(figure->size, sizeof(gough_figure), "gough_figure", error) != GOUGH_OK)
        return GOUGH_ERROR_INPUT;
    if (!find_format(path, &format))
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "%s: the name of a figure must end in .png, .svg or .pdf", path);
    if (table_count == 0) return gough_fail(error, GOUGH_ERROR_INPUT, "no table to draw");

    sheet *s = calloc(1, sizeof *s);
    if (s == NULL) return gough_fail(error, GOUGH_ERROR_FILE, "%s: out of memory", path);
    difference d = {0};
    gough_status status = GOUGH_OK;
    if (figure->difference)
        status = difference_make(&d, figure, tables, labels, table_count, error);
    if (status == GOUGH_OK)
        status = sheet_fill(s, figure, tables, labels, table_count, figure->difference ? &d : NULL,
                            error);
    if (status == GOUGH_OK) status = set_print(s, figure, error);
    if (status == GOUGH_OK) status = sheet_draw(write_sheet, s, path, error);
    difference_free(&d);
    sheet_free_arrays(s);
    free(s);
    return status;
}
