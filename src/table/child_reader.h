/* Running a reader in a child process, so that bytes which break a library end in a message. */
#ifndef GOUGH_TABLE_CHILD_READER_H
#define GOUGH_TABLE_CHILD_READER_H

#include "table/table.h"

typedef gough_status result_reader(const char *path, gough_table *table, gough_error *error);

/* Fills the table, whose fields are all zero, with what @p read brings in the child. */
gough_status result_read_in_child(result_reader *read, const char *path, gough_table *table,
                                  gough_error *error);

/* The same in parts: in the child @p read fills its table and hands over parts; here they go to the scan's sink, as parts of
 * @p table. */
typedef gough_status result_part_reader(result_scan *scan, gough_table *table, gough_error *error);
gough_status result_scan_in_child(result_part_reader *read, result_scan *scan, gough_table *table,
                                  gough_error *error);

#endif
