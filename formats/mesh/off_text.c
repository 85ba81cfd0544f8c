/* Reading OFF as text. A vertex is a line and a face is a line. Passes over blocks of lines, each in parallel: the
 * first counts the lines that say something, so that every block knows which elements it holds; the last puts all
 * numbers where they belong. Which corners a block holds is known where every face has the sides of the first. Where
 * that turns out wrong, a pass looks at the sides of all, and the last is run again. Linear time; memory: the mesh, and
 * colours twice. */
#include "formats/mesh/off_lines.h"
#include "formats/mesh/uniform_faces.h"

#include "formats/stream/input.h"

/* Where the body begins in the block. */
static const char *body_begin(const mt_off_reader *reader, const mt_text_block *block)
{
    uint64_t size = (uint64_t)(block->end - block->begin);
    if (reader->header.end <= block->offset) {
        return block->begin;
    }
    return reader->header.end - block->offset >= size ? block->end
                                                      : block->begin + (reader->header.end - block->offset);
}

static void count_lines(void *user, mt_text_block *block)
{
    const mt_off_reader *reader = user;
    reader->blocks[block->number].line_count = mt_text_count_telling_lines(body_begin(reader, block), block->end, '#');
}

/* Passes over `count` lines that say something. */
static const char *skip_lines(const char *at, const char *end, uint64_t count)
{
    for (; count > 0; count--) {
        at = mt_skip_line_end(mt_find_line_end(mt_off_next_line(at, end)), end);
    }
    return at;
}

/* Of the block's lines, how many are of vertices, and how many come before its first face. */
static uint64_t face_lines(const mt_off_reader *reader, const mt_off_block *own, uint64_t *before)
{
    uint64_t vertices = reader->header.vertex_count, end = vertices + reader->header.face_count;
    uint64_t first = own->first_line < vertices ? vertices : own->first_line;
    uint64_t last = own->first_line + own->line_count < end ? own->first_line + own->line_count : end;
    *before = first - own->first_line;
    return first < last ? last - first : 0;
}

static void look_at_faces(void *user, mt_text_block *block)
{
    const mt_off_reader *reader = user;
    mt_off_block *own = &reader->blocks[block->number];
    uint64_t before, count = face_lines(reader, own, &before);
    if (count == 0) {
        return;
    }
    const char *at = skip_lines(body_begin(reader, block), block->end, before);
    bool plain = !memchr(at, '\r', (size_t)(block->end - at));
    for (; count > 0; count--) {
        const char *stop;
        at = mt_off_next_line(at, block->end);
        /* A line that is wrong is found wrong when it is parsed. */
        mt_index sides = mt_off_scan_sides(at, &stop);
        own->fewest_sides = sides < own->fewest_sides ? sides : own->fewest_sides;
        own->most_sides = sides > own->most_sides ? sides : own->most_sides;
        own->corner_count += sides;
        at = mt_skip_line_end(plain ? memchr(stop, '\n', (size_t)(block->end - stop) + 1) : mt_find_line_end(stop),
                              block->end);
    }
}

static void parse_block(void *user, mt_text_block *block)
{
    mt_off_reader *reader = user;
    const mt_off_block *own = &reader->blocks[block->number];
    uint64_t vertices = reader->header.vertex_count, end = vertices + reader->header.face_count;
    uint64_t line = own->first_line, last = own->first_line + own->line_count;
    mt_index corner = (mt_index)own->first_corner;
    const char *at = body_begin(reader, block);
    for (last = last < end ? last : end; line < last; line++) {
        at = mt_off_next_line(at, block->end);
        at = line < vertices ? mt_off_scan_vertex(reader, block, at, line)
                             : mt_off_scan_face(reader, block, at, line - vertices, &corner);
        if (!at) {
            return;
        }
        at = mt_skip_line_end(mt_find_line_end(at), block->end);
    }
}

