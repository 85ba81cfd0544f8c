/* The table of mesh formats, and what is common to all: recognition, reading and writing by name. */
#include "formats/mesh/loss.h"
#include "formats/mesh/recognition.h"
#include "formats/mesh/records.h"
#include "formats/stream/input.h"
#include "formats/stream/output.h"
#include "formats/stream/path.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

const mt_mesh_format *const *mt_mesh_formats(void)
{
    static const mt_mesh_format *const table[] = {
        &mt_drc_format, &mt_glb_format, &mt_gltf_format, &mt_obj_format,
        &mt_off_format, &mt_ply_format, &mt_stl_format,  NULL,
    };
    return table;
}

const mt_mesh_format *mt_mesh_format_by_extension(const char *extension)
{
    for (const mt_mesh_format *const *format = mt_mesh_formats(); *format; format++) {
        for (const char *const *known = (*format)->extensions; *known; known++) {
            if (strcasecmp(*known, extension) == 0) {
                return *format;
            }
        }
    }
    return NULL;
}

/* "obj, off, ply, stl": the preferred extension of each. */
static void list_extensions(char *text, size_t room)
{
    size_t length = 0;
    text[0] = '\0';
    for (const mt_mesh_format *const *format = mt_mesh_formats(); *format && length < room; format++) {
        int added = snprintf(text + length, room - length, "%s%s", length ? ", " : "", (*format)->extensions[0]);
        length += added > 0 ? (size_t)added : 0;
    }
}

const mt_mesh_format *mt_mesh_format_for_output(mt_context *context, const char *path,
                                                const mt_mesh_write_options *options)
{
    mt_extension named;
    if (mt_path_output_extension(context, path, options ? options->format : NULL, "ply", &named) != MT_OK) {
        return NULL;
    }
    const char *extension = named.text;
    const mt_mesh_format *format = mt_mesh_format_by_extension(extension);
    if (!format || !format->write) {
        char known[256];
        list_extensions(known, sizeof known);
        if (extension[0]) {
            mt_fail(context, MT_ERROR_ARGUMENT, "%s: no mesh format is called \"%s\", expected one of: %s", path,
                    extension, known);
        } else {
            mt_fail(context, MT_ERROR_ARGUMENT, "%s: the name has no extension to tell the format, expected one of: %s",
                    path, known);
        }
        return NULL;
    }
    return format;
}

static bool all_finite(const mt_mesh *mesh)
{
    uint64_t count = 3 * (uint64_t)mesh->vertex_count;
    double sum = 0.0;
    if (mesh->position_type == MT_F64) {
        const double *p = mesh->positions;
        for (uint64_t i = 0; i < count; i++) {
            sum += p[i] * 0.0;
        }
    } else {
        const float *p = mesh->positions;
        for (uint64_t i = 0; i < count; i++) {
            sum += (double)p[i] * 0.0;
        }
    }
    return sum == 0.0;
}

/* What holds for every format once a mesh is read: the precision asked for, and numbers that are not finite. */
static mt_status finish_reading(mt_context *context, const mt_input *input, const mt_mesh_read_options *options,
                                mt_mesh *mesh)
{
    if (!all_finite(mesh)) {
        unsigned long count = mt_mesh_bounds(mesh).non_finite_count;
        mt_warn(context, "%s: %lu %s a coordinate that is not finite (nan or inf)", mt_input_name(input), count,
                count == 1 ? "vertex has" : "vertices have");
    }
    if (options->precision == MT_PRECISION_AUTO) {
        return MT_OK;
    }
    mt_type type = options->precision == MT_PRECISION_F32 ? MT_F32 : MT_F64;
    mt_index overflowed = 0;
    mt_status status = mt_mesh_set_position_type(context, mesh, type, &overflowed);
    if (overflowed > 0) {
        mt_warn(context, "%s: %lu coordinates are too large for single precision and became infinite",
                mt_input_name(input), (unsigned long)overflowed);
    }
    return status;
}

static mt_status read_input(mt_context *context, mt_input *input, const mt_mesh_read_options *options, mt_mesh **out,
                            const mt_mesh_format **chosen)
{
    const mt_mesh_format *format;
    mt_mesh *mesh = NULL;
    mt_status status = mt_recognise_mesh(context, input, options->format, &format);
    if (status == MT_OK) {
        if (chosen) {
            *chosen = format;
        }
        status = format->read(context, input, options, &mesh);
    }
    if (status == MT_OK) {
        status = finish_reading(context, input, options, mesh);
    }
    if (status != MT_OK) {
        mt_mesh_destroy(context, mesh);
        mesh = NULL;
    }
    *out = mesh;
    return status;
}

