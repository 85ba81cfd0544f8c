#include "line.h"

#include <stdarg.h>
#include <stdio.h>

void cli_line_add(cli_line *line, const char *format, ...)
{
    size_t room = sizeof line->text - line->length;
    va_list arguments;
    va_start(arguments, format);
    int added = vsnprintf(line->text + line->length, room, format, arguments);
    va_end(arguments);
    if (added > 0) {
        line->length += (size_t)added < room ? (size_t)added : room - 1;
    }
}

void cli_line_add_item(cli_line *line, size_t index, size_t count, const char *item)
{
    cli_line_add(line, "%s%s", index == 0 ? "" : index + 1 < count ? ", " : " and ", item);
}