/* Numbers the lines; checks that there are as many as the counts say, before anything is allocated for them. */
static mt_status number_lines(mt_off_reader *reader)
{
    uint64_t lines = 0, expected = reader->header.vertex_count + reader->header.face_count;
    mt_place place = {.file = mt_text_name(reader->text)};
    for (uint64_t i = 0; i < reader->block_count; i++) {
        reader->blocks[i].first_line = lines;
        reader->blocks[i].fewest_sides = MT_NONE;
        lines += reader->blocks[i].line_count;
    }
    if (lines < expected) {
        return mt_fail_at(reader->context, MT_ERROR_SYNTAX, place,
                          "the file ends after %llu of %llu vertices and faces, expected one a line",
                          (unsigned long long)lines, (unsigned long long)expected);
    }
    if (lines > expected) {
        mt_warn(reader->context, "%s: %llu lines after the last face are left out", place.file,
                (unsigned long long)(lines - expected));
    }
    return MT_OK;
}

static mt_status create_mesh(mt_off_reader *reader, const mt_mesh_layout *layout)
{
    mt_status status = mt_mesh_create(reader->context, layout, &reader->mesh);
    if (status == MT_OK) {
        status = mt_off_add_attributes(reader->context, reader->mesh, &reader->header, MT_F64);
    }
    if (status == MT_OK) {
        const mt_attribute *normals = mt_mesh_find_attribute(reader->mesh, MT_SEMANTIC_NORMAL, MT_DOMAIN_VERTEX);
        const mt_attribute *uvs = mt_mesh_find_attribute(reader->mesh, MT_SEMANTIC_UV, MT_DOMAIN_VERTEX);
        reader->normals = normals ? normals->values : NULL;
        reader->uvs = uvs ? uvs->values : NULL;
    }
    return status;
}

static mt_mesh_layout layout_of(const mt_off_header *header)
{
    return (mt_mesh_layout){
        .vertex_count = header->vertex_count, .face_count = header->face_count, .position_type = MT_F64};
}

static void look_at_first_face(void *user, mt_text_block *block)
{
    mt_off_reader *reader = user;
    const char *stop, *begin = body_begin(reader, block);
    uint64_t before = reader->header.vertex_count - reader->blocks[block->number].first_line;
    reader->sides = mt_off_scan_sides(mt_off_next_line(skip_lines(begin, block->end, before), block->end), &stop);
}

/* The block that the first face begins in. */
static uint64_t first_face_block(const mt_off_reader *reader)
{
    uint64_t first = 0;
    while (first < reader->block_count &&
           reader->blocks[first].first_line + reader->blocks[first].line_count <= reader->header.vertex_count) {
        first++;
    }
    return first;
}

/* Finds out the sides of the first face, where all may have as many. */
static mt_status find_sides(mt_off_reader *reader)
{
    uint64_t block = first_face_block(reader);
    if (block == reader->block_count || reader->header.face_count == 0) {
        return MT_OK;
    }
    mt_status status =
        mt_text_parse_some(reader->context, reader->text, "counting", block, block + 1, look_at_first_face, reader);
    if (!mt_may_be_uniform(reader->text, reader->sides, reader->header.face_count)) {
        reader->sides = 0;
    }
    return status;
}

/* Whether a block met a face of other sides; forgets it, and the colours that it kept. */
static bool forget_differing(mt_off_reader *reader)
{
    bool differs = false;
    for (uint64_t i = 0; i < reader->block_count; i++) {
        differs |= reader->blocks[i].differs;
    }
    for (uint64_t i = 0; differs && i < reader->block_count; i++) {
        mt_off_release_colors(reader->context, &reader->blocks[i].vertex_colors);
        mt_off_release_colors(reader->context, &reader->blocks[i].face_colors);
    }
    return differs;
}

/* Reads all as if every face had the sides of the first. *done is false when one has not, or for so many corners there
 * is no memory. */
static mt_status read_uniform(mt_off_reader *reader, bool *done)
{
    *done = false;
    mt_status status = find_sides(reader);
    if (status != MT_OK || reader->sides == 0) {
        return status;
    }
    mt_mesh_layout layout = layout_of(&reader->header);
    layout.face_size = reader->sides;
    layout.corner_count = layout.face_count * reader->sides;
    for (uint64_t i = 0; i < reader->block_count; i++) {
        uint64_t line = reader->blocks[i].first_line, vertices = layout.vertex_count;
        reader->blocks[i].first_corner = line < vertices ? 0 : (line - vertices) * reader->sides;
    }
    status = create_mesh(reader, &layout);
    if (status == MT_OK) {
        status = mt_text_parse(reader->context, reader->text, "reading", parse_block, reader);
        *done = !forget_differing(reader);
    }
    /* Faces that differ need less, perhaps, than was asked for. */
    if (status != MT_OK && !*done) {
        mt_context_clear_error(reader->context);
        mt_mesh_destroy(reader->context, reader->mesh);
        reader->mesh = NULL;
        status = MT_OK;
    }
    reader->sides = 0;
    return status;
}

