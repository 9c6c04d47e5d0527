/* HDF5: one one-dimensional dataset a column on the dimension scale that the first is, in the order of the table, with units
 * and long_name; the root carries the study. The file has no times, so that the same run gives the same bytes. It is written
 * straight into the output, a stretch of rows at a time, so that memory does not grow with the rows; for a pipe or a device it is
 * built in memory. Laid out by the HDF5 Dimension Scale specification, which is what netCDF-4 reads. */
#include <errno.h>
#include <hdf5.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "gough/version.h"
#include "table/hdf5_output.h"
#include "table/table.h"

enum {
    IMAGE_STEP = 1 << 20,
    STRETCH_NUMBERS = 1 << 19, /* numbers of a stretch of rows: 4 MiB of doubles */
    LEAST_STRETCH = 512,
    SIEVE = 4096 /* bytes: stretches are larger, and need no buffer of HDF5's */
};

/* One entry of the scale's list of the datasets that stand on it. */
typedef struct scale_user {
    hobj_ref_t dataset;
    unsigned dimension;
    unsigned padding;
} scale_user;

static bool put_attribute(hid_t object, const char *name, hid_t type, hid_t space,
                          const void *value) {
    const hid_t attribute = H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    bool good = attribute >= 0 && H5Awrite(attribute, type, value) >= 0;
    if (attribute >= 0) good = H5Aclose(attribute) >= 0 && good;
    return good;
}

/* Text of fixed length, UTF-8. An empty text is one NUL, for a string of no length cannot be stored. */
static bool put_text(hid_t object, const char *name, const char *text) {
    const size_t length = strlen(text);
    const hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
    const bool good = type >= 0 && space >= 0 && H5Tset_size(type, length > 0 ? length : 1) >= 0 &&
                      H5Tset_strpad(type, H5T_STR_NULLPAD) >= 0 &&
                      H5Tset_cset(type, H5T_CSET_UTF8) >= 0 &&
                      put_attribute(object, name, type, space, text);
    H5Sclose(space);
    H5Tclose(type);
    return good;
}

static bool put_number(hid_t object, const char *name, double value) {
    const hid_t space = H5Screate(H5S_SCALAR);
    const bool good = put_attribute(object, name, H5T_IEEE_F64LE, space, &value);
    H5Sclose(space);
    return good;
}

/* Marks a dataset as the dimension scale of that name. */
static bool put_scale(hid_t dataset, const char *name) {
    static const char class_name[] = "DIMENSION_SCALE";
    const hid_t space = H5Screate(H5S_SCALAR), type = H5Tcopy(H5T_C_S1);
    const bool good = H5Tset_size(type, sizeof class_name) >= 0 &&
                      put_attribute(dataset, "CLASS", type, space, class_name) &&
                      H5Tset_size(type, strlen(name) + 1) >= 0 &&
                      put_attribute(dataset, "NAME", type, space, name);
    H5Tclose(type);
    H5Sclose(space);
    return good;
}

/* Says that the only dimension of a dataset is the scale. */
static bool put_dimension(hid_t dataset, hobj_ref_t *scale) {
    const hsize_t one = 1;
    hvl_t list = {1, scale};
    const hid_t space = H5Screate_simple(1, &one, NULL), type = H5Tvlen_create(H5T_STD_REF_OBJ);
    const bool good = put_attribute(dataset, "DIMENSION_LIST", type, space, &list);
    H5Tclose(type);
    H5Sclose(space);
    return good;
}

/* Tells the scale which datasets stand on it. */
static bool put_users(hid_t dataset, const scale_user *users, int count) {
    if (count == 0) return true;
    const hsize_t size = (hsize_t)count;
    const hid_t space = H5Screate_simple(1, &size, NULL);
    const hid_t type = H5Tcreate(H5T_COMPOUND, sizeof *users);
    const bool good =
        H5Tinsert(type, "dataset", HOFFSET(scale_user, dataset), H5T_STD_REF_OBJ) >= 0 &&
        H5Tinsert(type, "dimension", HOFFSET(scale_user, dimension), H5T_STD_U32LE) >= 0 &&
        put_attribute(dataset, "REFERENCE_LIST", type, space, users);
    H5Tclose(type);
    H5Sclose(space);
    return good;
}

