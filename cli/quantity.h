/* Numbers as people read them: counts with separators and the right plural, bytes, lengths. Each answer is a
 * small value, to be used within the expression that asks. */
#ifndef MESHTOOL_CLI_QUANTITY_H
#define MESHTOOL_CLI_QUANTITY_H

#include <meshtool/vector.h>

typedef struct cli_quantity {
    char text[120];
} cli_quantity;

/* 1234567 -> "1,234,567". */
cli_quantity cli_count(int64_t number);
/* 1, "edge" -> "1 edge"; 2, "edge" -> "2 edges"; knows "vertex", "genus" and words in -y. */
cli_quantity cli_counted(uint64_t number, const char *noun);
/* The plural of a noun, or itself for the number 1. */
cli_quantity cli_plural(uint64_t number, const char *noun);
/* "832 bytes", "1.5 MB" (powers of 1000, as file managers show). */
cli_quantity cli_bytes(uint64_t bytes);
/* Six significant digits. */
cli_quantity cli_real(double number);
/* "(0.5, 1, -2)", six significant digits. */
cli_quantity cli_point(mt_vec3 point);

#endif
