/* Welding within a distance. Points are taken in their order; each joins the lowest-numbered place within the
 * tolerance, or becomes a place itself, so a place never moves and nothing drifts along a chain of near points. Places
 * hang in a hash of cells as wide as the tolerance, so only the 27 cells around a point are looked at.
 *
 * O(points) while places stay apart by the tolerance, as they do by construction: a cell holds a bounded number. */
#include <meshtool/weld.h>

#include <string.h>

typedef struct cell {
    double at[3]; /* whole numbers, kept as doubles: coordinates over the tolerance may pass 64 bits */
} cell;

typedef struct place_table {
    uint64_t slot_count; /* a power of two */
    mt_index *heads;     /* per slot the last place of it, MT_NONE: none */
    mt_index *nexts;     /* per place the one before it in its slot */
    mt_index *points;    /* per place its point */
    mt_index place_count;
    const void *positions;
    mt_type type;
    double tolerance;
} place_table;

static mt_vec3 point_at(const place_table *table, mt_index point)
{
    size_t at = 3 * (size_t)point;
    if (table->type == MT_F64) {
        const double *p = (const double *)table->positions + at;
        return mt_vec3_make(p[0], p[1], p[2]);
    }
    const float *p = (const float *)table->positions + at;
    return mt_vec3_make((double)p[0], (double)p[1], (double)p[2]);
}

static uint64_t slot_of(const place_table *table, cell c)
{
    uint64_t hash = 0;
    for (int axis = 0; axis < 3; axis++) {
        uint64_t bits;
        double number = c.at[axis] + 0.0; /* -0 and 0 are one cell */
        memcpy(&bits, &number, sizeof bits);
        hash = (hash ^ bits) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 29;
    }
    return hash & (table->slot_count - 1);
}

static cell cell_of(const place_table *table, mt_vec3 p)
{
    cell c = {{floor(p.x / table->tolerance), floor(p.y / table->tolerance), floor(p.z / table->tolerance)}};
    return c;
}

static mt_index lowest_in_slot(const place_table *table, uint64_t slot, mt_vec3 p, mt_index best)
{
    for (mt_index place = table->heads[slot]; place != MT_NONE; place = table->nexts[place]) {
        double distance = mt_vec3_length(mt_vec3_subtract(point_at(table, table->points[place]), p));
        if (place < best && distance <= table->tolerance) {
            best = place;
        }
    }
    return best;
}

static mt_index find_place(const place_table *table, mt_vec3 p, cell middle)
{
    mt_index best = MT_NONE;
    for (int i = 0; i < 27; i++) {
        cell c = {{middle.at[0] + i % 3 - 1, middle.at[1] + i / 3 % 3 - 1, middle.at[2] + i / 9 - 1}};
        best = lowest_in_slot(table, slot_of(table, c), p, best);
    }
    return best;
}

static mt_index add_place(place_table *table, mt_index point, const cell *c)
{
    mt_index place = table->place_count++;
    table->points[place] = point;
    if (c) {
        uint64_t slot = slot_of(table, *c);
        table->nexts[place] = table->heads[slot];
        table->heads[slot] = place;
    }
    return place;
}

static void number_points(place_table *table, mt_index point_count, mt_index *numbers)
{
    for (mt_index point = 0; point < point_count; point++) {
        mt_vec3 p = point_at(table, point);
        if (!mt_vec3_is_finite(p)) {
            numbers[point] = add_place(table, point, NULL);
            continue;
        }
        cell c = cell_of(table, p);
        mt_index place = find_place(table, p, c);
        numbers[point] = place == MT_NONE ? add_place(table, point, &c) : place;
    }
}

mt_status mt_weld_within(mt_context *context, const void *positions, mt_type type, mt_index point_count,
                         double tolerance, mt_index *numbers, mt_index *distinct_count)
{
    place_table table = {.slot_count = 1, .positions = positions, .type = type, .tolerance = tolerance};
    while (table.slot_count < point_count) {
        table.slot_count *= 2;
    }
    table.heads = mt_allocate_array(context, table.slot_count, sizeof *table.heads);
    table.nexts = mt_allocate_array(context, point_count, sizeof *table.nexts);
    table.points = mt_allocate_array(context, point_count, sizeof *table.points);
    bool complete = table.heads && table.nexts && table.points;
    if (complete) {
        memset(table.heads, 0xff, table.slot_count * sizeof *table.heads); /* MT_NONE */
        number_points(&table, point_count, numbers);
        *distinct_count = table.place_count;
    }
    mt_free(context, table.points);
    mt_free(context, table.nexts);
    mt_free(context, table.heads);
    return complete ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
}
