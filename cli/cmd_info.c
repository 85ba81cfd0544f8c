/* meshtool info: counts, bounds, what a mesh carries, and what it takes in memory, by formula. */
#include "files.h"
#include "line.h"
#include "progress.h"
#include "quantity.h"
#include "sizes.h"

#include <inttypes.h>

typedef struct info_settings {
    cli_common common;
    bool measure;
} info_settings;

static const cli_option options[] = {
    {.name = "measure",
     .offset = offsetof(info_settings, measure),
     .help = "also build each structure and write each format, in memory, and show what they really take"},
    {0},
};

static uint64_t triangle_count(const mt_mesh *mesh)
{
    return (uint64_t)mesh->corner_count - 2 * (uint64_t)mesh->face_count;
}

static const char *type_name(mt_type type)
{
    static const char *const names[] = {"u8", "i8", "u16", "i16", "u32", "i32", "f32", "f64"};
    return names[type];
}

static const char *semantic_name(mt_semantic semantic)
{
    static const char *const names[] = {"generic", "normal", "uv", "color"};
    return names[semantic];
}

static const char *domain_name(mt_domain domain)
{
    static const char *const names[] = {"mesh", "vertex", "corner", "face"};
    return names[domain];
}

/* What the mesh carries beside positions and faces, as one list for text and JSON. */
typedef struct info_part {
    const char *name, *semantic, *domain, *type;
    uint32_t components;
    uint64_t count;
    bool indexed;
} info_part;

typedef void (*part_visitor)(void *user, const info_part *part);

static void visit_parts(const mt_mesh *mesh, part_visitor visit, void *user)
{
    for (mt_index i = 0; i < mesh->attribute_count; i++) {
        const mt_attribute *a = &mesh->attributes[i];
        visit(user, &(info_part){a->name, semantic_name(a->semantic), domain_name(a->domain), type_name(a->type),
                                 a->component_count, a->value_count, a->indices != NULL});
    }
    for (mt_index i = 0; i < mesh->label_set_count; i++) {
        const mt_labels *labels = &mesh->label_sets[i];
        visit(user,
              &(info_part){mt_label_kind_name(labels->kind), "label", "face", "text", 1, labels->name_count, true});
    }
    if (mesh->crease_count) {
        visit(user, &(info_part){"crease", "crease", "edge", "f64", 1, mesh->crease_count, true});
    }
    if (mesh->sharp_vertex_count) {
        visit(user, &(info_part){"corner", "crease", "vertex", "f64", 1, mesh->sharp_vertex_count, true});
    }
    if (mesh->wire_count) {
        visit(user, &(info_part){"wires", "element", "mesh", "u32", 1, mesh->wire_count, true});
    }
    if (mesh->point_count) {
        visit(user, &(info_part){"points", "element", "mesh", "u32", 1, mesh->point_count, true});
    }
}

static void add_part_json(void *array, const info_part *part)
{
    json_t *object = cli_json_object();
    cli_json_set(object, "name", cli_json_text(part->name));
    cli_json_set(object, "semantic", cli_json_text(part->semantic));
    cli_json_set(object, "domain", cli_json_text(part->domain));
    cli_json_set(object, "type", cli_json_text(part->type));
    cli_json_set(object, "components", cli_json_integer(part->components));
    cli_json_set(object, "count", cli_json_integer((int64_t)part->count));
    cli_json_set(object, "indexed", json_boolean(part->indexed));
    cli_json_append(array, object);
}

static json_t *point_json(mt_vec3 point)
{
    json_t *array = cli_json_array();
    cli_json_append(array, cli_json_real(point.x));
    cli_json_append(array, cli_json_real(point.y));
    cli_json_append(array, cli_json_real(point.z));
    return array;
}

/* null when no vertex is finite. */
static json_t *bounds_json(const mt_mesh *mesh)
{
    mt_bounds bounds = mt_mesh_bounds(mesh);
    if (bounds.finite_count == 0) {
        return json_null();
    }
    json_t *object = cli_json_object();
    cli_json_set(object, "minimum", point_json(bounds.minimum));
    cli_json_set(object, "maximum", point_json(bounds.maximum));
    return object;
}

static void print_json(const char *file, const mt_mesh_format *format, const mt_mesh *mesh, const cli_sizes *sizes)
{
    json_t *object = cli_json_object(), *attributes = cli_json_array();
    visit_parts(mesh, add_part_json, attributes);
    cli_json_set(object, "file", cli_json_text(file));
    cli_json_set(object, "format", cli_json_text(format->name));
    cli_json_set(object, "vertices", cli_json_integer(mesh->vertex_count));
    cli_json_set(object, "faces", cli_json_integer(mesh->face_count));
    cli_json_set(object, "triangles", cli_json_integer((int64_t)triangle_count(mesh)));
    cli_json_set(object, "bounds", bounds_json(mesh));
    cli_json_set(object, "attributes", attributes);
    cli_json_set(object, "sizes", cli_sizes_json(sizes));
    cli_json_print_line(object);
    json_decref(object);
}

static void print_part(void *user, const info_part *part)
{
    (void)user;
    printf("  %s per %s", part->semantic, part->domain);
    if (*part->name) {
        printf(" \"%s\"", part->name);
    }
    printf(": %s", cli_counted(part->count, "value").text);
    if (part->components > 1) {
        printf(" of %" PRIu32 " %s", part->components, part->type);
    } else {
        printf(" of %s", part->type);
    }
    puts(part->indexed ? ", indexed" : "");
}

