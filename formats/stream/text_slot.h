/* What the files of the text reader share: the memory of one block at work, and how whole lines are cut for it. */
#ifndef MESHTOOL_STREAM_TEXT_SLOT_H
#define MESHTOOL_STREAM_TEXT_SLOT_H

#include "formats/stream/text.h"

#include <stdatomic.h>

#define MT_TEXT_LOOK_BACK 3 /* a backslash, CR and LF before a block decide whether it begins with a line */
#define MT_TEXT_SLACK 512   /* read past a block at once, so that its last line is mostly there */

typedef struct mt_text_failure {
    mt_status status; /* MT_OK: none */
    uint64_t block;
    uint64_t offset; /* UINT64_MAX: no place */
    bool reading;    /* the input failed at the offset */
    char message[256];
} mt_text_failure;

/* Bytes [base, base + size) of the input. */
typedef struct mt_text_slot {
    atomic_bool busy;
    char *buffer;
    size_t capacity;
    uint64_t base;
    size_t size;
    mt_text_failure failure; /* the first, by block, of those that were parsed here */
} mt_text_slot;

struct mt_text {
    mt_context *context;
    mt_input *input;
    mt_text_options options;
    uint64_t begin, end; /* in the input */
    size_t block_size;
    uint64_t block_count;
    unsigned slot_count;
    mt_text_slot *slots;
    uint64_t *first_lines;
    atomic_uint_fast64_t failed_block;
    /* of the running mt_text_parse */
    mt_text_parse_function parse;
    void *user;
    uint64_t wave_begin;
};

/* Loads block->number: its whole lines then stand between block->begin and block->end. false when that failed, with
 * the failure in the block. */
bool mt_text_slot_load(mt_text *text, mt_text_slot *slot, mt_text_block *block);

#endif
