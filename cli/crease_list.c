#include "crease_list.h"

#include "message.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define INFINITE 10.0
#define LINE_ROOM 256 /* longer lines hold no statement */

typedef struct list_reader {
    mt_context *context;
    const mt_mesh *mesh;
    cli_crease_list *list;
    const char *path;
    uint64_t line;
} list_reader;

static mt_status fail_line(list_reader *reader, const char *sentence)
{
    mt_place place = {.file = reader->path, .line = reader->line};
    return mt_fail_at(reader->context, MT_ERROR_SYNTAX, place, "%s", sentence);
}

/* Makes room for one more item, doubling. */
static void *grow(mt_context *context, void *items, mt_index count, size_t size)
{
    bool full = (count & (count - 1)) == 0; /* 0, 1, 2, 4 ... */
    return full ? mt_reallocate(context, items, (count ? 2 * (uint64_t)count : 1) * size) : items;
}

static bool take_index(const char **at, mt_index limit, mt_index *index)
{
    char *stop;
    const char *begin = *at + strspn(*at, " \t");
    errno = 0;
    unsigned long number = strtoul(begin, &stop, 10);
    bool right = stop != begin && *begin != '-' && *begin != '+' && errno == 0 && number < limit;
    *index = right ? (mt_index)number : 0;
    *at = stop;
    return right;
}

static bool take_sharpness(const char **at, double *sharpness)
{
    static const char infinite[] = "infinite";
    const char *begin = *at + strspn(*at, " \t");
    if (strncmp(begin, infinite, sizeof infinite - 1) == 0) {
        *sharpness = INFINITE;
        *at = begin + sizeof infinite - 1;
        return true;
    }
    char *stop;
    *sharpness = strtod(begin, &stop);
    *at = stop;
    return stop != begin && !isnan(*sharpness);
}

static bool ends(const char *at)
{
    at += strspn(at, " \t\r\n");
    return *at == '\0' || *at == '#';
}

static mt_status add_crease(list_reader *reader, const char *at)
{
    mt_edge_value crease;
    cli_crease_list *list = reader->list;
    mt_index limit = reader->mesh->vertex_count;
    if (!take_index(&at, limit, &crease.a) || !take_index(&at, limit, &crease.b) ||
        !take_sharpness(&at, &crease.value) || !ends(at)) {
        return fail_line(reader, "expected \"crease A B SHARPNESS\" with the numbers of two vertices, counted from 0");
    }
    mt_edge_value *grown = grow(reader->context, list->creases, list->crease_count, sizeof *grown);
    if (!grown) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    list->creases = grown;
    list->creases[list->crease_count++] = crease;
    return MT_OK;
}

static mt_status add_corner(list_reader *reader, const char *at)
{
    mt_vertex_value corner;
    cli_crease_list *list = reader->list;
    if (!take_index(&at, reader->mesh->vertex_count, &corner.vertex) || !take_sharpness(&at, &corner.value) ||
        !ends(at)) {
        return fail_line(reader, "expected \"corner V SHARPNESS\" with the number of a vertex, counted from 0");
    }
    mt_vertex_value *grown = grow(reader->context, list->corners, list->corner_count, sizeof *grown);
    if (!grown) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    list->corners = grown;
    list->corners[list->corner_count++] = corner;
    return MT_OK;
}

static mt_status add_hole(list_reader *reader, const char *at)
{
    mt_index face;
    cli_crease_list *list = reader->list;
    if (!take_index(&at, reader->mesh->face_count, &face) || !ends(at)) {
        return fail_line(reader, "expected \"hole F\" with the number of a face, counted from 0");
    }
    mt_index *grown = grow(reader->context, list->holes, list->hole_count, sizeof *grown);
    if (!grown) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    list->holes = grown;
    list->holes[list->hole_count++] = face;
    return MT_OK;
}

static mt_status add_line(list_reader *reader, const char *at)
{
    static const struct {
        const char *word;
        mt_status (*add)(list_reader *, const char *);
    } statements[] = {{"crease", add_crease}, {"corner", add_corner}, {"hole", add_hole}};
    at += strspn(at, " \t");
    size_t size = strcspn(at, " \t\r\n");
    if (ends(at)) {
        return MT_OK;
    }
    for (size_t i = 0; i < sizeof statements / sizeof statements[0]; i++) {
        if (strlen(statements[i].word) == size && strncmp(at, statements[i].word, size) == 0) {
            return statements[i].add(reader, at + size);
        }
    }
    return fail_line(reader, "expected a line that begins with crease, corner, hole or #");
}

static mt_status read_lines(list_reader *reader, FILE *file)
{
    char line[LINE_ROOM];
    mt_status status = MT_OK;
    while (status == MT_OK && fgets(line, sizeof line, file)) {
        reader->line++;
        bool whole = strchr(line, '\n') || feof(file);
        status = whole || line[strspn(line, " \t")] == '#' ? add_line(reader, line)
                                                           : fail_line(reader, "this line is too long for a statement");
        for (int c = 0; !whole && c != '\n' && c != EOF;) {
            c = fgetc(file);
        }
    }
    if (status == MT_OK && ferror(file)) {
        status = mt_fail(reader->context, MT_ERROR_IO, "%s: %s", reader->path, strerror(errno));
    }
    return status;
}

cli_exit cli_crease_list_read(const cli_job *job, const char *path, const mt_mesh *mesh, cli_crease_list *list)
{
    list_reader reader = {.context = job->context, .mesh = mesh, .list = list, .path = path};
    FILE *file = fopen(path, "re");
    mt_status status = file ? read_lines(&reader, file)
                            : mt_fail(job->context, MT_ERROR_IO, "cannot read %s: %s", path, strerror(errno));
    if (file) {
        fclose(file);
    }
    if (status != MT_OK) {
        cli_crease_list_release(job, list);
        return cli_report_failure(job, path);
    }
    return CLI_EXIT_DONE;
}

void cli_crease_list_release(const cli_job *job, cli_crease_list *list)
{
    mt_free(job->context, list->creases);
    mt_free(job->context, list->corners);
    mt_free(job->context, list->holes);
    *list = (cli_crease_list){0};
}
