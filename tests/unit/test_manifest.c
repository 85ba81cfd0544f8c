/* Every mesh of meshes/ against what its manifest says: the good and the non-manifold ones by a census, the malformed
 * ones by whether, why and where they are refused. */
#include "tests/support/census.h"
#include "tests/support/csv.h"
#include "tests/support/reading.h"
#include "tests/support/unit.h"

#include <meshtool/manifold.h>

#include <dirent.h>
#include <stdio.h>
#include <string.h>

/* Collects what is wrong with the rows, so that one run tells of all. */
static size_t complaints;

static void expect_number(const test_csv *table, size_t row, const char *column, int64_t found)
{
    int64_t expected;
    if (test_csv_number(table, row, column, &expected) && expected != found) {
        print_error("%s: %s is %lld, expected %lld\n", test_csv_cell(table, row, "file"), column, (long long)found,
                    (long long)expected);
        complaints++;
    }
}

static const char *class_of(const test_census *census)
{
    if (census->non_manifold_edges || census->non_manifold_vertices || census->degenerate_faces) {
        return "non-manifold";
    }
    return census->boundary_edges || census->faces == 0 ? "manifold-with-boundary" : "manifold";
}

static void expect_defects(const test_csv *table, size_t row, const mt_manifold_report *report, mt_defect_kind kind,
                           size_t expected)
{
    if (report->defect_counts[kind] != expected) {
        print_error("%s: %s is %u by the check, %zu by the census\n", test_csv_cell(table, row, "file"),
                    mt_defect_key(kind), report->defect_counts[kind], expected);
        complaints++;
    }
}

/* The check counts what the census counts. */
static void check_report(const test_csv *table, size_t row, mt_context *context, const mt_mesh *mesh,
                         const test_census *census)
{
    static const char *const classes[] = {"manifold", "manifold-with-boundary", "non-manifold"};
    mt_manifold_report report;
    assert_int_equal(mt_check_manifold(context, mesh, NULL, &report), MT_OK);
    expect_number(table, row, "edges", report.edge_count);
    expect_number(table, row, "euler_characteristic", report.euler_characteristic);
    expect_number(table, row, "components", report.component_count);
    expect_number(table, row, "boundary_loops", report.boundary_loop_count);
    assert_string_equal(classes[report.manifold_class], class_of(census));
    expect_defects(table, row, &report, MT_DEFECT_BOUNDARY_EDGE, census->boundary_edges);
    expect_defects(table, row, &report, MT_DEFECT_NON_MANIFOLD_EDGE, census->non_manifold_edges);
    expect_defects(table, row, &report, MT_DEFECT_MISORIENTED_EDGE, census->misoriented_edges);
    expect_defects(table, row, &report, MT_DEFECT_NON_MANIFOLD_VERTEX, census->non_manifold_vertices);
    expect_defects(table, row, &report, MT_DEFECT_DEGENERATE_FACE, census->degenerate_faces);
    expect_defects(table, row, &report, MT_DEFECT_ISOLATED_VERTEX, census->isolated_vertices);
    mt_manifold_report_release(context, &report);
}

static void path_of(const char *folder, const test_csv *table, size_t row, char path[512])
{
    snprintf(path, 512, "%s/%s", folder, test_csv_cell(table, row, "file"));
}

static void check_mesh_row(const test_csv *table, size_t row)
{
    char path[512];
    path_of("meshes", table, row, path);
    test_reading reading;
    test_reading_begin(&reading);
    mt_mesh *mesh = NULL;
    mt_status status = mt_mesh_read_file(reading.context, path, NULL, &mesh, NULL);
    if (status != MT_OK) {
        fail_msg("%s", mt_context_error(reading.context)->message);
    }
    test_warned(&reading, NULL);
    test_census census = test_census_of(mesh);
    expect_number(table, row, "vertices", (int64_t)census.vertices);
    expect_number(table, row, "faces", (int64_t)census.faces);
    expect_number(table, row, "edges", (int64_t)census.edges);
    expect_number(table, row, "euler_characteristic", census.euler_characteristic);
    expect_number(table, row, "components", (int64_t)census.components);
    expect_number(table, row, "boundary_loops", (int64_t)census.boundary_loops);
    if (strcmp(class_of(&census), test_csv_cell(table, row, "class")) != 0) {
        print_error("%s: is %s\n", path, class_of(&census));
        complaints++;
    }
    check_report(table, row, reading.context, mesh, &census);
    mt_mesh_destroy(reading.context, mesh);
    test_reading_end(&reading);
}

