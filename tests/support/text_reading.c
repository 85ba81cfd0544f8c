#include "tests/support/unit.h"

#include "tests/support/text_reading.h"

#include <stdio.h>
#include <string.h>

static void gather(void *user, const char *sentence)
{
    test_warnings *warnings = user;
    size_t length = strlen(warnings->text);
    warnings->count++;
    snprintf(warnings->text + length, TEST_WARNING_ROOM - length, "%s\n", sentence);
}

mt_context *test_context_with_warnings(test_warnings *warnings, unsigned thread_count)
{
    memset(warnings, 0, sizeof *warnings);
    mt_context_options options = {.thread_count = thread_count, .warning = gather, .warning_user = warnings};
    mt_context *context = mt_context_create(&options);
    assert_non_null(context);
    return context;
}

mt_mesh *text_read_bytes(mt_context *context, const char *name, const void *bytes, size_t size)
{
    mt_mesh *mesh;
    mt_context_clear_error(context);
    if (mt_mesh_read_memory(context, name, bytes, size, NULL, &mesh, NULL) != MT_OK) {
        fail_msg("%s", mt_context_error(context)->message);
    }
    if (mt_mesh_validate(context, mesh) != MT_OK) {
        fail_msg("%s: %s", name, mt_context_error(context)->message);
    }
    return mesh;
}

mt_mesh *text_read(mt_context *context, const char *name, const char *text)
{
    return text_read_bytes(context, name, text, strlen(text));
}

const char *text_refuse(mt_context *context, const char *name, const void *bytes, size_t size, mt_status status)
{
    mt_mesh *mesh;
    uint64_t before = mt_context_bytes(context);
    mt_context_clear_error(context);
    mt_status got = mt_mesh_read_memory(context, name, bytes, size, NULL, &mesh, NULL);
    if (got != status) {
        fail_msg("%s: status %d, expected %d: %s", name, got, status, mt_context_error(context)->message);
    }
    assert_null(mesh);
    assert_int_equal(mt_context_error(context)->status, status);
    assert_true(mt_context_error(context)->message[0] != '\0');
    assert_int_equal(mt_context_bytes(context), before);
    return mt_context_error(context)->message;
}

mt_mesh *text_through(mt_context *context, const mt_mesh *mesh, const char *format, mt_encoding encoding)
{
    mt_mesh_write_options options = {.format = format, .encoding = encoding};
    void *bytes;
    size_t size;
    char name[64];
    mt_context_clear_error(context);
    if (mt_mesh_write_memory(context, mesh, &options, &bytes, &size) != MT_OK) {
        fail_msg("%s: %s", format, mt_context_error(context)->message);
    }
    snprintf(name, sizeof name, "memory.%s", format);
    mt_mesh *again = text_read_bytes(context, name, bytes, size);
    mt_free(context, bytes);
    return again;
}
