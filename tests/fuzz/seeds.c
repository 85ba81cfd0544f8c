/* Writes seeds for the fuzzers: small primitives in every format and encoding, FOLDER/FORMAT/NAME-ENCODING, and small
 * pictures in every format, plain and compressed, FOLDER/FORMAT/CHANNELS-BITS. */
#include <meshtool/generate.h>
#include <meshtool/image_format.h>
#include <meshtool/mesh_format.h>

#include <stdio.h>
#include <sys/stat.h>

static bool write_seed(mt_context *context, const char *folder, const mt_mesh_format *format, const char *name)
{
    static const char *const kinds[] = {"ascii", "binary", "big"};
    const bool has[] = {format->has_ascii, format->has_binary, format->has_binary_big};
    mt_generate_options smallest = {.resolution = 6};
    char path[512];
    mt_mesh *mesh;
    if (mt_generate(context, name, &smallest, &mesh) != MT_OK) {
        mt_context_clear_error(context);
        return true;
    }
    bool written = true;
    for (int encoding = 0; encoding < 3; encoding++) {
        mt_mesh_write_options options = {.format = format->name,
                                         .encoding = (mt_encoding)(MT_ENCODING_ASCII + encoding)};
        snprintf(path, sizeof path, "%s/%s/%s-%s", folder, format->name, name, kinds[encoding]);
        written = written && (!has[encoding] || mt_mesh_write_file(context, mesh, path, &options, NULL) == MT_OK);
    }
    mt_mesh_destroy(context, mesh);
    return written;
}

/* A ramp of 9 x 7 pixels; what a format cannot hold makes no seed. */
static void write_picture(mt_context *context, const char *folder, const char *format, uint32_t channels, unsigned bits)
{
    static const char *const ends[] = {"", ".gz", ".zst"};
    mt_image_write_options options = {.format = format, .bits = bits};
    char path[512];
    mt_image *image = NULL;
    if (mt_image_create(context, 9, 7, channels, &image) == MT_OK) {
        for (uint32_t i = 0; i < 9 * 7 * channels; i++) {
            image->pixels[i] = (float)i / (float)(9 * 7 * channels);
        }
        for (size_t i = 0; i < sizeof ends / sizeof ends[0]; i++) {
            snprintf(path, sizeof path, "%s/%s/%u-%u%s", folder, format, channels, bits, ends[i]);
            mt_image_write_file(context, image, path, &options);
        }
    }
    mt_image_destroy(context, image);
    mt_context_clear_error(context);
}

static void write_pictures(mt_context *context, const char *folder, const char *format)
{
    static const unsigned bits[] = {0, 1, 16, 32};
    char path[512];
    snprintf(path, sizeof path, "%s/%s", folder, format);
    mkdir(path, 0777);
    for (size_t i = 0; i < sizeof bits / sizeof bits[0]; i++) {
        write_picture(context, folder, format, 1, bits[i]);
        write_picture(context, folder, format, 3, bits[i]);
        write_picture(context, folder, format, 4, bits[i]);
    }
}

int main(int count, char **arguments)
{
    static const char *const names[] = {"tetrahedron", "cube", "prism", "cone", "bowtie", "book", "moebius"};
    mt_context *context = mt_context_create(NULL);
    bool written = count == 2 && context;
    for (const mt_mesh_format *const *format = mt_mesh_formats(); written && *format; format++) {
        char path[512];
        snprintf(path, sizeof path, "%s/%s", arguments[1], (*format)->name);
        mkdir(path, 0777);
        for (size_t i = 0; written && i < sizeof names / sizeof names[0]; i++) {
            written = write_seed(context, arguments[1], *format, names[i]);
        }
    }
    for (const mt_image_format *const *format = mt_image_formats(); written && *format; format++) {
        write_pictures(context, arguments[1], (*format)->name);
    }
    if (!written) {
        fprintf(stderr, "usage: fuzz_seeds FOLDER (%s)\n", context ? mt_context_error(context)->message : "");
    }
    mt_context_destroy(context);
    return written ? 0 : 1;
}