mt_status mt_mesh_read_file(mt_context *context, const char *path, const mt_mesh_read_options *options, mt_mesh **out,
                            const mt_mesh_format **format)
{
    static const mt_mesh_read_options defaults;
    mt_input *input;
    *out = NULL;
    mt_status status = mt_input_open(context, path, &input);
    if (status == MT_OK) {
        status = read_input(context, input, options ? options : &defaults, out, format);
        mt_input_close(context, input);
    }
    return status;
}

mt_status mt_mesh_read_memory(mt_context *context, const char *name, const void *bytes, size_t size,
                              const mt_mesh_read_options *options, mt_mesh **out, const mt_mesh_format **format)
{
    static const mt_mesh_read_options defaults;
    mt_input *input;
    *out = NULL;
    mt_status status = mt_input_open_memory(context, name, bytes, size, &input);
    if (status == MT_OK) {
        status = read_input(context, input, options ? options : &defaults, out, format);
        mt_input_close(context, input);
    }
    return status;
}

static mt_status check_encoding(mt_context *context, const mt_mesh_format *format, mt_encoding encoding)
{
    bool held = encoding == MT_ENCODING_DEFAULT || (encoding == MT_ENCODING_ASCII && format->has_ascii) ||
                (encoding == MT_ENCODING_BINARY && format->has_binary) ||
                (encoding == MT_ENCODING_BINARY_BIG && format->has_binary_big);
    static const char *const names[] = {"default", "ascii", "binary", "big-endian binary"};
    return held ? MT_OK : mt_fail(context, MT_ERROR_ARGUMENT, "%s has no %s encoding", format->title, names[encoding]);
}

/* Everything that can be refused before a byte is written. */
static mt_status prepare_writing(mt_context *context, const mt_mesh *mesh, const mt_mesh_format *format,
                                 const mt_mesh_write_options *options, mt_loss *loss)
{
    mt_status status = check_encoding(context, format, options->encoding);
    if (status == MT_OK) {
        status = mt_mesh_format_loss(context, mesh, format, options, loss);
    }
    if (status == MT_OK && options->strict_loss && loss->count > 0) {
        status = mt_loss_refuse(context, loss, format->title);
    }
    return status;
}

mt_status mt_mesh_write_file(mt_context *context, const mt_mesh *mesh, const char *path,
                             const mt_mesh_write_options *options, mt_loss *loss)
{
    static const mt_mesh_write_options defaults;
    mt_loss lost;
    mt_output *output = NULL;
    options = options ? options : &defaults;
    loss = loss ? loss : &lost;
    loss->count = 0;
    const mt_mesh_format *format = mt_mesh_format_for_output(context, path, options);
    if (!format) {
        return MT_ERROR_ARGUMENT;
    }
    mt_status status = prepare_writing(context, mesh, format, options, loss);
    if (status == MT_OK) {
        status = mt_output_open(context, path, options->no_clobber, &output);
    }
    if (status == MT_OK) {
        status = format->write(context, mesh, options, output);
        if (status != MT_OK) {
            mt_output_abandon(context, output);
            return status;
        }
        status = mt_output_commit(context, output);
    }
    return status;
}

mt_status mt_mesh_write_memory(mt_context *context, const mt_mesh *mesh, const mt_mesh_write_options *options,
                               void **bytes, size_t *size)
{
    static const mt_mesh_write_options defaults;
    mt_loss lost;
    mt_output *output = NULL;
    options = options ? options : &defaults;
    *bytes = NULL;
    *size = 0;
    const mt_mesh_format *format = mt_mesh_format_for_output(context, "-", options);
    if (!format) {
        return MT_ERROR_ARGUMENT;
    }
    mt_status status = prepare_writing(context, mesh, format, options, &lost);
    if (status == MT_OK) {
        status = mt_output_open_memory(context, &output);
    }
    if (status == MT_OK) {
        status = format->write(context, mesh, options, output);
        if (status != MT_OK) {
            mt_output_abandon(context, output);
            return status;
        }
        status = mt_output_take(context, output, bytes, size);
    }
    return status;
}
