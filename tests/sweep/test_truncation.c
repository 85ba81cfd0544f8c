/* Every format, every small mesh, cut at every byte: an error with a sentence, or what the bytes that are left say.
 * A format that counts its elements must see everything that is missing but the end of the last number; OBJ has no
 * counts, so that there a cut between lines is a shorter file, and so is an ASCII STL file between its solids. */
#include "tests/support/unit.h"

#include "tests/support/fixture.h"
#include "tests/support/zoo.h"

#include <meshtool/mesh_format.h>

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define STORED_LIMIT 4000 /* bytes of a stored file that is cut everywhere: the time grows with the square */

/* The last line of a text, where a cut may leave a shorter number. */
static size_t last_line(const char *bytes, size_t size)
{
    size_t at = size > 0 ? size - 1 : 0;
    while (at > 0 && bytes[at - 1] != '\n') {
        at--;
    }
    return at;
}

/* Whether what is left of a text may be a file of its own: OBJ between lines, ASCII STL after a solid, all others but
 * for the end of the last number. */
static bool may_pass(const char *format, const char *bytes, size_t size, size_t whole_size)
{
    size_t line = last_line(bytes, size), length = size - line;
    bool after_solid = length >= 8 && memcmp(bytes + line, "endsolid", 8) == 0;
    bool before_solid = line > 0 && length < 5 && memcmp(bytes + line, "solid", length) == 0; /* junk, warned of */
    return strcmp(format, "obj") == 0 || size >= last_line(bytes, whole_size) ||
           (strcmp(format, "stl") == 0 && (after_solid || before_solid));
}

/* Everything but the last element is that of the whole mesh. */
static bool is_beginning_of(const mt_mesh *part, const mt_mesh *whole)
{
    if (part->vertex_count > whole->vertex_count || part->face_count > whole->face_count) {
        return false;
    }
    for (mt_index i = 0; i + 1 < part->vertex_count; i++) {
        mt_vec3 a = mt_mesh_position(part, i), b = mt_mesh_position(whole, i);
        if (memcmp(&a, &b, sizeof a) != 0) {
            return false;
        }
    }
    for (mt_index face = 0; face + 1 < part->face_count; face++) {
        mt_index begin = mt_mesh_face_begin(whole, face), sides = mt_mesh_face_sides(whole, face);
        if (mt_mesh_face_sides(part, face) != sides || mt_mesh_face_begin(part, face) != begin ||
            memcmp(part->corner_vertices + begin, whole->corner_vertices + begin, sides * sizeof(mt_index)) != 0) {
            return false;
        }
    }
    return true;
}

typedef struct sweep {
    const mt_mesh_format *format;
    const char *animal, *name;
    bool text;
    size_t accepted, refused;
} sweep;

static void cut(mt_context *context, sweep *s, const char *bytes, size_t size, size_t whole_size, const mt_mesh *whole)
{
    mt_mesh *mesh;
    uint64_t before = mt_context_bytes(context);
    mt_context_clear_error(context);
    mt_status status = mt_mesh_read_memory(context, s->name, bytes, size, NULL, &mesh, NULL);
    if (status != MT_OK) {
        bool said = mt_context_error(context)->status == status && mt_context_error(context)->message[0];
        if (mesh || !said || status == MT_ERROR_INTERNAL || mt_context_bytes(context) != before) {
            fail_msg("%s as %s, cut at %zu: status %d, \"%s\"", s->animal, s->name, size, status,
                     mt_context_error(context)->message);
        }
        s->refused++;
        return;
    }
    bool allowed = s->text && may_pass(s->format->name, bytes, size, whole_size);
    if (!allowed || mt_mesh_validate(context, mesh) != MT_OK || !is_beginning_of(mesh, whole)) {
        fail_msg("%s as %s, cut at %zu of %zu: read as %u vertices and %u faces", s->animal, s->name, size, whole_size,
                 mesh->vertex_count, mesh->face_count);
    }
    mt_mesh_destroy(context, mesh);
    assert_int_equal(mt_context_bytes(context), before);
    s->accepted++;
}

