#include "tests/support/reading.h"

#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <stdio.h>
#include <string.h>

static void keep_warning(void *user, const char *sentence)
{
    test_reading *reading = user;
    size_t used = strlen(reading->warnings);
    snprintf(reading->warnings + used, sizeof reading->warnings - used, "%s\n", sentence);
}

void test_reading_begin_with(test_reading *reading, mt_context_options options)
{
    reading->warnings[0] = 0;
    options.warning = keep_warning;
    options.warning_user = reading;
    reading->context = mt_context_create(&options);
    assert_non_null(reading->context);
}

void test_reading_begin(test_reading *reading)
{
    test_reading_begin_with(reading, (mt_context_options){0});
}

void test_reading_end(test_reading *reading)
{
    test_context_end(reading->context);
}

mt_mesh *test_read(test_reading *reading, const char *name, const void *bytes, size_t size)
{
    mt_mesh *mesh = NULL;
    reading->warnings[0] = 0;
    mt_status status = mt_mesh_read_memory(reading->context, name, bytes, size, NULL, &mesh, NULL);
    if (status != MT_OK) {
        fail_msg("refused: %s", mt_context_error(reading->context)->message);
    }
    assert_non_null(mesh);
    if (mt_mesh_validate(reading->context, mesh) != MT_OK) {
        fail_msg("not valid: %s", mt_context_error(reading->context)->message);
    }
    return mesh;
}

mt_mesh *test_read_text(test_reading *reading, const char *name, const char *text)
{
    return test_read(reading, name, text, strlen(text));
}

void test_refuse(test_reading *reading, const char *name, const void *bytes, size_t size, mt_status status,
                 const char *part)
{
    mt_mesh *mesh = NULL;
    uint64_t before = mt_context_bytes(reading->context);
    reading->warnings[0] = 0;
    mt_status got = mt_mesh_read_memory(reading->context, name, bytes, size, NULL, &mesh, NULL);
    const char *message = mt_context_error(reading->context)->message;
    if (got != status || !strstr(message, part)) {
        fail_msg("expected status %d and \"%s\", got %d and \"%s\"", status, part, got, message);
    }
    assert_null(mesh);
    assert_int_equal(mt_context_bytes(reading->context), before);
    mt_context_clear_error(reading->context);
}

void test_refuse_text(test_reading *reading, const char *name, const char *text, mt_status status, const char *part)
{
    test_refuse(reading, name, text, strlen(text), status, part);
}

void test_warned(const test_reading *reading, const char *part)
{
    if (!part && reading->warnings[0]) {
        fail_msg("unexpected warning: %s", reading->warnings);
    }
    if (part && !strstr(reading->warnings, part)) {
        fail_msg("expected a warning with \"%s\", got \"%s\"", part, reading->warnings);
    }
}

mt_mesh *test_round_trip(test_reading *reading, const mt_mesh *mesh, const char *format, mt_encoding encoding)
{
    void *bytes = NULL;
    size_t size = 0;
    mt_mesh_write_options options = {.format = format, .encoding = encoding};
    reading->warnings[0] = 0;
    if (mt_mesh_write_memory(reading->context, mesh, &options, &bytes, &size) != MT_OK) {
        fail_msg("not written: %s", mt_context_error(reading->context)->message);
    }
    test_warned(reading, NULL);
    mt_mesh *copy = test_read(reading, format, bytes, size);
    mt_free(reading->context, bytes);
    return copy;
}

static void assert_same_attribute(const mt_mesh *mesh, const mt_attribute *a, const mt_attribute *b)
{
    size_t indices = mt_mesh_domain_count(mesh, a->domain) * sizeof(mt_index);
    assert_string_equal(a->name, b->name);
    assert_int_equal(a->semantic, b->semantic);
    assert_int_equal(a->domain, b->domain);
    assert_int_equal(a->type, b->type);
    assert_int_equal(a->component_count, b->component_count);
    assert_int_equal(a->value_count, b->value_count);
    assert_memory_equal(a->values, b->values, a->value_count * a->component_count * mt_type_size(a->type));
    assert_int_equal(!a->indices, !b->indices);
    if (a->indices) {
        assert_memory_equal(a->indices, b->indices, indices);
    }
}

void test_assert_same_mesh(const mt_mesh *a, const mt_mesh *b)
{
    assert_int_equal(a->vertex_count, b->vertex_count);
    assert_int_equal(a->face_count, b->face_count);
    assert_int_equal(a->corner_count, b->corner_count);
    assert_int_equal(a->position_type, b->position_type);
    assert_memory_equal(a->positions, b->positions, 3 * (size_t)a->vertex_count * mt_type_size(a->position_type));
    assert_memory_equal(a->corner_vertices, b->corner_vertices, a->corner_count * sizeof(mt_index));
    assert_int_equal(a->wire_count, b->wire_count);
    assert_int_equal(a->attribute_count, b->attribute_count);
    for (mt_index i = 0; i < a->attribute_count; i++) {
        assert_same_attribute(a, &a->attributes[i], &b->attributes[i]);
    }
    assert_int_equal(a->label_set_count, b->label_set_count);
    assert_int_equal(test_mesh_hash(a), test_mesh_hash(b));
}
