/* Distance between words: optimal string alignment (Damerau 1964), by rows. */
#include "nearest.h"

#include <stdbool.h>
#include <string.h>
#include <strings.h>

#define WORD_ROOM 48

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

static size_t distance(const char *a, const char *b)
{
    size_t rows[3][WORD_ROOM + 1];
    size_t a_length = strlen(a), b_length = strlen(b);
    if (a_length > WORD_ROOM || b_length > WORD_ROOM) {
        return WORD_ROOM;
    }
    for (size_t j = 0; j <= b_length; j++) {
        rows[0][j] = j;
    }
    for (size_t i = 1; i <= a_length; i++) {
        size_t *row = rows[i % 3];
        const size_t *above = rows[(i + 2) % 3], *two_above = rows[(i + 1) % 3];
        row[0] = i;
        for (size_t j = 1; j <= b_length; j++) {
            size_t replaced = above[j - 1] + (a[i - 1] != b[j - 1]);
            row[j] = least(replaced, least(above[j], row[j - 1]) + 1);
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                row[j] = least(row[j], two_above[j - 2] + 1);
            }
        }
    }
    return rows[a_length % 3][b_length];
}

const char *cli_nearest(const char *word, const char *const *names, size_t count)
{
    size_t length = strlen(word);
    const char *best = NULL;
    size_t best_distance = length / 3 + 2; /* more than a third mistyped is another word */
    for (size_t i = 0; i < count; i++) {
        bool begins = length >= 2 && strncasecmp(word, names[i], length) == 0;
        size_t apart = begins ? 1 : distance(word, names[i]);
        if (apart < best_distance && apart < strlen(names[i])) {
            best_distance = apart;
            best = names[i];
        }
    }
    return best;
}
