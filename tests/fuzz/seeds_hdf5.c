/* Writes small HDF5 files into a folder, from which fuzzing begins: one for each way in which a column, an attribute or a link
 * may be stored, so that each part of the reader is a few changed bytes away.
 *   seeds_hdf5 FOLDER */
#include <hdf5.h>
#include <stdio.h>

enum { ROWS = 4 };
static const double number[ROWS] = {0, 0.5, -1.25, 3e300};

/* How a file and its columns are stored. */
typedef struct form {
    const char *name;
    int newest;  /* the newest format of the file instead of the oldest */
    int ordered; /* links in the order of their creation */
    hid_t type;  /* of the columns; 0: double */
    H5D_layout_t layout;
    int packed;              /* compressed and shuffled */
    hsize_t rows, more_rows; /* of the first column and of the second */
    int several_dimensions;  /* a dataset of two dimensions beside them */
    int links;               /* a group, links to a column, to nothing and to another file */
    int variable;            /* texts of variable length */
    int unwritten;           /* a column without numbers, only a fill value */
} form;

static void add_text(hid_t object, const char *name, const char *text, const form *f) {
    const hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
    H5Tset_size(type, f->variable ? H5T_VARIABLE : 8);
    H5Tset_cset(type, f->variable ? H5T_CSET_UTF8 : H5T_CSET_ASCII);
    const hid_t attribute = H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(attribute, type, f->variable ? (const void *)&text : text);
    H5Aclose(attribute);
    H5Sclose(space);
    H5Tclose(type);
}

static void add_number(hid_t object, const char *name, double value) {
    const hid_t space = H5Screate(H5S_SCALAR);
    const hid_t attribute =
        H5Acreate2(object, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(attribute, H5T_NATIVE_DOUBLE, &value);
    H5Aclose(attribute);
    H5Sclose(space);
}

static void add_dataset(hid_t file, const char *name, int dimensions, hsize_t rows, const form *f) {
    const hsize_t size[2] = {rows, 1}, chunk[2] = {2, 1};
    const hid_t space = H5Screate_simple(dimensions, size, NULL);
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    const double fill = 7;
    H5Pset_obj_track_times(creation, false);
    H5Pset_layout(creation, f->layout);
    if (f->layout == H5D_CHUNKED) H5Pset_chunk(creation, dimensions, chunk);
    if (f->packed) {
        H5Pset_shuffle(creation);
        H5Pset_deflate(creation, 6);
        H5Pset_fletcher32(creation);
    }
    if (f->unwritten) H5Pset_fill_value(creation, H5T_NATIVE_DOUBLE, &fill);
    const hid_t set = H5Dcreate2(file, name, f->type ? f->type : H5T_IEEE_F64LE, space, H5P_DEFAULT,
                                 creation, H5P_DEFAULT);
    if (rows > 0 && !f->unwritten)
        H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, number);
    add_text(set, "units", "N m", f);
    H5Dclose(set);
    H5Pclose(creation);
    H5Sclose(space);
}

static int write_seed(const char *folder, const form *f) {
    const unsigned order = f->ordered ? H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED : 0;
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS), creation = H5Pcreate(H5P_FILE_CREATE);
    char path[4096];
    snprintf(path, sizeof path, "%s/%s.h5", folder, f->name);
    H5Pset_link_creation_order(creation, order);
    H5Pset_obj_track_times(creation, false);
    H5Pset_libver_bounds(access, f->newest ? H5F_LIBVER_LATEST : H5F_LIBVER_EARLIEST,
                         H5F_LIBVER_LATEST);
    const hid_t file = H5Fcreate(path, H5F_ACC_TRUNC, creation, access);
    add_text(file, "title", "Seed", f);
    add_text(file, "verb", "forces", f);
    add_number(file, "end_time", 0.5);
    add_dataset(file, "t", 1, f->rows, f);
    add_dataset(file, "l1", 1, f->more_rows, f);
    if (f->several_dimensions) add_dataset(file, "square", 2, ROWS, f);
    if (f->links) {
        H5Gclose(H5Gcreate2(file, "group", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
        H5Lcreate_soft("/t", file, "again", H5P_DEFAULT, H5P_DEFAULT);
        H5Lcreate_soft("/nothing", file, "nowhere", H5P_DEFAULT, H5P_DEFAULT);
        H5Lcreate_external("other.h5", "/t", file, "elsewhere", H5P_DEFAULT, H5P_DEFAULT);
        H5Lcreate_hard(file, "t", file, "twice", H5P_DEFAULT, H5P_DEFAULT);
    }
    H5Pclose(creation);
    H5Pclose(access);
    return file >= 0 && H5Fclose(file) >= 0;
}

int main(int count, char **argument) {
    const form all[] = {
        {.name = "plain", .layout = H5D_CONTIGUOUS, .rows = ROWS, .more_rows = ROWS},
        {.name = "newest", .newest = 1, .layout = H5D_CONTIGUOUS, .rows = ROWS, .more_rows = ROWS},
        {.name = "ordered", .ordered = 1, .layout = H5D_COMPACT, .rows = ROWS, .more_rows = ROWS},
        {.name = "packed", .layout = H5D_CHUNKED, .packed = 1, .rows = ROWS, .more_rows = ROWS},
        {.name = "chunks", .newest = 1, .layout = H5D_CHUNKED, .rows = ROWS, .more_rows = ROWS},
        {.name = "whole", .type = H5T_STD_I16BE, .layout = H5D_COMPACT, .rows = 3, .more_rows = 3},
        {.name = "single",
         .type = H5T_IEEE_F32BE,
         .layout = H5D_COMPACT,
         .rows = 3,
         .more_rows = 3},
        {.name = "unequal", .layout = H5D_CONTIGUOUS, .rows = 2, .more_rows = ROWS},
        {.name = "empty", .layout = H5D_CONTIGUOUS},
        {.name = "square",
         .layout = H5D_COMPACT,
         .rows = 2,
         .more_rows = 2,
         .several_dimensions = 1},
        {.name = "links",
         .newest = 1,
         .layout = H5D_COMPACT,
         .rows = 2,
         .more_rows = 2,
         .links = 1},
        {.name = "texts", .layout = H5D_COMPACT, .rows = 2, .more_rows = 2, .variable = 1},
        {.name = "fill", .layout = H5D_CHUNKED, .rows = 2, .more_rows = 2, .unwritten = 1}};
    int good = count == 2;
    for (size_t i = 0; good && i < sizeof all / sizeof all[0]; i++)
        good = write_seed(argument[1], &all[i]);
    if (!good) fprintf(stderr, "seeds_hdf5 FOLDER: no seeds\n");
    return !good;
}
