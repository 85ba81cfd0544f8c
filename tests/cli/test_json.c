/* JSON of each command: it parses, and has exactly the keys of the contract, in its order. */
#include "tests/support/unit.h"

#include <jansson.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char folder[256];

/* Runs "meshtool ARGUMENTS" in the folder; the whole of standard output, malloc'ed. */
static char *run(const char *arguments, int *code)
{
    char command[2048];
    snprintf(command, sizeof command, "cd %s && \"$MESHTOOL\" %s 2>/dev/null", folder, arguments);
    FILE *pipe = popen(command, "r");
    assert_non_null(pipe);
    size_t size = 0, capacity = 1 << 20;
    char *text = malloc(capacity);
    assert_non_null(text);
    size = fread(text, 1, capacity - 1, pipe);
    text[size] = '\0';
    int status = pclose(pipe);
    *code = status >> 8;
    return text;
}

static json_t *run_json(const char *arguments, int expected_code)
{
    int code = 0;
    char *text = run(arguments, &code);
    json_error_t error;
    json_t *value = json_loads(text, JSON_REJECT_DUPLICATES, &error);
    if (!value || code != expected_code) {
        print_error("meshtool %s: exit %d, %s\n%s\n", arguments, code, error.text, text);
    }
    assert_int_equal(code, expected_code);
    assert_non_null(value);
    const char *end = strchr(text, '\n');
    assert_true(end && end[1] == '\0');
    free(text);
    return value;
}

static void assert_keys(json_t *object, const char *const *keys)
{
    assert_true(json_is_object(object));
    const char *key = NULL;
    json_t *value = NULL;
    json_object_foreach(object, key, value)
    {
        if (!*keys) {
            fail_msg("the key %s is one too many", key);
        }
        assert_string_equal(key, *keys++);
    }
    if (*keys) {
        fail_msg("the key %s is missing", *keys);
    }
}

