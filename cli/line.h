/* A line of text that grows piece by piece; what does not fit is cut. */
#ifndef MESHTOOL_CLI_LINE_H
#define MESHTOOL_CLI_LINE_H

#include <meshtool/context.h>

typedef struct cli_line {
    char text[2048];
    size_t length;
} cli_line;

/* Adds formatted text. */
void cli_line_add(cli_line *line, const char *format, ...) MT_PRINTF(2, 3);

/* Adds item number `index` of `count` with what stands before it in a sentence: "a", ", b", " and c". */
void cli_line_add_item(cli_line *line, size_t index, size_t count, const char *item);

#endif
