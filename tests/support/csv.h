/* Tables of plain cells between commas, with the names of the columns in the first row. */
#ifndef TESTS_SUPPORT_CSV_H
#define TESTS_SUPPORT_CSV_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define TEST_CSV_COLUMNS 16

typedef struct test_csv {
    char *text;
    char *names[TEST_CSV_COLUMNS];
    size_t column_count, row_count;
    char *(*rows)[TEST_CSV_COLUMNS];
} test_csv;

/* Reads a table; fails the test when it is missing or a row has too few or too many cells. */
test_csv test_csv_read(const char *path);
void test_csv_release(test_csv *table);

/* A cell by the name of its column, which must exist. */
const char *test_csv_cell(const test_csv *table, size_t row, const char *column);
/* Whether the cell holds something, and then its whole number. */
bool test_csv_number(const test_csv *table, size_t row, const char *column, int64_t *number);

#endif