/* What the whole numbers of a column mean, by the conventions of netCDF. */
static bool put_flags(hid_t dataset, const char *meanings, int count) {
    enum { MOST = 32 };
    int values[MOST];
    const hsize_t size = (hsize_t)(count < MOST ? count : MOST);
    for (int i = 0; i < MOST; i++) values[i] = i;
    const hid_t space = H5Screate_simple(1, &size, NULL);
    const bool good = put_attribute(dataset, "flag_values", H5T_NATIVE_INT, space, values) &&
                      put_text(dataset, "flag_meanings", meanings);
    H5Sclose(space);
    return good;
}

/* Rows of a stretch. */
static size_t stretch_of(const result_file *content) {
    const size_t rows = STRETCH_NUMBERS / (size_t)content->columns;
    return rows > LEAST_STRETCH ? rows : LEAST_STRETCH;
}

/* Writes some rows of a column. */
static bool put_rows(hid_t dataset, const result_file *content, int column, size_t first,
                     size_t count) {
    const double *values = content->values(content->context, column, first, count);
    if (values == NULL) return false;
    if (count == 0) return true;
    const hsize_t start = first, size = count;
    const hid_t memory = H5Screate_simple(1, &size, NULL), space = H5Dget_space(dataset);
    const bool good = H5Sselect_hyperslab(space, H5S_SELECT_SET, &start, NULL, &size, NULL) >= 0 &&
                      H5Dwrite(dataset, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, values) >= 0;
    H5Sclose(space);
    H5Sclose(memory);
    return good;
}

/* Creates a column with its first rows. */
static bool put_column(hid_t file, hid_t creation, const result_file *content, int i, size_t count,
                       hobj_ref_t *scale) {
    const result_column *column = &content->column[i];
    const hsize_t rows = content->rows;
    const hid_t space = H5Screate_simple(1, &rows, NULL);
    const hid_t type = column->whole ? H5T_STD_I32LE : H5T_IEEE_F64LE;
    const hid_t dataset =
        H5Dcreate2(file, column->name, type, space, H5P_DEFAULT, creation, H5P_DEFAULT);
    bool good = dataset >= 0 && put_rows(dataset, content, i, 0, count);
    if (good) good = i == 0 ? put_scale(dataset, column->name) : put_dimension(dataset, scale);
    if (good) good = put_text(dataset, "units", column->unit);
    if (good) good = put_text(dataset, "long_name", column->long_name);
    if (good && column->flags) good = put_flags(dataset, column->flags, column->flag_count);
    if (dataset >= 0) good = H5Dclose(dataset) >= 0 && good;
    H5Sclose(space);
    return good;
}

/* Whether HDF5 has written so far what it was told to. */
static bool went_well(const hdf5_output *output) { return !output || output->failed == 0; }

/* The rows behind the first stretch. */
static bool put_rest(hid_t file, const result_file *content, const hdf5_output *output) {
    const size_t stretch = stretch_of(content);
    if (content->rows <= stretch) return true;
    hid_t *dataset = calloc((size_t)content->columns, sizeof *dataset);
    bool good = dataset != NULL;
    int open = 0;
    for (; good && open < content->columns; open++) {
        dataset[open] = H5Dopen2(file, content->column[open].name, H5P_DEFAULT);
        good = dataset[open] >= 0;
    }
    for (size_t at = stretch; good && at < content->rows; at += stretch) {
        const size_t left = content->rows - at, count = left < stretch ? left : stretch;
        for (int i = 0; i < content->columns && good; i++)
            good = put_rows(dataset[i], content, i, at, count) && went_well(output);
    }
    for (int i = 0; i < open; i++) good = H5Dclose(dataset[i]) >= 0 && good;
    free(dataset);
    return good;
}

