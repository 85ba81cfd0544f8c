/* A record is one line. The lines of every block are counted first, so that each block knows which records it holds;
 * then all are parsed in parallel, and everything goes to its place at once. Faces do as long as each has as many sides
 * as the first; where one has not, all is parsed again, and the faces are gathered by block and joined at the end. */
#include "formats/mesh/ply_body.h"
#include "formats/mesh/ply_lines.h"
#include "formats/mesh/uniform_faces.h"
#include "formats/stream/cursor.h"
#include "formats/stream/text.h"

typedef struct ascii_reader {
    mt_context *context;
    mt_input *input;
    ply_plan *plan;
    mt_text *text;
    uint64_t *element_lines; /* per element its first line, and one more: the end; blank lines do not count */
    uint64_t *block_lines;   /* per block its first line, and one more: all lines */
    ply_faces *parts;        /* per block */
    mt_index *overflows;     /* per block the numbers that are infinite as float */
    uint64_t sides;          /* of the first face */
    bool differs;            /* another one has others */
} ascii_reader;

static void count_lines(void *user, mt_text_block *block)
{
    const ascii_reader *r = user;
    r->block_lines[block->number] = mt_text_count_telling_lines(block->begin, block->end, 0);
}

/* How many of a block's lines are faces. */
static uint64_t faces_within(const ascii_reader *r, uint64_t block)
{
    if (r->plan->mesh->face_count == 0) {
        return 0;
    }
    uint64_t first = r->element_lines[r->plan->faces], last = r->element_lines[r->plan->faces + 1];
    uint64_t begin = r->block_lines[block] < first ? first : r->block_lines[block];
    uint64_t end = r->block_lines[block + 1] < last ? r->block_lines[block + 1] : last;
    return begin < end ? end - begin : 0;
}

static void parse_block(void *user, mt_text_block *block)
{
    const ascii_reader *r = user;
    const uint64_t *starts = r->element_lines;
    uint64_t line = r->block_lines[block->number], end = starts[r->plan->header.element_count];
    r->overflows[block->number] = 0;
    ply_line l = {.context = r->context,
                  .plan = r->plan,
                  .block = block,
                  .faces = &r->parts[block->number],
                  .face_count = faces_within(r, block->number),
                  .overflows = &r->overflows[block->number],
                  .at = block->begin};
    while (l.at < block->end && line < end) {
        l.at = mt_skip_blanks(l.at);
        if (!mt_is_line_end(*l.at)) {
            while (line >= starts[l.element + 1]) {
                l.element++;
            }
            l.record = line - starts[l.element];
            if (!mt_ply_read_line(&l)) {
                return;
            }
            line++;
        }
        l.at = mt_skip_line_end(mt_find_line_end(l.at), block->end);
    }
}

/* Turns counts into first lines; the sum goes behind the last. */
static void sum_up(uint64_t *counts, uint64_t count)
{
    uint64_t sum = 0;
    for (uint64_t i = 0; i < count; i++) {
        uint64_t next = sum + counts[i];
        counts[i] = sum;
        sum = next;
    }
    counts[count] = sum;
}

/* Every block's part of the mesh's corners, or of none. */
static void lend_corners(ascii_reader *r, mt_index *corners, uint64_t sides)
{
    uint64_t face = 0;
    for (uint64_t i = 0; i < mt_text_block_count(r->text); i++) {
        uint64_t count = faces_within(r, i);
        bool differs = r->parts[i].differs;
        r->parts[i] = (ply_faces){.vertices = corners ? corners + sides * face : NULL,
                                  .corner_room = corners ? sides * count : 0,
                                  .has_uvs = r->plan->has_corner_uvs,
                                  .uv_type = r->plan->corner_uv_type,
                                  .sides = sides};
        r->differs |= differs;
        face += count;
    }
}

