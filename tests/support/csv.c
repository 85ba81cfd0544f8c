#include "tests/support/csv.h"

#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <stdlib.h>
#include <string.h>

static size_t split_row(char *row, char **cells)
{
    size_t count = 0;
    while (row) {
        assert_true(count < TEST_CSV_COLUMNS);
        cells[count++] = row;
        row = strchr(row, ',');
        if (row) {
            *row++ = '\0';
        }
    }
    return count;
}

test_csv test_csv_read(const char *path)
{
    test_csv table = {0};
    size_t size;
    unsigned char *bytes = test_read_file(path, &size);
    assert_non_null(bytes);
    table.text = malloc(size + 1);
    table.rows = malloc((size + 1) * sizeof *table.rows);
    assert_true(table.text && table.rows);
    memcpy(table.text, bytes, size);
    table.text[size] = '\0';
    free(bytes);
    char *rest = table.text;
    for (char *row = strtok_r(rest, "\n", &rest); row; row = strtok_r(NULL, "\n", &rest)) {
        if (table.column_count == 0) {
            table.column_count = split_row(row, table.names);
        } else {
            assert_int_equal(split_row(row, table.rows[table.row_count++]), table.column_count);
        }
    }
    return table;
}

void test_csv_release(test_csv *table)
{
    free(table->text);
    free(table->rows);
    *table = (test_csv){0};
}

const char *test_csv_cell(const test_csv *table, size_t row, const char *column)
{
    for (size_t i = 0; i < table->column_count; i++) {
        if (strcmp(table->names[i], column) == 0) {
            return table->rows[row][i];
        }
    }
    fail_msg("no column is called %s", column);
    return NULL;
}

bool test_csv_number(const test_csv *table, size_t row, const char *column, int64_t *number)
{
    const char *cell = test_csv_cell(table, row, column);
    char *end;
    *number = strtoll(cell, &end, 10);
    assert_int_equal(*end, '\0');
    return *cell != '\0';
}
