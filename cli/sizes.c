#include "sizes.h"

#include "message.h"
#include "quantity.h"

#include <meshtool/mesh_format.h>

#include <string.h>

/* Of the default encoding, without the header. Text depends on digits and has none. */
typedef struct format_formula {
    const char *name, *formula;
    uint64_t (*bytes)(const mt_mesh *mesh);
} format_formula;

static uint64_t triangle_count(const mt_mesh *mesh)
{
    return (uint64_t)mesh->corner_count - 2 * (uint64_t)mesh->face_count;
}

static uint64_t stl_bytes(const mt_mesh *mesh)
{
    return 50 * triangle_count(mesh);
}

static uint64_t ply_bytes(const mt_mesh *mesh)
{
    return 3 * mt_type_size(mesh->position_type) * (uint64_t)mesh->vertex_count + mesh->face_count +
           4 * (uint64_t)mesh->corner_count;
}

static const format_formula formulas[] = {{"stl", "12 n_t", stl_bytes}, {"ply", "3 n_v + corners + n_f", ply_bytes}};

static const format_formula *find_formula(const char *name)
{
    for (size_t i = 0; i < sizeof formulas / sizeof *formulas; i++) {
        if (strcmp(formulas[i].name, name) == 0) {
            return &formulas[i];
        }
    }
    return NULL;
}

static void add_structures(const mt_mesh *mesh, cli_sizes *sizes)
{
    for (mt_storage_kind kind = 0; kind < MT_STORAGE_COUNT; kind++) {
        mt_storage row = mt_storage_by_formula(mesh, kind, MT_STORAGE_CLOSED);
        sizes->rows[sizes->count++] = (cli_size){.key = row.key,
                                                 .words = row.words,
                                                 .formula = row.formula,
                                                 .has_bytes = true,
                                                 .units = mt_storage_units(&row),
                                                 .bytes = mt_storage_bytes(mesh, &row)};
    }
}

/* Formats with indices hold positions and an index a corner; those without a normal and three points a triangle. */
static void add_formats(const mt_mesh *mesh, cli_sizes *sizes)
{
    for (const mt_mesh_format *const *format = mt_mesh_formats(); *format && sizes->count < CLI_SIZES_ROOM; format++) {
        const format_formula *known = find_formula((*format)->name);
        bool indexed = (*format)->abilities & MT_HOLDS_INDICES;
        bool polygons = (*format)->abilities & MT_HOLDS_POLYGONS;
        uint64_t corners = polygons ? mesh->corner_count : 3 * triangle_count(mesh);
        cli_size row = {.key = (*format)->name, .words = (*format)->title, .of_format = true};
        row.units = indexed ? 3 * (uint64_t)mesh->vertex_count + corners : 12 * triangle_count(mesh);
        row.formula = !indexed ? "12 n_t" : polygons ? "3 n_v + corners" : "3 n_v + 3 n_t";
        if (known) {
            row.formula = known->formula;
            row.has_bytes = true;
            row.bytes = known->bytes(mesh);
            row.units += strcmp(row.key, "ply") == 0 ? mesh->face_count : 0;
        }
        sizes->rows[sizes->count++] = row;
    }
}

static mt_status write_format(mt_context *context, const mt_mesh *mesh, const char *name, uint64_t *bytes)
{
    mt_mesh bare = mt_storage_bare_mesh(mesh);
    mt_mesh_write_options options = {.format = name};
    void *written = NULL;
    size_t size = 0;
    mt_status status = mt_mesh_write_memory(context, &bare, &options, &written, &size);
    mt_free(context, written);
    *bytes = size;
    return status;
}

/* Not to be held is an answer, no failure. */
static bool is_refusal(mt_status status)
{
    return status == MT_ERROR_NOT_MANIFOLD || status == MT_ERROR_NOT_ORIENTED || status == MT_ERROR_INVALID_MESH ||
           status == MT_ERROR_UNSUPPORTED;
}

static mt_status measure(mt_context *context, const mt_mesh *mesh, cli_size *row, mt_storage_kind kind)
{
    mt_status status = row->of_format ? write_format(context, mesh, row->key, &row->measured)
                                      : mt_storage_measure(context, mesh, kind, &row->measured);
    row->state = status == MT_OK ? CLI_SIZE_MEASURED : CLI_SIZE_IMPOSSIBLE;
    if (is_refusal(status)) {
        mt_context_clear_error(context);
        status = MT_OK;
    }
    return status;
}

cli_exit cli_sizes_find(const cli_job *job, const char *file, const mt_mesh *mesh, bool measured, cli_sizes *sizes)
{
    *sizes = (cli_sizes){.measured = measured};
    add_structures(mesh, sizes);
    add_formats(mesh, sizes);
    for (size_t i = 0; measured && i < sizes->count; i++) {
        if (measure(job->context, mesh, &sizes->rows[i], (mt_storage_kind)i) != MT_OK) {
            return cli_report_failure(job, file);
        }
    }
    return CLI_EXIT_DONE;
}

json_t *cli_size_json(uint64_t units, uint64_t bytes)
{
    json_t *size = cli_json_object();
    cli_json_set(size, "units", cli_json_integer((int64_t)units));
    cli_json_set(size, "bytes", cli_json_integer((int64_t)bytes));
    return size;
}

json_t *cli_sizes_json(const cli_sizes *sizes)
{
    json_t *object = cli_json_object(), *formats = cli_json_object();
    for (size_t i = 0; i < sizes->count; i++) {
        const cli_size *row = &sizes->rows[i];
        json_t *size = cli_size_json(row->units, row->bytes);
        if (!row->has_bytes) {
            cli_json_set(size, "bytes", json_null());
        }
        if (sizes->measured) {
            bool known = row->state == CLI_SIZE_MEASURED;
            cli_json_set(size, "measured", known ? cli_json_integer((int64_t)row->measured) : json_null());
        }
        cli_json_set(row->of_format ? formats : object, row->key, size);
    }
    cli_json_set(object, "formats", formats);
    return object;
}

static void print_row(const cli_sizes *sizes, const cli_size *row)
{
    printf("  %-20s %-25s %15s numbers %12s", row->words, row->formula, cli_count((int64_t)row->units).text,
           row->has_bytes ? cli_bytes(row->bytes).text : "-");
    if (sizes->measured) {
        printf(" %12s", row->state == CLI_SIZE_MEASURED ? cli_bytes(row->measured).text : "cannot hold");
    }
    putchar('\n');
}

void cli_sizes_print(const cli_sizes *sizes)
{
    printf("Positions and faces take, by formula%s:\n", sizes->measured ? " and measured" : "");
    for (size_t i = 0; i < sizes->count; i++) {
        if (i > 0 && sizes->rows[i].of_format && !sizes->rows[i - 1].of_format) {
            puts("and in files:");
        }
        print_row(sizes, &sizes->rows[i]);
    }
}