static void sweep_file(mt_context *context, sweep *s, const mt_mesh *mesh, mt_encoding encoding)
{
    mt_mesh_write_options options = {.format = s->format->name, .encoding = encoding};
    void *bytes;
    size_t size;
    mt_mesh *whole;
    assert_int_equal(mt_mesh_write_memory(context, mesh, &options, &bytes, &size), MT_OK);
    mt_context_clear_error(context);
    if (mt_mesh_read_memory(context, s->name, bytes, size, NULL, &whole, NULL) != MT_OK) {
        fail_msg("%s as %s: %s", s->animal, s->name, mt_context_error(context)->message);
    }
    for (size_t i = 0; i < size; i++) {
        cut(context, s, bytes, i, size, whole);
    }
    mt_mesh_destroy(context, whole);
    mt_free(context, bytes);
}

static void test_every_cut_of_every_format(void **state)
{
    (void)state;
    test_animal animals[TEST_ZOO_ROOM];
    mt_context *context = test_context_with_threads(1);
    size_t count = test_zoo(context, animals);
    for (const mt_mesh_format *const *format = mt_mesh_formats(); *format; format++) {
        const bool has[] = {(*format)->has_ascii, (*format)->has_binary, (*format)->has_binary_big};
        for (int encoding = 0; encoding < 3; encoding++) {
            char name[32];
            snprintf(name, sizeof name, "cut.%s", (*format)->extensions[0]);
            sweep s = {.format = *format, .name = name, .text = encoding == 0};
            for (size_t i = 0; has[encoding] && i < count; i++) {
                if (test_animal_is_refused(&animals[i], *format)) {
                    continue;
                }
                s.animal = animals[i].name;
                sweep_file(context, &s, animals[i].mesh, (mt_encoding)(MT_ENCODING_ASCII + encoding));
            }
            print_message("%s, encoding %d: %zu cuts refused, %zu read\n", (*format)->name, encoding, s.refused,
                          s.accepted);
        }
    }
    test_zoo_end(context, animals, count);
    test_context_end(context);
}

/* The small files of meshes/, as they are: other writers' headers, comments and line ends. */
static void sweep_stored_file(mt_context *context, const char *path)
{
    size_t size;
    unsigned char *bytes = test_read_file(path, &size);
    const mt_mesh_format *format;
    mt_mesh *whole;
    assert_non_null(bytes);
    if (size <= STORED_LIMIT) {
        mt_context_clear_error(context);
        if (mt_mesh_read_memory(context, path, bytes, size, NULL, &whole, &format) != MT_OK) {
            fail_msg("%s", mt_context_error(context)->message);
        }
        bool binary = memchr(bytes, 0, size) != NULL;
        sweep s = {.format = format, .animal = path, .name = path, .text = !binary};
        for (size_t i = 0; i < size; i++) {
            cut(context, &s, (const char *)bytes, i, size, whole);
        }
        mt_mesh_destroy(context, whole);
    }
    free(bytes);
}

static void test_every_cut_of_stored_files(void **state)
{
    (void)state;
    static const char *const folders[] = {"meshes/valid", "meshes/non_manifold"};
    mt_context *context = test_context_with_threads(1);
    size_t count = 0;
    for (size_t i = 0; i < sizeof folders / sizeof folders[0]; i++) {
        DIR *folder = opendir(folders[i]);
        assert_non_null(folder);
        for (struct dirent *entry; (entry = readdir(folder));) {
            char path[512];
            snprintf(path, sizeof path, "%s/%s", folders[i], entry->d_name);
            if (entry->d_name[0] != '.') {
                sweep_stored_file(context, path);
                count++;
            }
        }
        closedir(folder);
    }
    assert_true(count > 10);
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_every_cut_of_every_format),
                                       cmocka_unit_test(test_every_cut_of_stored_files)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
