/* Any bytes, read as one mesh format: an error with a sentence, or a valid mesh that can be written and read again.
 * Nothing is leaked, and no more memory is held than the limit allows. */
#include <meshtool/mesh_format.h>

#include <stdio.h>
#include <stdlib.h>

#define MEMORY_LIMIT ((uint64_t)256 << 20)

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size);

static void require(bool condition, const mt_context *context, const char *what)
{
    if (!condition) {
        fprintf(stderr, "%s: %s\n", what, mt_context_error(context)->message);
        abort();
    }
}

static void write_and_read_again(mt_context *context, const mt_mesh *mesh)
{
    mt_mesh_write_options to = {.format = FUZZ_FORMAT};
    mt_mesh_read_options from = {.format = FUZZ_FORMAT};
    void *bytes;
    size_t size;
    mt_mesh *again;
    mt_status status = mt_mesh_write_memory(context, mesh, &to, &bytes, &size);
    /* A format that needs finite numbers may meet others in a file and must not write them. */
    bool refused =
        status == MT_ERROR_UNSUPPORTED && mt_mesh_format_by_extension(FUZZ_FORMAT)->abilities & MT_NEEDS_FINITE;
    require(status == MT_OK || status == MT_ERROR_OUT_OF_MEMORY || refused, context, "what was read cannot be written");
    if (status != MT_OK) {
        return;
    }
    status = mt_mesh_read_memory(context, "again", bytes, size, &from, &again, NULL);
    require(status == MT_OK || status == MT_ERROR_OUT_OF_MEMORY, context, "what was written cannot be read");
    mt_mesh_destroy(context, again);
    mt_free(context, bytes);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    mt_context_options options = {.thread_count = 1, .memory_limit = MEMORY_LIMIT};
    mt_mesh_read_options from = {.format = FUZZ_FORMAT};
    mt_context *context = mt_context_create(&options);
    mt_mesh *mesh;
    if (!context) {
        return 0;
    }
    mt_status status = mt_mesh_read_memory(context, "fuzz", bytes, size, &from, &mesh, NULL);
    if (status == MT_OK) {
        require(mt_mesh_validate(context, mesh) == MT_OK, context, "an invalid mesh was read");
        write_and_read_again(context, mesh);
        mt_mesh_destroy(context, mesh);
    } else {
        require(!mesh && status != MT_ERROR_INTERNAL && mt_context_error(context)->message[0], context,
                "a failure without a sentence");
    }
    require(mt_context_bytes(context) == 0, context, "memory was leaked");
    mt_context_destroy(context);
    return 0;
}
