/* Every structure for rays on the meshes of meshes/valid, the corpus and the extremes: 10,000 rays a mesh, or as many
 * as MESHTOOL_RAYS says. Every ray asks all structures, nearest hit and any hit, and their answers are compared bit by
 * bit; brute force is asked for as many of them as stay below a number of triangles, at least one. Where that is not
 * every ray, the line of the mesh says of how many. */
#include "tests/support/unit.h"

#include "tests/support/ray_meshes.h"
#include "tests/support/soup.h"
#include "tests/support/structures.h"

#include <meshtool/generate.h>
#include <meshtool/mesh_format.h>

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define DEFAULT_RAYS 10000

/* Triangles that brute force asks on a mesh, for each ray that is shot. */
#define TRIANGLES_A_RAY 200

static uint64_t rays_a_mesh(void)
{
    const char *text = getenv("MESHTOOL_RAYS");
    return text ? strtoull(text, NULL, 10) : test_ray_count(DEFAULT_RAYS);
}

/* Takes the mesh over. */
static void check_with(mt_context *context, mt_mesh *mesh, const char *name, uint64_t count)
{
    test_structures structures;
    test_structures_init(&structures, context, mesh, MT_RAY_WATERTIGHT);
    uint64_t triangles = structures.target.triangulation.triangle_count;
    uint64_t work = count * triangles, bearable = rays_a_mesh() * TRIANGLES_A_RAY;
    uint64_t step = work <= bearable ? 1 : work / bearable | 1;
    print_message("%s: %llu triangles, %llu rays, %llu of them by brute force\n", name, (unsigned long long)triangles,
                  (unsigned long long)count, (unsigned long long)((count + step - 1) / step));
    test_structures_agree_by_samples(&structures, name, count, triangles, step);
    test_structures_end(&structures);
}

static void check(mt_context *context, mt_mesh *mesh, const char *name)
{
    check_with(context, mesh, name, rays_a_mesh());
}

static void check_file(mt_context *context, const char *path)
{
    mt_mesh *mesh = NULL;
    if (mt_mesh_read_file(context, path, NULL, &mesh, NULL) != MT_OK) {
        fail_msg("%s: %s", path, mt_context_error(context)->message);
    }
    check(context, mesh, path);
}

/* Those of the folder, but for what no mesh is. */
static void check_folder(const char *folder)
{
    DIR *directory = opendir(folder);
    if (!directory) {
        print_message("skipped: no %s\n", folder);
        return;
    }
    mt_context *context = test_context();
    for (struct dirent *entry; (entry = readdir(directory));) {
        const char *dot = strrchr(entry->d_name, '.');
        if (dot && dot != entry->d_name && mt_mesh_format_by_extension(dot + 1)) {
            char path[512];
            snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
            check_file(context, path);
        }
    }
    closedir(directory);
    test_context_end(context);
}

static void meshes_of_the_project(void **state)
{
    (void)state;
    check_folder("meshes/valid");
    check_folder("meshes/non_manifold");
}

static void the_corpus(void **state)
{
    (void)state;
    check_folder("../shared/corpus");
}

static mt_mesh *many_equal_triangles(mt_context *context)
{
    return test_equal_triangles(context, 1000);
}

static mt_mesh *geometric_series(mt_context *context)
{
    return test_geometric_series(context, 1000);
}

/* Flat boxes, equal centroids, a teapot in a stadium, far off, tiny, huge, slivers. */
static void extremes(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        mt_mesh *(*make)(mt_context *context);
    } rows[] = {
        {"slivers", test_slivers},
        {"flat duplicates", test_flat_duplicates},
        {"slanted plane", test_slanted_plane},
        {"two scales", test_two_scales},
        {"far torus", test_far_torus},
        {"tiny torus", test_tiny_torus},
        {"huge torus", test_huge_torus},
        {"equal triangles", many_equal_triangles},
        {"geometric series", geometric_series},
    };
    mt_context *context = test_context();
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        check(context, rows[i].make(context), rows[i].name);
    }
    test_context_end(context);
}

static void generated_extremes(void **state)
{
    (void)state;
    mt_context *context = test_context();
    const mt_generate_options defaults = {.resolution = 0};
    static const char *const names[] = {"extreme:stadium",    "extreme:sliver", "extreme:grazing",
                                        "extreme:offset",     "extreme:flat",   "extreme:centroids",
                                        "extreme:duplicates", "extreme:walls",  "extreme:nearly-flat",
                                        "extreme:specks",     "extreme:scale"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        mt_mesh *mesh = NULL;
        if (mt_generate(context, names[i], &defaults, &mesh) != MT_OK) {
            fail_msg("%s: %s", names[i], mt_context_error(context)->message);
        }
        check(context, mesh, names[i]);
    }
    test_context_end(context);
}

/* A million triangles around a vertex, when many rays are asked for; a thousandth of them otherwise. Every box about
 * the vertex is a candidate of every ray that comes near, a million a ray, so that a thousandth of the rays is shot. */
static void a_vertex_in_a_million_faces(void **state)
{
    (void)state;
    mt_context *context = test_context();
    bool is_large = rays_a_mesh() > DEFAULT_RAYS;
    mt_mesh *fan = test_fan(context, is_large ? 1000000 : 1000, true);
    check_with(context, fan, "fan", is_large ? rays_a_mesh() / 1000 : rays_a_mesh());
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(meshes_of_the_project),
        cmocka_unit_test(the_corpus),
        cmocka_unit_test(extremes),
        cmocka_unit_test(generated_extremes),
        cmocka_unit_test(a_vertex_in_a_million_faces),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
