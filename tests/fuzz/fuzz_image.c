/* Any bytes, read as one picture format, as they are and compressed: an error with a sentence, or a picture that can be
 * written and read again. Nothing is leaked, and no more memory is held than the limit allows. */
#include <meshtool/image_format.h>

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

/* A format may hold less than what it reads: alpha, more channels than one. */
static void write_and_read_again(mt_context *context, const mt_image *image)
{
    mt_image_write_options to = {.format = FUZZ_FORMAT};
    mt_image_read_options from = {.format = FUZZ_FORMAT};
    void *bytes;
    size_t size;
    mt_image *again = NULL;
    mt_status status = mt_image_write_memory(context, image, &to, &bytes, &size);
    require(status == MT_OK || status == MT_ERROR_OUT_OF_MEMORY || status == MT_ERROR_UNSUPPORTED, context,
            "what was read cannot be written");
    if (status != MT_OK) {
        return;
    }
    status = mt_image_read_memory(context, "again", bytes, size, &from, &again, NULL);
    require(status == MT_OK || status == MT_ERROR_OUT_OF_MEMORY, context, "what was written cannot be read");
    require(status != MT_OK || (again->width == image->width && again->height == image->height), context,
            "what was written has another size");
    mt_image_destroy(context, again);
    mt_free(context, bytes);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    mt_context_options options = {.thread_count = 1, .memory_limit = MEMORY_LIMIT};
    mt_image_read_options from = {.format = FUZZ_FORMAT};
    mt_context *context = mt_context_create(&options);
    mt_image *image;
    if (!context) {
        return 0;
    }
    mt_status status = mt_image_read_memory(context, "fuzz", bytes, size, &from, &image, NULL);
    if (status == MT_OK) {
        write_and_read_again(context, image);
        mt_image_destroy(context, image);
    } else {
        require(!image && status != MT_ERROR_INTERNAL && mt_context_error(context)->message[0], context,
                "a failure without a sentence");
    }
    require(mt_context_bytes(context) == 0, context, "memory was leaked");
    mt_context_destroy(context);
    return 0;
}