/* Makes the mesh for the faces that were looked at. */
static mt_status create_mixed_mesh(mt_off_reader *reader)
{
    mt_index fewest = MT_NONE, most = 0;
    mt_mesh_layout layout = layout_of(&reader->header);
    for (uint64_t i = 0; i < reader->block_count; i++) {
        mt_off_block *block = &reader->blocks[i];
        block->first_corner = layout.corner_count;
        layout.corner_count += block->corner_count;
        fewest = block->fewest_sides < fewest ? block->fewest_sides : fewest;
        most = block->most_sides > most ? block->most_sides : most;
    }
    layout.face_size = layout.face_count == 0 ? 3 : fewest == most ? most : 0;
    return create_mesh(reader, &layout);
}

/* Looks at the sides of all faces first. */
static mt_status read_mixed(mt_off_reader *reader)
{
    mt_status status = mt_text_parse_some(reader->context, reader->text, "counting", first_face_block(reader),
                                          reader->block_count, look_at_faces, reader);
    if (status == MT_OK) {
        status = create_mixed_mesh(reader);
    }
    return status == MT_OK ? mt_text_parse(reader->context, reader->text, "reading", parse_block, reader) : status;
}

static mt_status finish_colors(mt_off_reader *reader, bool of_faces)
{
    mt_off_colors *parts = mt_allocate_array(reader->context, reader->block_count, sizeof *parts);
    if (!parts) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    for (uint64_t i = 0; i < reader->block_count; i++) {
        mt_off_block *block = &reader->blocks[i];
        mt_off_colors *colors = of_faces ? &block->face_colors : &block->vertex_colors;
        parts[i] = *colors;
        *colors = (mt_off_colors){0};
    }
    mt_status status = mt_off_finish_colors(reader->context, parts, reader->block_count, mt_text_name(reader->text),
                                            reader->mesh, of_faces ? MT_DOMAIN_FACE : MT_DOMAIN_VERTEX);
    mt_free(reader->context, parts);
    return status;
}

static mt_status read_body(mt_context *context, mt_off_reader *reader)
{
    reader->blocks = mt_allocate_array_zeroed(context, mt_text_block_count(reader->text), sizeof *reader->blocks);
    if (!reader->blocks) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    reader->block_count = mt_text_block_count(reader->text);
    mt_status status = mt_text_parse(context, reader->text, "counting", count_lines, reader);
    if (status == MT_OK) {
        status = number_lines(reader);
    }
    bool uniform = false;
    if (status == MT_OK) {
        status = read_uniform(reader, &uniform);
    }
    if (status == MT_OK && !uniform) {
        status = read_mixed(reader);
    }
    if (status == MT_OK) {
        status = finish_colors(reader, false);
    }
    return status == MT_OK ? finish_colors(reader, true) : status;
}

mt_status mt_off_read_text(mt_context *context, mt_input *input, mt_mesh **out)
{
    mt_off_reader reader = {.context = context};
    mt_status status = mt_text_open(context, input, NULL, &reader.text);
    if (status == MT_OK) {
        status = mt_off_read_header(context, reader.text, &reader.header);
    }
    if (status == MT_OK) {
        status = read_body(context, &reader);
    }
    for (uint64_t i = 0; i < reader.block_count; i++) {
        mt_off_release_colors(context, &reader.blocks[i].vertex_colors);
        mt_off_release_colors(context, &reader.blocks[i].face_colors);
    }
    mt_free(context, reader.blocks);
    mt_text_close(context, reader.text);
    if (status != MT_OK) {
        mt_mesh_destroy(context, reader.mesh);
        reader.mesh = NULL;
    }
    *out = reader.mesh;
    return status;
}
