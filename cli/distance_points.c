/* distance MESH --points FILE: the nearest point of the mesh for each point of a file. */
#include "distance.h"
#include "json.h"
#include "message.h"
#include "quantity.h"

#include <meshtool/signed_distance.h>

#define BLOCK_SIZE 1024

/* How to ask: through a tree, or with a sign. */
typedef struct point_search {
    const mt_mesh *points;
    mt_triangulation triangulation;
    mt_surface_tree *tree;
    mt_signed_distance *signed_distance;
    mt_closest *nearest; /* per point; distances signed where asked for */
} point_search;

static void search_points(void *user, uint64_t begin, uint64_t end)
{
    point_search *search = user;
    for (uint64_t i = begin; i < end; i++) {
        mt_vec3 point = mt_mesh_position(search->points, (mt_index)i);
        mt_closest *nearest = &search->nearest[i];
        if (search->signed_distance) {
            nearest->distance = mt_signed_distance_at(search->signed_distance, point, nearest);
        } else if (!mt_surface_tree_closest(search->tree, point, NULL, nearest)) {
            nearest->distance = NAN;
        }
    }
}

static mt_status prepare(const cli_job *job, const mt_mesh *mesh, point_search *search)
{
    const cli_distance_settings *settings = job->settings;
    search->nearest = mt_allocate_array(job->context, search->points->vertex_count, sizeof *search->nearest);
    mt_status status = search->nearest ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
    if (status == MT_OK) {
        status = mt_triangulation_init(job->context, mesh, &search->triangulation);
    }
    if (status != MT_OK) {
        return status;
    }
    if (settings->is_signed) {
        return mt_signed_distance_create(job->context, mesh, &search->signed_distance);
    }
    mt_surface_tree_options options = {.elements = MT_SURFACE_TRIANGLES | MT_SURFACE_WIRES | MT_SURFACE_POINTS};
    if (!mesh->face_count && !mesh->wire_count && !mesh->point_count) {
        options.elements = MT_SURFACE_VERTICES;
    }
    return mt_surface_tree_create(job->context, mesh, &search->triangulation, &options, &search->tree);
}

static json_t *point_json(mt_vec3 p)
{
    json_t *array = cli_json_array();
    cli_json_append(array, cli_json_real(p.x));
    cli_json_append(array, cli_json_real(p.y));
    cli_json_append(array, cli_json_real(p.z));
    return array;
}

static bool is_on_face(const point_search *search, const mt_closest *nearest)
{
    return nearest->element < search->triangulation.triangle_count;
}

static void print_json(const cli_job *job, const point_search *search)
{
    json_t *object = cli_json_object(), *list = cli_json_array();
    cli_json_set(object, "file", cli_json_text(job->operands[0]));
    for (mt_index i = 0; i < search->points->vertex_count; i++) {
        const mt_closest *nearest = &search->nearest[i];
        json_t *item = cli_json_object();
        cli_json_set(item, "distance", cli_json_real(nearest->distance));
        cli_json_set(item, "nearest", nearest->element == MT_NONE ? json_null() : point_json(nearest->point));
        cli_json_set(item, "face",
                     is_on_face(search, nearest)
                         ? cli_json_integer(mt_triangulation_face(&search->triangulation, nearest->element))
                         : json_null());
        cli_json_append(list, item);
    }
    cli_json_set(object, "points", list);
    cli_json_print_line(object);
    json_decref(object);
}

static void print_text(const point_search *search)
{
    puts("# distance, nearest x y z, face");
    for (mt_index i = 0; i < search->points->vertex_count; i++) {
        const mt_closest *nearest = &search->nearest[i];
        printf("%.17g %.17g %.17g %.17g ", nearest->distance, nearest->point.x, nearest->point.y, nearest->point.z);
        if (is_on_face(search, nearest)) {
            printf("%u\n", mt_triangulation_face(&search->triangulation, nearest->element));
        } else {
            puts("-");
        }
    }
}

cli_exit cli_distance_points(const cli_job *job, const mt_mesh *mesh, const mt_mesh *points)
{
    point_search search = {.points = points};
    cli_exit code = CLI_EXIT_DONE;
    if (prepare(job, mesh, &search) != MT_OK) {
        code = cli_report_failure(job, job->operands[0]);
    } else {
        mt_parallel_for(job->context, points->vertex_count, BLOCK_SIZE, search_points, &search);
        if (job->common->json) {
            print_json(job, &search);
        } else if (!job->common->quiet) {
            print_text(&search);
        }
    }
    mt_signed_distance_destroy(job->context, search.signed_distance);
    mt_surface_tree_destroy(job->context, search.tree);
    mt_triangulation_release(job->context, &search.triangulation);
    mt_free(job->context, search.nearest);
    return code;
}
