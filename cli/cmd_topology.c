/* meshtool topology: a connectivity structure as tables, and what each kind takes in memory. */
#include "connectivity.h"
#include "files.h"
#include "message.h"
#include "quantity.h"
#include "sizes.h"

#include <meshtool/split_non_manifold.h>

#include <inttypes.h>

typedef struct topology_settings {
    cli_common common;
    unsigned structure; /* place in cli_connectivities */
    bool split;
} topology_settings;

static const char *const structure_names[] = {"half-edge", "winged-edge", "triangle-neighbor", NULL};

static const cli_option options[] = {
    {.name = "structure",
     .offset = offsetof(topology_settings, structure),
     .parse = cli_parse_choice,
     .argument = "KIND",
     .expects = "half-edge, winged-edge or triangle-neighbor",
     .choices = structure_names,
     .help = "half-edge, winged-edge or triangle-neighbor (triangles only); half-edge"},
    {.name = "split-non-manifold",
     .offset = offsetof(topology_settings, split),
     .help = "copy vertices until the structure can hold the mesh, instead of refusing it"},
    {0},
};

/* What is shown: a structure of the mesh, which may have been split. */
typedef struct topology_view {
    const cli_connectivity *kind;
    const void *structure;
    const mt_mesh *mesh;
    const mt_index *sources; /* per vertex the one of the file that it is a copy of; NULL: not split */
    mt_index file_vertex_count;
} topology_view;

/* The ways to store positions and faces that are set side by side. */
static const mt_storage_kind storages[] = {MT_STORAGE_SEPARATE_TRIANGLES, MT_STORAGE_INDEXED_MESH,
                                           MT_STORAGE_TRIANGLE_NEIGHBOR, MT_STORAGE_WINGED_EDGE, MT_STORAGE_HALF_EDGE};
#define STORAGE_COUNT (sizeof storages / sizeof *storages)

static mt_storage storage_of(const topology_view *view, size_t i)
{
    return mt_storage_by_formula(view->mesh, storages[i], view->kind->edge_count(view->structure));
}

/* JSON: all rows, printed one by one, since a tree of them would take many times the structure's memory. */

static void print_number(mt_index number)
{
    if (number == MT_NONE) {
        fputs("null", stdout);
    } else {
        printf("%" PRIu32, number);
    }
}

static void print_json_table(const topology_view *view, const cli_table *table)
{
    printf("\"%s\": [", table->key);
    mt_index count = table->count(view->structure);
    for (mt_index element = 0; element < count; element++) {
        mt_index values[CLI_TABLE_COLUMNS];
        table->row(view->structure, element, values);
        for (size_t i = 0; table->columns[i]; i++) {
            printf("%s\"%s\": ", i ? ", " : element ? ", {" : "{", table->columns[i]);
            print_number(values[i]);
        }
        putchar('}');
    }
    putchar(']');
}

static json_t *counts_json(const topology_view *view)
{
    json_t *object = cli_json_object();
    cli_json_set(object, "vertices", cli_json_integer(view->mesh->vertex_count));
    cli_json_set(object, "edges", cli_json_integer(view->kind->edge_count(view->structure)));
    cli_json_set(object, "faces", cli_json_integer(view->mesh->face_count));
    cli_json_set(object, "triangles",
                 cli_json_integer((int64_t)view->mesh->corner_count - 2 * (int64_t)view->mesh->face_count));
    cli_json_set(object, "boundary_edges", cli_json_integer(view->kind->boundary_count(view->structure)));
    return object;
}

static json_t *bytes_json(const topology_view *view)
{
    json_t *object = cli_json_object(), *elements = cli_json_object(), *storage = cli_json_object();
    for (size_t i = 0; i < CLI_CONNECTIVITY_TABLES && view->kind->tables[i].key; i++) {
        cli_json_set(elements, view->kind->tables[i].key, cli_json_integer(view->kind->tables[i].bytes));
    }
    for (size_t i = 0; i < STORAGE_COUNT; i++) {
        mt_storage row = storage_of(view, i);
        cli_json_set(storage, row.key, cli_size_json(mt_storage_units(&row), mt_storage_bytes(view->mesh, &row)));
    }
    cli_json_set(object, "structure", cli_json_integer((int64_t)view->kind->size(view->structure)));
    cli_json_set(object, "per_element", elements);
    cli_json_set(object, "storage", storage);
    return object;
}

/* Per vertex that splitting added, the vertex of the file. */
static json_t *split_json(const topology_view *view)
{
    json_t *array = cli_json_array();
    for (mt_index vertex = view->file_vertex_count; vertex < view->mesh->vertex_count; vertex++) {
        cli_json_append(array, cli_json_integer(view->sources[vertex]));
    }
    return array;
}

static void print_json(const cli_job *job, const topology_view *view)
{
    json_t *object = cli_json_object();
    cli_json_set(object, "file", cli_json_text(job->operands[0]));
    cli_json_set(object, "structure", cli_json_text(view->kind->name));
    cli_json_set(object, "counts", counts_json(view));
    cli_json_set(object, "bytes", bytes_json(view));
    if (view->sources) {
        cli_json_set(object, "split", split_json(view));
    }
    cli_json_print_open(stdout, object);
    json_decref(object);
    fputs(", \"tables\": {", stdout);
    for (size_t i = 0; i < CLI_CONNECTIVITY_TABLES && view->kind->tables[i].key; i++) {
        fputs(i ? ", " : "", stdout);
        print_json_table(view, &view->kind->tables[i]);
    }
    puts("}}");
}

/* Text: the first rows of each table. */

#define ROWS_SHOWN 20

