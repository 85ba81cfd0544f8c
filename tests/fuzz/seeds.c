/* Writes seeds for the fuzzers: small primitives in every format and encoding, FOLDER/FORMAT/NAME-ENCODING. */
#include <meshtool/generate.h>
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
    if (!written) {
        fprintf(stderr, "usage: fuzz_seeds FOLDER (%s)\n", context ? mt_context_error(context)->message : "");
    }
    mt_context_destroy(context);
    return written ? 0 : 1;
}