static bool put_columns(hid_t file, const result_file *content, const hdf5_output *output) {
    const size_t stretch = stretch_of(content);
    const size_t count = content->rows < stretch ? content->rows : stretch;
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    scale_user *users = calloc((size_t)content->columns, sizeof *users);
    bool good =
        users != NULL && creation >= 0 && H5Pset_obj_track_times(creation, false) >= 0 &&
        H5Pset_attr_creation_order(creation, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED) >= 0;
    hobj_ref_t scale = 0;
    for (int i = 0; i < content->columns && good; i++) {
        good = put_column(file, creation, content, i, count, &scale) && went_well(output);
        void *reference = i == 0 ? &scale : &users[i - 1].dataset;
        if (good) good = H5Rcreate(reference, file, content->column[i].name, H5R_OBJECT, -1) >= 0;
    }
    H5Pclose(creation);
    if (good) {
        const hid_t first = H5Dopen2(file, content->column[0].name, H5P_DEFAULT);
        good = first >= 0 && put_users(first, users, content->columns - 1);
        H5Dclose(first);
    }
    free(users);
    return good && put_rest(file, content, output);
}

static bool put_root(hid_t file, const result_file *content) {
    bool good = true;
    for (int i = 0; i < content->attributes && good; i++) {
        const result_attribute *attribute = &content->attribute[i];
        good = attribute->text ? put_text(file, attribute->name, attribute->text)
                               : put_number(file, attribute->name, attribute->number);
    }
    return good;
}

/* An empty file in an output, or in memory; order of links and attributes kept, no times. driver: to be closed behind the file */
static hid_t create_file(hdf5_output *output, hid_t *driver) {
    const unsigned order = H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED;
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS), creation = H5Pcreate(H5P_FILE_CREATE);
    hid_t file = -1;
    *driver = -1;
    bool good = access >= 0 && creation >= 0 && H5Pset_sieve_buf_size(access, SIEVE) >= 0;
    if (good && output) {
        *driver = hdf5_output_set(access, output);
        good = *driver >= 0;
    } else if (good) {
        good = H5Pset_fapl_core(access, IMAGE_STEP, false) >= 0;
    }
    if (good && H5Pset_libver_bounds(access, H5F_LIBVER_EARLIEST, H5F_LIBVER_V18) >= 0 &&
        H5Pset_link_creation_order(creation, order) >= 0 &&
        H5Pset_attr_creation_order(creation, order) >= 0 &&
        H5Pset_obj_track_times(creation, false) >= 0)
        file = H5Fcreate("gough.h5", H5F_ACC_TRUNC, creation, access);
    H5Pclose(access);
    H5Pclose(creation);
    return file;
}

/* Writes the file into an output that can be written anywhere. */
static bool write_directly(const result_file *content, hdf5_output *output) {
    hid_t driver;
    const hid_t file = create_file(output, &driver);
    bool good = file >= 0 && put_root(file, content) && put_columns(file, content, output) &&
                H5Fflush(file, H5F_SCOPE_GLOBAL) >= 0;
    hdf5_output_finish(output);
    if (file >= 0) good = H5Fclose(file) >= 0 && good;
    hdf5_output_close(driver);
    return good && output->failed == 0;
}

/* The file's bytes, for the caller to free; NULL on failure. */
static void *build_image(const result_file *content, size_t *length) {
    hid_t driver;
    const hid_t file = create_file(NULL, &driver);
    if (file < 0) return NULL;
    void *image = NULL;
    if (put_root(file, content) && put_columns(file, content, NULL) &&
        H5Fflush(file, H5F_SCOPE_GLOBAL) >= 0) {
        const ssize_t size = H5Fget_file_image(file, NULL, 0);
        image = size > 0 ? malloc((size_t)size) : NULL;
        *length = size > 0 ? (size_t)size : 0;
        if (image != NULL && H5Fget_file_image(file, image, (size_t)size) != size) {
            free(image);
            image = NULL;
        }
    }
    H5Fclose(file);
    return image;
}