static void print_text_table(const topology_view *view, const cli_table *table)
{
    mt_index count = table->count(view->structure);
    printf("\n%12s", table->element);
    for (size_t i = 0; table->columns[i]; i++) {
        printf(" %9s", table->columns[i]);
    }
    putchar('\n');
    for (mt_index element = 0; element < count && element < ROWS_SHOWN; element++) {
        mt_index values[CLI_TABLE_COLUMNS];
        table->row(view->structure, element, values);
        printf("%12" PRIu32, element);
        for (size_t i = 0; table->columns[i]; i++) {
            if (values[i] == MT_NONE) {
                printf(" %9s", "-");
            } else {
                printf(" %9" PRIu32, values[i]);
            }
        }
        putchar('\n');
    }
    if (count > ROWS_SHOWN) {
        printf("%12s and %s more; --json has all\n", "...", cli_count((int64_t)count - ROWS_SHOWN).text);
    }
}

static void print_storage(const topology_view *view)
{
    double triangles = (double)view->mesh->corner_count - 2 * (double)view->mesh->face_count;
    puts("\nPositions and faces take, by formula:");
    for (size_t i = 0; i < STORAGE_COUNT; i++) {
        mt_storage row = storage_of(view, i);
        uint64_t bytes = mt_storage_bytes(view->mesh, &row);
        printf("  %-18s  %-19s %15s numbers %12s", row.words, row.formula,
               cli_count((int64_t)mt_storage_units(&row)).text, cli_bytes(bytes).text);
        if (triangles > 0) {
            printf("  %6.1f bytes a triangle", (double)bytes / triangles);
        }
        putchar('\n');
    }
}

static void print_text(const cli_job *job, const topology_view *view)
{
    mt_index boundary = view->kind->boundary_count(view->structure);
    printf("%s: %s of %s, %s and %s", job->operands[0], view->kind->name,
           cli_counted(view->mesh->vertex_count, "vertex").text,
           cli_counted(view->kind->edge_count(view->structure), "edge").text,
           cli_counted(view->mesh->face_count, "face").text);
    printf(boundary ? ", %s on the boundary\n" : ", closed\n", cli_counted(boundary, "edge").text);
    if (view->sources) {
        printf("%s added by splitting\n",
               cli_counted(view->mesh->vertex_count - view->file_vertex_count, "vertex").text);
    }
    printf("It holds %s, for", cli_bytes(view->kind->size(view->structure)).text);
    for (size_t i = 0; i < CLI_CONNECTIVITY_TABLES && view->kind->tables[i].key; i++) {
        printf("%s each %s %u bytes", i ? "," : "", view->kind->tables[i].element, view->kind->tables[i].bytes);
    }
    putchar('\n');
    for (size_t i = 0; i < CLI_CONNECTIVITY_TABLES && view->kind->tables[i].key; i++) {
        print_text_table(view, &view->kind->tables[i]);
    }
    print_storage(view);
}

static cli_exit show(const cli_job *job, topology_view *view)
{
    const topology_settings *settings = job->settings;
    view->kind = &cli_connectivities[settings->structure];
    void *structure = NULL;
    if (!settings->split) {
        mt_part_skip(job->context, "split vertices", "--split-non-manifold was not asked for");
    }
    if (view->kind->create(job->context, view->mesh, &structure) != MT_OK) {
        return cli_report_failure(job, job->operands[0]);
    }
    view->structure = structure;
    if (job->common->json) {
        print_json(job, view);
    } else {
        print_text(job, view);
    }
    view->kind->destroy(job->context, structure);
    return CLI_EXIT_DONE;
}

static cli_exit split_and_show(const cli_job *job, const mt_mesh *mesh)
{
    mt_mesh *split = NULL;
    mt_index *sources = NULL;
    if (mt_split_non_manifold(job->context, mesh, &split, &sources) != MT_OK) {
        return cli_report_failure(job, job->operands[0]);
    }
    topology_view view = {.mesh = split, .sources = sources, .file_vertex_count = mesh->vertex_count};
    cli_exit code = show(job, &view);
    mt_free(job->context, sources);
    mt_mesh_destroy(job->context, split);
    return code;
}

static cli_exit run(const cli_job *job)
{
    const topology_settings *settings = job->settings;
    mt_mesh *mesh = NULL;
    const mt_mesh_format *format = NULL;
    cli_exit code = cli_check_inputs(job);
    if (code == CLI_EXIT_DONE) {
        code = cli_read_mesh(job, job->operands[0], &mesh, &format);
    }
    if (code == CLI_EXIT_DONE) {
        topology_view view = {.mesh = mesh, .file_vertex_count = mesh->vertex_count};
        code = settings->split ? split_and_show(job, mesh) : show(job, &view);
    }
    mt_mesh_destroy(job->context, mesh);
    return code;
}

const cli_command cli_topology_command = {
    .name = "topology",
    .usage = "IN",
    .summary = "Show a mesh's connectivity as tables",
    .description =
        "Builds one of the three connectivity structures and prints its tables, the first rows of each, or with --json "
        "all; and what each structure takes beside separate triangles and an indexed mesh, counted in numbers "
        "(n_v vertices, n_t triangles, n_e edges, n_f faces) and in bytes. Triangle neighbors are given twice: n0 to "
        "n2 are the triangles across the sides, corner0 to corner2 are 3 * triangle + side. A mesh that is not "
        "manifold and oriented is refused with its first defect.",
    .examples = "  meshtool topology cow.obj --structure winged-edge\n"
                "  meshtool topology scan.ply --split-non-manifold --json\n",
    .options = options,
    .groups = CLI_GROUP_READ | CLI_GROUP_PRECISION | CLI_GROUP_WORK | CLI_GROUP_EVERY,
    .settings_size = sizeof(topology_settings),
    .operand_minimum = 1,
    .operand_maximum = 1,
    .run = run,
};