static void test_meshes_are_what_the_manifest_says(void **state)
{
    (void)state;
    test_csv table = test_csv_read("meshes/manifest.csv");
    complaints = 0;
    assert_true(table.row_count > 20);
    for (size_t row = 0; row < table.row_count; row++) {
        check_mesh_row(&table, row);
    }
    assert_int_equal(complaints, 0);
    test_csv_release(&table);
}

static void complain_unless(bool good, const char *path, const char *what, const char *message)
{
    if (!good) {
        print_error("%s: expected %s; %s\n", path, what, *message ? message : "nothing was said");
        complaints++;
    }
}

static void check_refusal(const test_csv *table, size_t row, const char *path, const mt_error *error)
{
    int64_t number;
    bool is_bad_input = error->status == MT_ERROR_SYNTAX || error->status == MT_ERROR_UNSUPPORTED ||
                        error->status == MT_ERROR_INVALID_MESH || error->status == MT_ERROR_TOO_LARGE;
    complain_unless(is_bad_input, path, "a status of bad input", error->message);
    complain_unless(strstr(error->message, path) != NULL, path, "the file's name", error->message);
    if (test_csv_number(table, row, "line", &number)) {
        complain_unless(error->place.line == (uint64_t)number, path, "another line", error->message);
    }
    if (test_csv_number(table, row, "offset", &number)) {
        complain_unless(error->place.has_offset && error->place.offset == (uint64_t)number, path, "another offset",
                        error->message);
    }
}

static void check_malformed_row(const test_csv *table, size_t row)
{
    char path[512];
    path_of("meshes/malformed", table, row, path);
    const char *outcome = test_csv_cell(table, row, "outcome"), *part = test_csv_cell(table, row, "message");
    bool refused = strcmp(outcome, "refused") == 0, warned = strcmp(outcome, "warned") == 0;
    test_reading reading;
    test_reading_begin(&reading);
    mt_mesh *mesh = NULL;
    mt_status status = mt_mesh_read_file(reading.context, path, NULL, &mesh, NULL);
    const mt_error *error = mt_context_error(reading.context);
    complain_unless((status != MT_OK) == refused, path, outcome, error->message);
    if (status != MT_OK) {
        complain_unless(!mesh && mt_context_bytes(reading.context) == 0, path, "no memory kept", error->message);
        complain_unless(strstr(error->message, part) != NULL, path, part, error->message);
        check_refusal(table, row, path, error);
    } else {
        assert_int_equal(mt_mesh_validate(reading.context, mesh), MT_OK);
        complain_unless((reading.warnings[0] != '\0') == warned, path, outcome, reading.warnings);
        complain_unless(!warned || strstr(reading.warnings, part), path, part, reading.warnings);
        expect_number(table, row, "vertices", mesh->vertex_count);
        expect_number(table, row, "faces", mesh->face_count);
    }
    mt_mesh_destroy(reading.context, mesh);
    test_reading_end(&reading);
}

static void test_malformed_files_are_refused_by_name(void **state)
{
    (void)state;
    test_csv table = test_csv_read("meshes/malformed/manifest.csv");
    complaints = 0;
    assert_true(table.row_count > 90);
    for (size_t row = 0; row < table.row_count; row++) {
        check_malformed_row(&table, row);
    }
    assert_int_equal(complaints, 0);
    test_csv_release(&table);
}

static void check_folder_is_listed(const test_csv *table, const char *root, const char *folder)
{
    char path[512];
    snprintf(path, sizeof path, "%s/%s", root, folder);
    DIR *directory = opendir(path);
    assert_non_null(directory);
    for (const struct dirent *entry = readdir(directory); entry; entry = readdir(directory)) {
        snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        bool listed = entry->d_name[0] == '.';
        for (size_t row = 0; row < table->row_count && !listed; row++) {
            listed = strcmp(test_csv_cell(table, row, "file"), path) == 0;
        }
        complain_unless(listed, path, "a row in the manifest", "");
    }
    closedir(directory);
}

static void test_every_file_has_a_row(void **state)
{
    (void)state;
    complaints = 0;
    test_csv table = test_csv_read("meshes/manifest.csv");
    check_folder_is_listed(&table, "meshes", "valid");
    check_folder_is_listed(&table, "meshes", "non_manifold");
    test_csv_release(&table);
    table = test_csv_read("meshes/malformed/manifest.csv");
    for (const mt_mesh_format *const *format = mt_mesh_formats(); *format; format++) {
        check_folder_is_listed(&table, "meshes/malformed", (*format)->name);
    }
    assert_int_equal(complaints, 0);
    test_csv_release(&table);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_meshes_are_what_the_manifest_says),
        cmocka_unit_test(test_malformed_files_are_refused_by_name),
        cmocka_unit_test(test_every_file_has_a_row),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
