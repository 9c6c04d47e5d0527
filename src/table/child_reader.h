/* Running a reader in a child process, so that bytes which break a library end in a message. */
#ifndef GOUGH_TABLE_CHILD_READER_H
#define GOUGH_TABLE_CHILD_READER_H

#include "gough/result.h"

typedef gough_status result_reader(const char *path, gough_table *table, gough_error *error);

/* Fills the table, whose fields are all zero, with what @p read brings in the child. */
gough_status result_read_in_child(result_reader *read, const char *path, gough_table *table,
                                  gough_error *error);

#endif
