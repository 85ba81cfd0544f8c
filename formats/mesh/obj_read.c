/* Reading OBJ: blocks of whole lines are parsed in parallel, each into arrays of its own; then every element is
 * numbered, references are settled, and the arrays are put together. One pass over the file, linear time; memory:
 * the mesh twice, and for each thread a block of text and what the last pieces of its store have left. References may
 * point forward, so that a wrong one is known at the end only: the file is then read again to find its line. */
#include "formats/mesh/obj.h"

#include "formats/mesh/obj_merge.h"

/* No relative reference passes the start while it is not known. */
#define UNKNOWN_BASE ((uint64_t)1 << 40)

static void parse_block(void *user, mt_text_block *text)
{
    mt_obj_reader *reader = user;
    mt_obj_block *block = &reader->blocks[text->number];
    mt_obj_bases bases = {{UNKNOWN_BASE, UNKNOWN_BASE, UNKNOWN_BASE}};
    mt_obj_store_begin(&reader->stores[text->slot], block);
    mt_obj_parse(reader->context, text, &reader->limits, &bases, block);
    mt_obj_store_keep(block);
}

/* Parses again, now that every count is known, the blocks that have a wrong reference. */
static void parse_block_again(void *user, mt_text_block *text)
{
    mt_obj_reader *reader = user;
    if (reader->wrong[text->number]) {
        mt_obj_block again;
        mt_obj_store_begin(&reader->stores[text->slot], &again);
        mt_obj_parse(reader->context, text, &reader->limits, &reader->bases[text->number], &again);
    }
}

static mt_status find_wrong_reference(mt_context *context, mt_obj_reader *reader)
{
    for (uint64_t i = 0; i < reader->block_count; i++) {
        if (reader->wrong[i]) {
            mt_status status =
                mt_text_parse(context, reader->text, "looking for the line of an error", parse_block_again, reader);
            return status != MT_OK ? status
                                   : mt_fail(context, MT_ERROR_INTERNAL, "%s: a wrong reference was lost",
                                             mt_text_name(reader->text));
        }
    }
    return MT_OK;
}

/* Relative references are settled, or wrong. */
static void release_lists(mt_context *context, mt_obj_reader *reader)
{
    static const mt_obj_series lists[] = {MT_OBJ_RELATIVE_CORNERS, MT_OBJ_RELATIVE_UVS, MT_OBJ_RELATIVE_NORMALS,
                                          MT_OBJ_RELATIVE_WIRES, MT_OBJ_RELATIVE_POINTS};
    for (size_t i = 0; i < sizeof lists / sizeof lists[0]; i++) {
        mt_obj_release_series(context, reader, lists[i]);
    }
}

static mt_status create_reader(mt_context *context, mt_obj_reader *reader)
{
    uint64_t blocks = mt_text_block_count(reader->text);
    reader->blocks = mt_allocate_array_zeroed(context, blocks, sizeof *reader->blocks);
    reader->store_count = mt_text_slot_count(reader->text);
    reader->stores = mt_allocate_array_zeroed(context, reader->store_count, sizeof *reader->stores);
    reader->bases = mt_allocate_array(context, blocks, sizeof *reader->bases);
    reader->first_faces = mt_allocate_array(context, blocks, sizeof *reader->first_faces);
    reader->first_corners = mt_allocate_array(context, blocks, sizeof *reader->first_corners);
    reader->wrong = mt_allocate_array_zeroed(context, blocks, sizeof *reader->wrong);
    for (unsigned i = 0; reader->stores && i < reader->store_count; i++) {
        reader->stores[i].largest = mt_obj_store_piece(mt_text_size(reader->text), reader->store_count);
    }
    bool complete = reader->blocks && reader->stores && reader->bases && reader->first_faces && reader->first_corners &&
                    reader->wrong;
    reader->block_count = complete ? blocks : 0;
    for (int element = 0; element < MT_OBJ_ELEMENT_COUNT; element++) {
        reader->limits.counts[element] = MT_INDEX_MAX;
    }
    return complete ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
}

static void release_reader(mt_context *context, mt_obj_reader *reader)
{
    for (unsigned i = 0; reader->stores && i < reader->store_count; i++) {
        mt_obj_store_release(context, &reader->stores[i]);
    }
    void *arrays[] = {reader->blocks,      reader->stores,        reader->bases,
                      reader->first_faces, reader->first_corners, reader->wrong};
    for (size_t i = 0; i < sizeof arrays / sizeof arrays[0]; i++) {
        mt_free(context, arrays[i]);
    }
    mt_text_close(context, reader->text);
}

/* A file without one known statement, but with others, is no OBJ. */
static mt_status check_statements(mt_context *context, const mt_obj_reader *reader)
{
    uint64_t known = 0;
    for (uint64_t i = 0; i < reader->block_count; i++) {
        known += reader->blocks[i].statement_count;
    }
    for (uint64_t i = 0; known == 0 && i < reader->block_count; i++) {
        if (reader->blocks[i].counts[MT_OBJ_EVENTS] > 0) {
            const mt_obj_event *event = reader->blocks[i].items[MT_OBJ_EVENTS];
            return mt_fail_at(context, MT_ERROR_SYNTAX, mt_text_place(context, reader->text, event->offset),
                              "no OBJ statement is in this file, which begins with \"%s\"",
                              (const char *)reader->blocks[i].items[MT_OBJ_NAMES] + event->name);
        }
    }
    return MT_OK;
}

mt_status mt_obj_read(mt_context *context, mt_input *input, const mt_mesh_read_options *options, mt_mesh **out)
{
    mt_text_options text_options = {.continuations = true};
    mt_obj_reader reader = {.context = context};
    (void)options;
    *out = NULL;
    mt_status status = mt_text_open(context, input, &text_options, &reader.text);
    if (status != MT_OK) {
        return status;
    }
    status = create_reader(context, &reader);
    if (status == MT_OK) {
        status = mt_text_parse(context, reader.text, "reading", parse_block, &reader);
    }
    if (status == MT_OK) {
        status = check_statements(context, &reader);
    }
    if (status == MT_OK) {
        status = mt_obj_count(context, &reader);
    }
    if (status == MT_OK) {
        mt_obj_resolve(context, &reader);
        status = find_wrong_reference(context, &reader);
        release_lists(context, &reader);
    }
    if (status == MT_OK) {
        status = mt_obj_merge(context, &reader, out);
    }
    if (status == MT_OK) {
        mt_obj_warn(context, &reader);
    }
    release_reader(context, &reader);
    return status;
}
