/* How a camera was held when it took a JPEG picture: the tag Orientation of Exif (CIPA DC-008, 4.6.4), in a segment
 * APP1 before the picture. */
#include "formats/image/image_format.h"

#ifdef MESHTOOL_JPEG
#include "formats/image/jpeg_orientation.h"

#include <string.h>

#define TAG_ORIENTATION 0x112
#define SEGMENT_ROOM 256
#define TAG_ROOM 64 /* tags of a directory that are looked at; they are sorted, and this one is among the first */

static unsigned number_at(const uint8_t *bytes, bool is_big)
{
    return is_big ? (unsigned)bytes[0] << 8 | bytes[1] : (unsigned)bytes[1] << 8 | bytes[0];
}

static uint64_t long_at(const uint8_t *bytes, bool is_big)
{
    uint64_t first = number_at(bytes, is_big), second = number_at(bytes + 2, is_big);
    return is_big ? first << 16 | second : second << 16 | first;
}

static bool read_all(const mt_input *input, uint64_t offset, uint8_t *bytes, size_t size)
{
    return mt_input_read_at(input, offset, bytes, size) == size;
}

/* Within the TIFF file that begins at `base`. */
static unsigned search_directory(const mt_input *input, uint64_t base)
{
    uint8_t bytes[12];
    if (!read_all(input, base, bytes, 8)) {
        return 1;
    }
    bool is_big = bytes[0] == 'M';
    uint64_t at = base + long_at(bytes + 4, is_big);
    unsigned count = read_all(input, at, bytes, 2) ? number_at(bytes, is_big) : 0;
    for (unsigned i = 0; i < count && i < TAG_ROOM && read_all(input, at + 2 + 12 * (uint64_t)i, bytes, 12); i++) {
        if (number_at(bytes, is_big) == TAG_ORIENTATION) {
            unsigned turn = number_at(bytes + 8, is_big);
            return turn >= 1 && turn <= 8 ? turn : 1;
        }
    }
    return 1;
}

unsigned mt_jpeg_orientation(const mt_input *input)
{
    uint8_t head[10];
    uint64_t at = 2;
    for (int i = 0; i < SEGMENT_ROOM && read_all(input, at, head, sizeof head) && head[0] == 0xff && head[1] != 0xda;
         i++) {
        if (head[1] == 0xff) { /* any number of these may stand before a marker (ITU T.81, B.1.1.2) */
            at++;
            continue;
        }
        if (head[1] == 0xe1 && memcmp(head + 4, "Exif\0", 6) == 0) {
            return search_directory(input, at + sizeof head);
        }
        at += 2 + (uint64_t)number_at(head + 2, true);
    }
    return 1;
}
#endif