static void write_file(const char *name, const char *text)
{
    char path[512];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static int make_folder(void **state)
{
    (void)state;
    const char *place = getenv("TMPDIR");
    snprintf(folder, sizeof folder, "%s/meshtool-json-XXXXXX", place ? place : P_tmpdir);
    if (!mkdtemp(folder)) {
        return -1;
    }
    write_file("triangle.off", "OFF\n3 1 0\n0 0 0\n0.1 0 0\n0 1e-310 0\n3 0 1 2\n");
    write_file("bowtie.off", "OFF\n5 2 0\n0 0 0\n1 0 0\n1 1 0\n-1 0 0\n-1 -1 0\n3 0 1 2\n3 0 3 4\n");
    write_file("book.off", "OFF\n5 3 0\n0 0 0\n0 0 1\n1 0 0\n0 1 0\n-1 -1 0\n3 0 1 2\n3 0 1 3\n3 0 1 4\n");
    write_file("nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n");
    write_file("inside.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 2 3\n3 0 3 1\n3 1 3 2\n");
    return 0;
}

static int remove_folder(void **state)
{
    (void)state;
    char command[512];
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return system(command);
}

static void self_intersections_are_counted_and_listed_when_asked_for(void **state)
{
    (void)state;
    write_file("through.off", "OFF\n6 2 0\n0 0 0\n4 0 0\n0 4 0\n1 1 -1\n1 1 1\n5 5 1\n3 0 1 2\n3 3 4 5\n");
    json_t *object = run_json("check-manifold through.off --json --self-intersections", 0);
    assert_int_equal(json_integer_value(json_object_get(object, "self_intersections")), 1);
    json_t *defect = json_array_get(json_object_get(object, "defects"), 0);
    assert_string_equal(json_string_value(json_object_get(defect, "kind")), "self_intersections");
    json_t *faces = json_object_get(defect, "faces");
    assert_int_equal(json_array_size(faces), 2);
    assert_int_equal(json_integer_value(json_array_get(faces, 0)), 0);
    assert_int_equal(json_integer_value(json_array_get(faces, 1)), 1);
    json_decref(object);
    object = run_json("check-manifold through.off --json --watertight", 1);
    assert_int_equal(json_integer_value(json_object_get(object, "self_intersections")), 1);
    json_decref(object);
    object = run_json("check-manifold bowtie.off --json --self-intersections", 1);
    assert_true(json_is_integer(json_object_get(object, "self_intersections")));
    assert_int_equal(json_integer_value(json_object_get(object, "self_intersections")), 0);
    json_decref(object);
}

/* 15 triangles through one line intersect each with each: 105 pairs, of which 100 are listed unless all are wanted. */
static void a_hundred_self_intersections_are_listed(void **state)
{
    (void)state;
    char text[4096] = "OFF\n45 15 0\n";
    for (int i = 0; i < 15; i++) {
        sprintf(text + strlen(text), "-9 0 %d\n9 0 %d\n0 %d 0\n", 7 - i, i - 7, 1 + i);
    }
    for (int i = 0; i < 15; i++) {
        sprintf(text + strlen(text), "3 %d %d %d\n", 3 * i, 3 * i + 1, 3 * i + 2);
    }
    write_file("star.off", text);
    static const char *const calls[] = {"check-manifold star.off --json --self-intersections",
                                        "check-manifold star.off --json --self-intersections --all-defects"};
    for (size_t i = 0; i < 2; i++) {
        json_t *object = run_json(calls[i], 0);
        assert_int_equal(json_integer_value(json_object_get(object, "self_intersections")), 105);
        json_t *defects = json_object_get(object, "defects");
        size_t listed = 0;
        for (size_t d = 0; d < json_array_size(defects); d++) {
            const char *kind = json_string_value(json_object_get(json_array_get(defects, d), "kind"));
            listed += strcmp(kind, "self_intersections") == 0;
        }
        assert_int_equal(listed, i == 0 ? 100 : 105);
        json_decref(object);
    }
}

static void the_check_has_the_keys_of_the_contract(void **state)
{
    (void)state;
    static const char *const keys[] = {"file",
                                       "format",
                                       "welded",
                                       "vertices",
                                       "faces",
                                       "triangles",
                                       "corners",
                                       "edges",
                                       "boundary_edges",
                                       "non_manifold_edges",
                                       "misoriented_edges",
                                       "non_manifold_vertices",
                                       "isolated_vertices",
                                       "degenerate_faces",
                                       "zero_area_faces",
                                       "duplicate_faces",
                                       "non_finite_vertices",
                                       "components",
                                       "boundary_loops",
                                       "euler_characteristic",
                                       "class",
                                       "oriented",
                                       "orientable",
                                       "genus",
                                       "area",
                                       "volume",
                                       "self_intersections",
                                       "as_welded",
                                       "boundary_pinches",
                                       "inside_out_components",
                                       "defects",
                                       NULL};
    static const char *const defect_keys[] = {"kind", "vertices", "faces", NULL};
    json_t *object = run_json("check-manifold bowtie.off --json", 1);
    assert_keys(object, keys);
    assert_string_equal(json_string_value(json_object_get(object, "file")), "bowtie.off");
    assert_string_equal(json_string_value(json_object_get(object, "format")), "off");
    assert_string_equal(json_string_value(json_object_get(object, "class")), "non-manifold");
    assert_true(json_is_false(json_object_get(object, "welded")));
    assert_int_equal(json_integer_value(json_object_get(object, "edges")), 6);
    assert_int_equal(json_integer_value(json_object_get(object, "non_manifold_vertices")), 1);
    assert_true(json_is_null(json_object_get(object, "boundary_loops")));
    assert_true(json_is_null(json_object_get(object, "genus")));
    assert_true(json_is_null(json_object_get(object, "volume")));
    assert_true(json_is_null(json_object_get(object, "self_intersections")));
    json_t *welded = json_object_get(object, "as_welded");
    static const char *const welded_keys[] = {
        "class", "vertices", "boundary_edges", "non_manifold_edges", "non_manifold_vertices", NULL};
    assert_keys(welded, welded_keys);
    assert_string_equal(json_string_value(json_object_get(welded, "class")), "non-manifold");
    assert_int_equal(json_integer_value(json_object_get(welded, "vertices")), 5);
    assert_int_equal(json_integer_value(json_object_get(welded, "boundary_edges")), 6);
    assert_int_equal(json_integer_value(json_object_get(welded, "non_manifold_vertices")), 1);
    json_t *defects = json_object_get(object, "defects");
    bool found = false;
    for (size_t i = 0; i < json_array_size(defects); i++) {
        json_t *defect = json_array_get(defects, i);
        assert_keys(defect, defect_keys);
        const char *kind = json_string_value(json_object_get(defect, "kind"));
        assert_non_null(json_object_get(object, kind));
        if (strcmp(kind, "non_manifold_vertices") == 0) {
            found = true;
            assert_int_equal(json_integer_value(json_array_get(json_object_get(defect, "vertices"), 0)), 0);
        }
    }
    assert_true(found);
    json_decref(object);
}

static void answers_that_have_no_meaning_are_null(void **state)
{
    (void)state;
    json_t *object = run_json("check-manifold book.off --json", 1);
    assert_int_equal(json_integer_value(json_object_get(object, "non_manifold_edges")), 1);
    assert_true(json_is_null(json_object_get(object, "oriented")));
    assert_true(json_is_null(json_object_get(object, "orientable")));
    json_decref(object);
    object = run_json("check-manifold inside.off --json", 0);
    assert_string_equal(json_string_value(json_object_get(object, "class")), "manifold");
    assert_true(json_is_true(json_object_get(object, "oriented")));
    assert_true(json_real_value(json_object_get(object, "volume")) < 0);
    assert_int_equal(json_integer_value(json_object_get(object, "genus")), 0);
    json_decref(object);
}

/* --paint asks the library for all defects; JSON still lists the first 100 of each kind. */
static void defects_are_the_first_hundred_of_each_kind(void **state)
{
    (void)state;
    json_decref(run_json("generate grid --resolution 40 -o grid.ply --json", 0));
    static const char *const calls[] = {"check-manifold grid.ply --json",
                                        "check-manifold grid.ply --json --paint p.ply",
                                        "check-manifold grid.ply --json --all-defects"};
    for (size_t i = 0; i < 3; i++) {
        json_t *object = run_json(calls[i], 0);
        json_int_t boundary = json_integer_value(json_object_get(object, "boundary_edges"));
        assert_true(boundary > 100);
        assert_int_equal(json_array_size(json_object_get(object, "defects")), i < 2 ? 100 : boundary);
        json_decref(object);
    }
}

static void several_files_are_one_object_a_line(void **state)
{
    (void)state;
    int code = 0;
    char *text = run("check-manifold triangle.off none.off bowtie.off --json", &code);
    assert_int_equal(code, 7);
    size_t lines = 0;
    for (char *line = strtok(text, "\n"); line; line = strtok(NULL, "\n")) {
        json_t *object = json_loads(line, 0, NULL);
        assert_non_null(object);
        json_decref(object);
        lines++;
    }
    assert_int_equal(lines, 2);
    free(text);
}

static void numbers_read_back_and_are_shortest(void **state)
{
    (void)state;
    int code = 0;
    char *text = run("info triangle.off --json", &code);
    assert_non_null(strstr(text, "\"maximum\": [0.1, 1e-310, 0.0]"));
    json_t *object = json_loads(text, 0, NULL);
    assert_non_null(object);
    json_t *maximum = json_object_get(json_object_get(object, "bounds"), "maximum");
    assert_true(json_real_value(json_array_get(maximum, 0)) == 0.1);
    assert_true(json_real_value(json_array_get(maximum, 1)) == 1e-310);
    json_decref(object);
    free(text);
}

static void info_has_the_keys_of_the_contract(void **state)
{
    (void)state;
    static const char *const keys[] = {"file",   "format",     "vertices", "faces", "triangles",
                                       "bounds", "attributes", "sizes",    NULL};
    static const char *const size_keys[] = {"units", "bytes", NULL};
    json_t *object = run_json("info triangle.off --json", 0);
    assert_keys(object, keys);
    json_t *sizes = json_object_get(object, "sizes");
    json_t *separate = json_object_get(sizes, "separate_triangles"), *indexed = json_object_get(sizes, "indexed_mesh");
    assert_keys(separate, size_keys);
    assert_int_equal(json_integer_value(json_object_get(separate, "units")), 9);
    assert_int_equal(json_integer_value(json_object_get(separate, "bytes")), 72);
    assert_int_equal(json_integer_value(json_object_get(indexed, "units")), 12);
    assert_int_equal(json_integer_value(json_object_get(indexed, "bytes")), 84);
    json_decref(object);
}

static void what_is_not_finite_is_null(void **state)
{
    (void)state;
    write_file("none.obj", "v nan inf 0\n");
    json_t *object = run_json("info none.obj --json", 0);
    assert_true(json_is_null(json_object_get(object, "bounds")));
    json_decref(object);
    object = run_json("check-manifold nan.obj --json", 0);
    assert_int_equal(json_integer_value(json_object_get(object, "non_finite_vertices")), 1);
    json_decref(object);
}

static void the_others_have_theirs(void **state)
{
    (void)state;
    static const struct {
        const char *arguments;
        const char *const keys[12];
    } calls[] = {
        {"convert triangle.off x.ply --json", {"lost"}},
        {"generate cube -o cube.off --json", {"kind", "output", "vertices", "faces", "lost"}},
        {"subdivide cube.off -o x.off -n 2 --json",
         {"file", "format", "output", "levels", "vertices", "faces", "lost"}},
        {"subdivide cube.off --dry-run --json", {"file", "levels"}},
        {"preview cube.off -o x.png --size 20x10 --json",
         {"file", "format", "output", "width", "height", "pictures", "eye", "target", "units_per_pixel", "scale_bar",
          "unseen_faces"}},
        {"formats --json", {"meshes", "images"}},
        {"help --json", {"commands"}},
    };
    for (size_t i = 0; i < sizeof calls / sizeof calls[0]; i++) {
        json_t *object = run_json(calls[i].arguments, 0);
        assert_keys(object, calls[i].keys);
        json_decref(object);
    }
}

/* The counts that --dry-run foretells are those that the run makes. */
static void a_dry_run_foretells(void **state)
{
    (void)state;
    json_decref(run_json("generate cube -o cube.off --json", 0));
    json_t *foretold = run_json("subdivide cube.off -n 3 --dry-run --json", 0);
    json_t *levels = json_object_get(foretold, "levels");
    assert_int_equal(json_array_size(levels), 4);
    for (int level = 0; level <= 3; level++) {
        char arguments[64];
        snprintf(arguments, sizeof arguments, "subdivide cube.off -n %d -o x.ply --json", level);
        json_t *made = run_json(arguments, 0), *row = json_array_get(levels, (size_t)level);
        assert_true(json_equal(json_object_get(made, "vertices"), json_object_get(row, "vertices")));
        assert_true(json_equal(json_object_get(made, "faces"), json_object_get(row, "faces")));
        json_decref(made);
    }
    json_decref(foretold);
}

/* A file's name is any bytes; JSON is UTF-8. */
static void a_name_that_is_no_text_stays_json(void **state)
{
    (void)state;
    write_file("a\xff\"b\xc3\xa9.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    json_t *object = run_json("info a*.off --json", 0);
    assert_string_equal(json_string_value(json_object_get(object, "file")), "a\xEF\xBF\xBD\"b\xc3\xa9.off");
    json_decref(object);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(self_intersections_are_counted_and_listed_when_asked_for),
        cmocka_unit_test(a_hundred_self_intersections_are_listed),
        cmocka_unit_test(the_check_has_the_keys_of_the_contract),
        cmocka_unit_test(answers_that_have_no_meaning_are_null),
        cmocka_unit_test(defects_are_the_first_hundred_of_each_kind),
        cmocka_unit_test(several_files_are_one_object_a_line),
        cmocka_unit_test(numbers_read_back_and_are_shortest),
        cmocka_unit_test(info_has_the_keys_of_the_contract),
        cmocka_unit_test(what_is_not_finite_is_null),
        cmocka_unit_test(the_others_have_theirs),
        cmocka_unit_test(a_dry_run_foretells),
        cmocka_unit_test(a_name_that_is_no_text_stays_json),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