static mt_status prepare(ascii_reader *r)
{
    const ply_header *header = &r->plan->header;
    uint64_t blocks = mt_text_block_count(r->text);
    r->element_lines = mt_allocate_array(r->context, (uint64_t)header->element_count + 1, sizeof *r->element_lines);
    r->block_lines = mt_allocate_array_zeroed(r->context, blocks + 1, sizeof *r->block_lines);
    r->parts = mt_allocate_array_zeroed(r->context, blocks + 1, sizeof *r->parts);
    r->overflows = mt_allocate_array_zeroed(r->context, blocks, sizeof *r->overflows);
    if (!r->element_lines || !r->block_lines || !r->parts || !r->overflows) {
        return mt_context_error(r->context)->status;
    }
    for (uint32_t i = 0; i < header->element_count; i++) {
        const ply_element *element = &header->elements[i];
        r->element_lines[i] = element->property_count ? element->count : 0; /* a record of nothing is a blank line */
    }
    sum_up(r->element_lines, header->element_count);
    lend_corners(r, NULL, 0);
    return MT_OK;
}

static mt_status check_line_count(ascii_reader *r)
{
    uint32_t count = r->plan->header.element_count;
    uint64_t blocks = mt_text_block_count(r->text), lines = r->block_lines[blocks], expected = r->element_lines[count];
    if (lines > expected) {
        mt_warn(r->context, "%s: %llu lines after the last element are ignored", mt_input_name(r->input),
                (unsigned long long)(lines - expected));
    }
    if (lines >= expected) {
        return MT_OK;
    }
    uint32_t element = 0;
    while (lines >= r->element_lines[element + 1]) {
        element++;
    }
    mt_place place = mt_text_place(r->context, r->text, r->plan->header.body_offset + mt_text_size(r->text));
    return mt_fail_at(
        r->context, MT_ERROR_SYNTAX, place, "the file ends after %llu of the %llu records of element \"%.80s\"",
        (unsigned long long)(lines - r->element_lines[element]),
        (unsigned long long)r->plan->header.elements[element].count, r->plan->header.elements[element].name);
}

/* The length of the list of vertices in the line; 0 where it is not told at once. */
static uint64_t scan_sides(const ply_plan *plan, const char *at)
{
    const ply_element *faces = &plan->header.elements[plan->faces];
    for (uint32_t i = 0; i < faces->property_count; i++) {
        const char *stop;
        at = mt_skip_blanks(at);
        if (plan->targets[plan->faces][i].use == PLY_FACE_VERTICES) {
            return mt_scan_unsigned(at, &stop);
        }
        if (faces->properties[i].is_list) {
            return 0;
        }
        at = mt_skip_word(at);
    }
    return 0;
}

static void look_at_first_face(void *user, mt_text_block *block)
{
    ascii_reader *r = user;
    uint64_t line = r->block_lines[block->number], first = r->element_lines[r->plan->faces];
    for (const char *at = block->begin; at < block->end; at = mt_skip_line_end(mt_find_line_end(at), block->end)) {
        at = mt_skip_blanks(at);
        if (!mt_is_line_end(*at) && line++ == first) {
            r->sides = scan_sides(r->plan, at);
            return;
        }
    }
}

/* Finds out the sides of the first face, where all may have as many and go straight to their places. */
static mt_status find_sides(ascii_reader *r)
{
    uint64_t blocks = mt_text_block_count(r->text), block = 0;
    if (r->plan->mesh->face_count == 0 || r->plan->has_corner_uvs) {
        return MT_OK;
    }
    while (block < blocks && r->block_lines[block + 1] <= r->element_lines[r->plan->faces]) {
        block++;
    }
    mt_status status = mt_text_parse_some(r->context, r->text, "reading PLY", block, block < blocks ? block + 1 : block,
                                          look_at_first_face, r);
    if (!mt_may_be_uniform(r->text, r->sides, r->plan->mesh->face_count)) {
        r->sides = 0;
    }
    return status;
}

/* Reads all as if every face were like the first. *done is false when one is not, the first is of no use, or for
 * so many corners there is no memory. */