/* Adds the file to an output that takes bytes in their order only. */
static gough_status add_image(const result_file *content, result_output *output,
                              gough_error *error) {
    size_t length = 0;
    void *image = NULL;
    H5E_BEGIN_TRY { image = build_image(content, &length); }
    H5E_END_TRY;
    gough_status status = GOUGH_ERROR_FILE;
    if (image == NULL)
        gough_fail(error, status, "%s: cannot build the HDF5 file in memory (%zu rows)",
                   output->path, content->rows);
    else
        status = result_output_add(output, image, length, error);
    free(image);
    return status;
}

static gough_status add_file(const result_file *content, result_output *output,
                             gough_error *error) {
    if (output->final == NULL) return add_image(content, output, error);
    hdf5_output direct = {.file = output->file};
    bool good = false;
    H5E_BEGIN_TRY { good = write_directly(content, &direct); }
    H5E_END_TRY;
    if (good) return GOUGH_OK;
    if (direct.failed)
        return gough_fail(error, GOUGH_ERROR_FILE, "%s: cannot write: %s", output->path,
                          strerror(direct.failed));
    return gough_fail(error, GOUGH_ERROR_FILE, "%s: cannot build the HDF5 file (%zu rows)",
                      output->path, content->rows);
}

gough_status result_write_hdf5_file(const result_file *content, const char *path,
                                    gough_error *error) {
    result_output *output = malloc(sizeof *output);
    if (output == NULL) return gough_fail(error, GOUGH_ERROR_FILE, "%s: out of memory", path);
    gough_status status = result_output_open(output, path, error);
    if (status == GOUGH_OK) {
        status = add_file(content, output, error);
        if (status == GOUGH_OK)
            status = result_output_finish(output, error);
        else
            result_output_abandon(output);
    }
    free(output);
    return status;
}

int result_put_settings(const double setting[RESULT_SETTINGS], result_attribute *attribute) {
    static const char *const name[RESULT_SETTINGS] = {"tolerance", "step", "max_speed",
                                                      "max_force"};
    int count = 0;
    for (int i = 0; i < RESULT_SETTINGS; i++)
        if (!isnan(setting[i])) attribute[count++] = (result_attribute){name[i], NULL, setting[i]};
    return count;
}

static const double *values_of(void *context, int column, size_t first, size_t count) {
    const gough_result *result = context;
    static const double none = 0;
    (void)count;
    return result->value[column] ? result->value[column] + first : &none;
}

gough_status result_write_hdf5(const gough_result *result, const char *path, gough_error *error) {
    enum { OWN_ATTRIBUTES = 8, ATTRIBUTES = OWN_ATTRIBUTES + RESULT_SETTINGS };
    result_column column[GOUGH_COLUMNS] = {{.name = NULL}};
    for (int i = 0; i < result->columns; i++) {
        const int c = result->column[i];
        const gough_column_info *info = gough_column(c);
        const char *unit = gough_unit_label(&result->units, gough_unit_of_column(c));
        column[i] = (result_column){.name = info->name, .unit = unit, .long_name = info->long_name};
    }
    result_attribute attribute[ATTRIBUTES] = {{"title", result->title, 0},
                                              {"study", result->text, 0},
                                              {"software", "gough", 0},
                                              {"version", GOUGH_VERSION, 0},
                                              {"verb", result->verb, 0},
                                              {"end_time", NULL, result->end.time},
                                              {"end_cause", gough_cause_name(result->end.cause), 0},
                                              {"end_message", result->end.message, 0}};
    const double setting[RESULT_SETTINGS] = {result->tolerance, result->step, result->max_speed,
                                             result->max_force};
    const int settings = result_put_settings(setting, attribute + OWN_ATTRIBUTES);
    const result_file content = {.column = column,
                                 .columns = result->columns,
                                 .rows = result->rows,
                                 .attribute = attribute,
                                 .attributes = OWN_ATTRIBUTES + settings,
                                 .values = values_of,
                                 .context = (void *)result};
    return result_write_hdf5_file(&content, path, error);
}
