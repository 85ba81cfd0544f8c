/* ASCII STL. Blocks begin with a facet or a solid and are parsed in parallel; afterwards they are put one behind the
 * other, and it is checked that each begins where the one before it left off, inside or outside of a solid. */
#include "formats/mesh/stl_facets.h"
#include "formats/mesh/stl_solids.h"

#include <string.h>

typedef struct ascii_reader {
    mt_context *context;
    mt_input *input;
    mt_text *text;
    mt_mesh *mesh;
    uint64_t block_count;
    stl_part *parts;        /* per block */
    uint64_t *first_facets; /* per block, and one more: all facets */
    float *normals;         /* when they are read, after all else */
    uint64_t solid_count, junk_lines, contradicting;
} ascii_reader;

static void parse_facets(void *user, mt_text_block *block)
{
    const ascii_reader *r = user;
    mt_stl_parse_part(r->context, block, &r->parts[block->number], NULL);
}

static void parse_normals(void *user, mt_text_block *block)
{
    const ascii_reader *r = user;
    stl_part part = {0};
    mt_stl_parse_part(r->context, block, &part, r->normals + 3 * r->first_facets[block->number]);
    mt_stl_release_part(r->context, &part);
}

static mt_status fail_at(const ascii_reader *r, uint64_t offset, const char *sentence)
{
    return mt_fail_at(r->context, MT_ERROR_SYNTAX, mt_text_place(r->context, r->text, offset), "%s", sentence);
}

/* Checks that the blocks fit together, and adds up what they hold. */
static mt_status join_blocks(ascii_reader *r)
{
    bool inside = false;
    uint64_t facets = 0;
    for (uint64_t i = 0; i < r->block_count; i++) {
        const stl_part *part = &r->parts[i];
        r->first_facets[i] = facets;
        if (!part->is_read) {
            continue;
        }
        if (part->begins_inside != inside) {
            return fail_at(r, part->offset,
                           inside ? "a solid begins inside another, expected \"facet\" or \"endsolid\""
                                  : "a facet stands outside of a solid, expected \"solid\"");
        }
        inside = part->ends_inside;
        facets += part->facet_count;
        r->solid_count += part->solid_count;
        r->junk_lines += part->junk_lines;
        r->contradicting += part->contradicting;
    }
    r->first_facets[r->block_count] = facets;
    if (inside) {
        return fail_at(r, mt_input_size(r->input), "the file ends inside a solid, expected \"endsolid\"");
    }
    if (r->solid_count == 0) {
        return fail_at(r, 0, "there is no \"solid\"");
    }
    if (r->junk_lines) {
        mt_warn(r->context, "%s: %llu lines outside of solids are ignored", mt_input_name(r->input),
                (unsigned long long)r->junk_lines);
    }
    return MT_OK;
}

static mt_status join_positions(ascii_reader *r)
{
    mt_status status = mt_stl_create(r->context, r->first_facets[r->block_count], MT_F64, &r->mesh);
    for (uint64_t i = 0; status == MT_OK && i < r->block_count; i++) {
        stl_part *part = &r->parts[i];
        if (part->facet_count) {
            memcpy((double *)r->mesh->positions + 9 * r->first_facets[i], part->positions,
                   9 * part->facet_count * sizeof(double));
        }
        mt_free(r->context, part->positions);
        part->positions = NULL;
    }
    return status;
}

/* One solid without a name is no label worth keeping. */
static mt_status add_labels(ascii_reader *r)
{
    mt_labels *labels;
    bool named = r->solid_count > 1;
    for (uint64_t i = 0; !named && i < r->block_count; i++) {
        named = r->parts[i].solid_count && r->parts[i].solids[0].name[0];
    }
    if (!named) {
        return MT_OK;
    }
    mt_status status = mt_mesh_add_labels(r->context, r->mesh, MT_LABEL_SOLID, &labels);
    mt_index label = MT_NONE;
    uint64_t facet = 0;
    for (uint64_t i = 0; status == MT_OK && i < r->block_count; i++) {
        const stl_part *part = &r->parts[i];
        for (uint64_t j = 0; status == MT_OK && j <= part->solid_count; j++) {
            uint64_t end =
                r->first_facets[i] + (j < part->solid_count ? part->solids[j].first_facet : part->facet_count);
            for (; facet < end; facet++) {
                labels->face_labels[facet] = label;
            }
            if (j < part->solid_count) {
                status = mt_labels_add_name(r->context, labels, part->solids[j].name, &label);
            }
        }
    }
    return status;
}

static mt_status add_normals(ascii_reader *r)
{
    mt_attribute *attribute;
    if (r->contradicting == 0) {
        return MT_OK;
    }
    mt_status status = mt_stl_add_normals(r->context, r->input, r->mesh, r->contradicting, &attribute);
    if (status == MT_OK) {
        r->normals = attribute->values;
        status = mt_text_parse(r->context, r->text, "reading STL", parse_normals, r);
    }
    return status;
}

static mt_status read_text(ascii_reader *r)
{
    r->block_count = mt_text_block_count(r->text);
    r->parts = mt_allocate_array_zeroed(r->context, r->block_count, sizeof *r->parts);
    r->first_facets = mt_allocate_array(r->context, r->block_count + 1, sizeof *r->first_facets);
    if (!r->parts || !r->first_facets) {
        return mt_context_error(r->context)->status;
    }
    mt_status status = mt_text_parse(r->context, r->text, "reading STL", parse_facets, r);
    if (status == MT_OK) {
        status = join_blocks(r);
    }
    if (status == MT_OK) {
        status = join_positions(r);
    }
    if (status == MT_OK) {
        status = mt_stl_weld(r->context, r->mesh);
    }
    if (status == MT_OK) {
        status = add_labels(r);
    }
    return status == MT_OK ? add_normals(r) : status;
}

mt_status mt_stl_read_ascii(mt_context *context, mt_input *input, mt_mesh **out)
{
    ascii_reader r = {.context = context, .input = input};
    mt_text_options options = {.may_begin = mt_stl_may_begin};
    *out = NULL;
    mt_status status = mt_text_open(context, input, &options, &r.text);
    if (status == MT_OK) {
        status = read_text(&r);
    }
    for (uint64_t i = 0; r.parts && i < r.block_count; i++) {
        mt_stl_release_part(context, &r.parts[i]);
    }
    mt_free(context, r.parts);
    mt_free(context, r.first_facets);
    mt_text_close(context, r.text);
    if (status != MT_OK) {
        mt_mesh_destroy(context, r.mesh);
        return status;
    }
    *out = r.mesh;
    return MT_OK;
}
