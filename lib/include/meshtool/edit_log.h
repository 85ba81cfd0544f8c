/* What surgery did to values: each entry says that an element's value becomes (1 - weight) * a + weight * b. Replayed
 * in order over any array, it lets positions and attributes follow. */
#ifndef MESHTOOL_EDIT_LOG_H
#define MESHTOOL_EDIT_LOG_H

#include <meshtool/attribute.h>
#include <meshtool/context.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct mt_edit {
    mt_domain domain; /* vertex, face, or corner: then the elements are the structure's half-edges, by their tails */
    mt_index target, a, b;
    double weight; /* 0: a alone; 1: b alone */
} mt_edit;

typedef struct mt_edit_log {
    uint64_t count, capacity;
    mt_edit *edits;
} mt_edit_log;

/* Makes room for `more` entries. */
mt_status mt_edit_log_reserve(mt_context *context, mt_edit_log *log, uint64_t more);
void mt_edit_log_release(mt_context *context, mt_edit_log *log);

/* Appends; room must have been reserved. */
void mt_edit_log_add(mt_edit_log *log, mt_domain domain, mt_index target, mt_index a, mt_index b, double weight);

/* Applies the domain's entries to `values`, component_count for each element, old and new ones, the deleted included.
 * MT_INTERPOLATE_NONE copies the heavier parent; MT_INTERPOLATE_UNIT makes what it mixes of unit length where that can
 * be done. O(entries). */
void mt_edit_log_replay(const mt_edit_log *log, mt_domain domain, mt_interpolation interpolation,
                        uint32_t component_count, double *values);

#ifdef __cplusplus
}
#endif
#endif