static mt_status read_uniform(ascii_reader *r, bool *done)
{
    mt_mesh *mesh = r->plan->mesh;
    *done = false;
    mt_status status = find_sides(r);
    if (status != MT_OK || r->sides == 0) {
        return status;
    }
    /* Faces that differ may need less than these. */
    mt_index *corners = mt_try_allocate(r->context, r->sides * mesh->face_count * sizeof *corners);
    if (!corners) {
        return MT_OK;
    }
    mt_free(r->context, mesh->corner_vertices); /* of a mesh that has none */
    mesh->corner_vertices = corners;
    lend_corners(r, corners, r->sides);
    status = mt_text_parse(r->context, r->text, "reading PLY", parse_block, r);
    lend_corners(r, NULL, 0);
    if (r->differs) {
        mt_context_clear_error(r->context);
        mt_free(r->context, mesh->corner_vertices);
        mesh->corner_vertices = NULL;
        return MT_OK;
    }
    mesh->corner_count = (mt_index)(r->sides * mesh->face_count);
    mesh->face_size = (mt_index)r->sides;
    mt_free(r->context, mesh->face_offsets);
    mesh->face_offsets = NULL;
    *done = true;
    return status;
}

/* Joins the faces of all blocks; offsets within a block become offsets in the mesh. */
static mt_status join_faces(ascii_reader *r)
{
    mt_mesh *mesh = r->plan->mesh;
    uint64_t blocks = mt_text_block_count(r->text), base = 0;
    if (mesh->face_count == 0) {
        return MT_OK;
    }
    uint64_t first = r->element_lines[r->plan->faces], last = first + mesh->face_count;
    for (uint64_t i = 0; i < blocks; i++) {
        uint64_t begin = r->block_lines[i] < first ? first : r->block_lines[i];
        uint64_t end = r->block_lines[i + 1] < last ? r->block_lines[i + 1] : last;
        for (uint64_t line = begin; line < end; line++) {
            mesh->face_offsets[line - first + 1] += (mt_index)base;
        }
        base += r->parts[i].corner_count;
    }
    mt_status status = mt_ply_faces_finish(r->context, r->parts, (size_t)blocks, mesh);
    if (status == MT_OK) {
        mt_mesh_compact_faces(r->context, mesh);
    }
    return status;
}

static mt_status read_text(ascii_reader *r)
{
    uint64_t blocks = mt_text_block_count(r->text);
    bool uniform = false;
    mt_status status = mt_text_parse(r->context, r->text, "reading PLY", count_lines, r);
    if (status == MT_OK) {
        sum_up(r->block_lines, blocks);
        status = read_uniform(r, &uniform);
    }
    if (status == MT_OK && !uniform) {
        status = mt_text_parse(r->context, r->text, "reading PLY", parse_block, r);
    }
    if (status == MT_OK) {
        status = check_line_count(r);
    }
    if (status == MT_OK && !uniform) {
        status = join_faces(r);
    }
    uint64_t overflows = 0;
    for (uint64_t i = 0; status == MT_OK && i < blocks; i++) {
        overflows += r->overflows[i];
    }
    if (overflows) {
        mt_warn(r->context,
                "%s: %llu numbers are too large for the float that they are declared as and became infinite",
                mt_input_name(r->input), (unsigned long long)overflows);
    }
    return status;
}

mt_status mt_ply_read_ascii(mt_context *context, mt_input *input, ply_plan *plan)
{
    ascii_reader r = {.context = context, .input = input, .plan = plan};
    mt_text_options options = {.lines_before = plan->header.body_line - 1};
    mt_status status = mt_text_open(context, input, &options, &r.text);
    if (status == MT_OK) {
        status = prepare(&r);
    }
    if (status == MT_OK) {
        status = read_text(&r);
    }
    uint64_t blocks = r.parts ? mt_text_block_count(r.text) : 0;
    for (uint64_t i = 0; i < blocks; i++) {
        mt_ply_faces_release(context, &r.parts[i]);
    }
    mt_free(context, r.element_lines);
    mt_free(context, r.block_lines);
    mt_free(context, r.parts);
    mt_free(context, r.overflows);
    mt_text_close(context, r.text);
    return status;
}