static void print_label_names(const mt_labels *labels)
{
    cli_line line = {0};
    for (mt_index i = 0; i < labels->name_count && i < 6; i++) {
        cli_line_add(&line, "%s%.40s", i ? ", " : "", *labels->names[i] ? labels->names[i] : "(no name)");
    }
    if (labels->name_count > 6) {
        cli_line_add(&line, " and %s more", cli_count(labels->name_count - 6).text);
    }
    printf("  %-16s %s: %s\n", mt_label_kind_name(labels->kind), cli_counted(labels->name_count, "name").text,
           line.text);
}

static void print_faces(const mt_mesh *mesh)
{
    mt_index most = 0, least = MT_NONE;
    for (mt_index f = 0; f < mesh->face_count; f++) {
        mt_index sides = mt_mesh_face_sides(mesh, f);
        most = sides > most ? sides : most;
        least = sides < least ? sides : least;
    }
    printf("%s, %s", cli_counted(mesh->vertex_count, "vertex").text, cli_counted(mesh->face_count, "face").text);
    if (mesh->face_count && least == most) {
        printf(most == 3 ? ", all triangles" : most == 4 ? ", all quads" : ", all of %u sides", most);
    } else if (mesh->face_count) {
        printf(" of %u to %u sides", least, most);
    }
    if (triangle_count(mesh) != mesh->face_count) {
        printf(" (%s)", cli_counted(triangle_count(mesh), "triangle").text);
    }
    printf("; positions in %s\n", mesh->position_type == MT_F64 ? "double precision" : "single precision");
}

static void print_bounds(const mt_mesh *mesh)
{
    mt_bounds bounds = mt_mesh_bounds(mesh);
    if (bounds.finite_count == 0) {
        puts("no vertex has finite coordinates");
        return;
    }
    mt_vec3 size = mt_vec3_subtract(bounds.maximum, bounds.minimum);
    printf("from %s to %s, size %s x %s x %s\n", cli_point(bounds.minimum).text, cli_point(bounds.maximum).text,
           cli_real(size.x).text, cli_real(size.y).text, cli_real(size.z).text);
    if (bounds.non_finite_count) {
        printf("%s with NaN or infinite coordinates\n", cli_counted(bounds.non_finite_count, "vertex").text);
    }
}

static void print_text(const char *file, const mt_mesh_format *format, const mt_mesh *mesh, const cli_sizes *sizes)
{
    printf("%s: %s%s\n", file, format->title, mesh->welded ? ", corners welded where equal" : "");
    print_faces(mesh);
    print_bounds(mesh);
    if (mesh->wire_count || mesh->point_count) {
        printf("%s, %s beside the faces\n", cli_counted(mesh->wire_count, "wire").text,
               cli_counted(mesh->point_count, "point").text);
    }
    if (mesh->attribute_count) {
        puts("Attributes:");
    }
    mt_mesh plain = *mesh; /* its attributes alone: the rest has lines of its own */
    plain.label_set_count = plain.crease_count = plain.sharp_vertex_count = plain.wire_count = plain.point_count = 0;
    visit_parts(&plain, print_part, NULL);
    if (mesh->label_set_count) {
        puts("Labels:");
    }
    for (mt_index i = 0; i < mesh->label_set_count; i++) {
        print_label_names(&mesh->label_sets[i]);
    }
    if (mesh->crease_count || mesh->sharp_vertex_count) {
        printf("Creases: %s, %s\n", cli_counted(mesh->crease_count, "sharp edge").text,
               cli_counted(mesh->sharp_vertex_count, "sharp vertex").text);
    }
    cli_sizes_print(sizes);
}

static cli_exit show(const cli_job *job, const char *file)
{
    mt_mesh *mesh = NULL;
    const mt_mesh_format *format = NULL;
    cli_exit code = cli_read_mesh(job, file, &mesh, &format);
    if (code != CLI_EXIT_DONE) {
        return code;
    }
    cli_sizes sizes;
    bool measures = ((const info_settings *)job->settings)->measure;
    if (!measures) {
        mt_part_skip(job->context, "connectivity", "sizes go by formulas; --measure builds each structure");
    }
    code = cli_sizes_find(job, file, mesh, measures, &sizes);
    if (code == CLI_EXIT_DONE && job->common->json) {
        print_json(file, format, mesh, &sizes);
    } else if (code == CLI_EXIT_DONE) {
        cli_progress_clear();
        fputs(file == job->operands[0] ? "" : "\n", stdout);
        print_text(file, format, mesh, &sizes);
    }
    mt_mesh_destroy(job->context, mesh);
    return code;
}

static cli_exit run(const cli_job *job)
{
    cli_exit code = cli_check_inputs(job);
    return code == CLI_EXIT_DONE ? cli_for_each_file(job, show) : code;
}

const cli_command cli_info_command = {
    .name = "info",
    .usage = "FILE...",
    .summary = "Show counts, bounds, attributes and sizes of meshes",
    .description = "Sizes are of positions and faces, by formula: separate triangles take 9 numbers a triangle, an "
                   "indexed mesh 3 a vertex and 3 a triangle; coordinates have the mesh's precision, indices 4 bytes. "
                   "Strips are told as if one sufficed, fans as if each had six triangles, restarts counted. Edges are "
                   "half the corners, as in a closed mesh; structures of triangles take those that n-gons are cut "
                   "into. Nothing is built for it. Formats are without their headers, and text without a formula. "
                   "With --measure all are built, strips as `meshtool strips` makes them.",
    .examples = "  meshtool info cow.obj\n"
                "  meshtool info *.ply --json\n"
                "  meshtool info cow.obj --measure\n",
    .options = options,
    .groups = CLI_GROUP_READ | CLI_GROUP_PRECISION | CLI_GROUP_WORK | CLI_GROUP_EVERY,
    .settings_size = sizeof(info_settings),
    .operand_minimum = 1,
    .operand_maximum = SIZE_MAX,
    .run = run,
};
