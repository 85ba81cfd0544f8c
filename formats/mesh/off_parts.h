/* What the files of the OFF format share. */
#ifndef MESHTOOL_OFF_PARTS_H
#define MESHTOOL_OFF_PARTS_H

#include "formats/stream/cursor.h"
#include "formats/stream/text.h"

#include <meshtool/mesh.h>

typedef struct mt_off_header {
    bool normals, colors, uvs; /* what every vertex has beside its position */
    bool binary;
    uint64_t vertex_count, face_count;
    uint64_t end; /* the first byte after it in the input */
} mt_off_header;

/* How many bytes of [begin, end) are the header's word ("STCNOFF"), 0 when it is none. Fills in what it says.
 * *dimension receives '4' or 'n' where the word has them, else 0. */
size_t mt_off_header_word(const char *begin, const char *end, mt_off_header *header, char *dimension);

/* Reads the header of a text. */
mt_status mt_off_read_header(mt_context *context, mt_text *text, mt_off_header *out);

/* The next line that says something at or after `at`: past blank lines and comments; `end` when there is none. */
static inline const char *mt_off_next_line(const char *at, const char *end)
{
    while (at < end) {
        at = mt_skip_blanks(at);
        if (!mt_is_line_end(*at) && *at != '#') {
            return at < end ? at : end;
        }
        at = mt_skip_line_end(mt_find_line_end(at), end);
    }
    return end;
}

/* Colours as they are met: of any number of components, whole numbers or not. Whole numbers are shares of 255 when one
 * of the colour is above 1; a colour of zeros and ones is what the others are. */
typedef struct mt_off_colors {
    double *values; /* 4 an element, the missing ones NAN */
    uint8_t *kinds; /* per element */
    uint64_t first; /* element; those before it and after the last have none */
    uint64_t count, capacity;
} mt_off_colors;

/* Adds the colour of an element, which must be the one after the last that was added: `count` components, 0 when it
 * has none; whole: all were written so. false when memory is missing. */
bool mt_off_add_color(mt_context *context, mt_off_colors *colors, uint64_t element, const double *components,
                      unsigned count, bool whole);
void mt_off_release_colors(mt_context *context, mt_off_colors *colors);

/* The colours of all parts as an attribute of a domain; no attribute where no element has one. Frees the parts. */
mt_status mt_off_finish_colors(mt_context *context, mt_off_colors *parts, uint64_t part_count, const char *name,
                               mt_mesh *mesh, mt_domain domain);

/* Normals and UVs that the header promises, of one type. */
mt_status mt_off_add_attributes(mt_context *context, mt_mesh *mesh, const mt_off_header *header, mt_type type);

mt_status mt_off_read_text(mt_context *context, mt_input *input, mt_mesh **out);
mt_status mt_off_read_binary(mt_context *context, mt_input *input, const mt_off_header *header, mt_mesh **out);
mt_status mt_off_write(mt_context *context, const mt_mesh *mesh, const mt_mesh_write_options *options,
                       mt_output *output);

#endif
