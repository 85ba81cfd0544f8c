#include "formats/mesh/draco_options.h"

#include "formats/mesh/loss.h"

#define POSITION_BITS 14
#define NORMAL_BITS 10
#define UV_BITS 12
#define OTHER_BITS 10
#define USUAL_SPEED 5
#define SEQUENTIAL_SPEED 10 /* from here on Draco itself prefers sequential encoding */

unsigned mt_draco_bits(const mt_draco_options *options, mt_draco_kind kind)
{
    static const unsigned usual[] = {POSITION_BITS, NORMAL_BITS, OTHER_BITS, UV_BITS, OTHER_BITS};
    if (options->lossless) {
        return 0;
    }
    return kind == MT_DRACO_POSITION && options->position_bits ? options->position_bits : usual[kind];
}

static unsigned speed_of(const mt_draco_options *options)
{
    return options->has_speed ? options->speed : USUAL_SPEED;
}

static bool is_sequential(const mt_draco_options *options)
{
    return options->sequential || speed_of(options) >= SEQUENTIAL_SPEED;
}

/* What comes back when it is other than what went in. */
static mt_status compare(mt_context *context, const mt_draco_source *source, const mt_draco_bytes *bytes, bool strict)
{
    if (bytes->vertex_count == source->vertex_count && bytes->triangle_count == source->triangle_count) {
        return MT_OK;
    }
    static const char sentence[] = "Draco's edgebreaker makes %u vertices and %u triangles of %u and %u: it drops "
                                   "vertices without faces and faces without area, and repeats vertices where faces "
                                   "meet in a non-manifold way";
    if (strict) {
        return mt_fail(context, MT_ERROR_LOSS, sentence, bytes->vertex_count, bytes->triangle_count,
                       source->vertex_count, source->triangle_count);
    }
    mt_warn(context, sentence, bytes->vertex_count, bytes->triangle_count, source->vertex_count,
            source->triangle_count);
    return MT_OK;
}

static bool is_degenerate(const mt_index *t)
{
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

/* Edgebreaker needs a triangle of three vertices. */
static bool has_triangle(const mt_draco_source *source)
{
    for (mt_index i = 0; source->triangles && i < source->triangle_count; i++) {
        if (!is_degenerate(source->triangles + 3 * (size_t)i)) {
            return true;
        }
    }
    return false;
}

mt_status mt_draco_compress(mt_context *context, mt_draco_source *source, const mt_draco_options *options,
                            bool strict_loss, mt_draco_bytes *out)
{
    /* Draco's sequential decoder refuses more than three vertices for each triangle, which its encoder writes. */
    bool crowded = source->triangles && source->vertex_count > 3 * (uint64_t)source->triangle_count;
    source->speed = speed_of(options);
    source->sequential = !has_triangle(source) || (is_sequential(options) && !crowded);
    if (crowded && source->sequential) {
        return mt_fail(context, MT_ERROR_UNSUPPORTED,
                       "Draco holds three vertices for each triangle at most, and %u triangles without area have %u",
                       source->triangle_count, source->vertex_count);
    }
    mt_status status = mt_draco_job_encode(context, source, out);
    if (status == MT_OK) {
        status = compare(context, source, out, strict_loss);
    }
    if (status != MT_OK) {
        mt_free(context, out->bytes);
        *out = (mt_draco_bytes){0};
    }
    return status;
}

static void add_quantised(mt_loss *loss, const mt_mesh *mesh, const mt_draco_options *options)
{
    static const struct {
        mt_semantic semantic;
        mt_draco_kind kind;
        const char *name;
    } kinds[] = {{MT_SEMANTIC_NORMAL, MT_DRACO_NORMAL, "normals"},
                 {MT_SEMANTIC_UV, MT_DRACO_UV, "UVs"},
                 {MT_SEMANTIC_COLOR, MT_DRACO_COLOR, "float colors"}};
    if (options->lossless || mesh->vertex_count == 0) {
        return;
    }
    mt_loss_add(loss, "positions (quantised to %u bits)", mt_draco_bits(options, MT_DRACO_POSITION));
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        bool has = false;
        for (mt_index a = 0; a < mesh->attribute_count; a++) {
            const mt_attribute *attribute = &mesh->attributes[a];
            bool floats =
                attribute->semantic != MT_SEMANTIC_COLOR || attribute->type == MT_F32 || attribute->type == MT_F64;
            has = has || (attribute->semantic == kinds[i].semantic && floats &&
                          (attribute->domain == MT_DOMAIN_VERTEX || attribute->domain == MT_DOMAIN_CORNER));
        }
        if (has) {
            mt_loss_add(loss, "%s (quantised to %u bits)", kinds[i].name, mt_draco_bits(options, kinds[i].kind));
        }
    }
}

mt_status mt_draco_changes(mt_context *context, const mt_mesh *mesh, const mt_draco_options *options, mt_loss *loss)
{
    add_quantised(loss, mesh, options);
    if (is_sequential(options) || mesh->face_count == 0) {
        return MT_OK;
    }
    mt_loss_add(loss, "the order of vertices and faces");
    return mt_loss_add_isolated(context, mesh, loss);
}
