/* The strip's last two vertices are always the edge across which it goes on. The edge that it would go on across after
 * the next vertex has the later of the two; where the run turns the other way the earlier one is repeated first, which
 * makes a triangle without area and exchanges them (a swap). Every index after the second turns the orientation over,
 * and a turn that needs no swap is the one that keeps it right. */
#include "lib/algorithms/strips_emit.h"

unsigned mt_strip_end_turn(const strip_graph *graph, const uint8_t *links, mt_index end)
{
    unsigned exit = strip_first_link(links[end]);
    if (exit == 3) {
        return 0;
    }
    strip_side entered = strip_across(graph, end, exit);
    return strip_turn(links[strip_triangle_of(entered)], strip_place_of(entered));
}

unsigned mt_strip_end_corner(const uint8_t *links, mt_index end)
{
    unsigned exit = strip_first_link(links[end]);
    return exit == 3 ? 0 : strip_previous(exit);
}

void mt_strip_emit_index(strip_emitter *emitter, mt_index vertex)
{
    emitter->strips->indices[emitter->index_count++] = vertex;
}

static void count_triangle(strip_emitter *emitter, mt_index triangle)
{
    const mt_triangulation *triangulation = &emitter->graph->triangulation;
    mt_strips *strips = emitter->strips;
    mt_index face = mt_triangulation_face(triangulation, triangle);
    strips->faces[emitter->triangle_count++] = face;
    if (triangle == 0 || mt_triangulation_face(triangulation, triangle - 1) != face) {
        strips->face_runs[face] = strips->run_count;
    }
    emitter->strip_triangles++;
}

/* Its triangle's corner and the next two, the last two exchanged where the orientation turns over. */
static void emit_first(strip_emitter *emitter, mt_index triangle, unsigned corner)
{
    bool odd = (emitter->index_count - emitter->strip_begin) % 2;
    unsigned second = strip_next(corner), third = strip_previous(corner);
    mt_strip_emit_index(emitter, strip_vertex(emitter->graph, triangle, corner));
    mt_strip_emit_index(emitter, strip_vertex(emitter->graph, triangle, odd ? third : second));
    mt_strip_emit_index(emitter, strip_vertex(emitter->graph, triangle, odd ? second : third));
    count_triangle(emitter, triangle);
}

static void emit_next(strip_emitter *emitter, mt_index triangle, unsigned entry, unsigned exit)
{
    if (exit < 3) {
        unsigned kept = exit == strip_next(entry) ? exit : entry; /* the corner that both sides have */
        const mt_index *last = emitter->strips->indices + emitter->index_count - 1;
        if (*last != strip_vertex(emitter->graph, triangle, kept)) {
            mt_strip_emit_index(emitter, last[-1]);
        }
    }
    mt_strip_emit_index(emitter, strip_vertex(emitter->graph, triangle, strip_previous(entry)));
    count_triangle(emitter, triangle);
}

void mt_strip_emit_run(strip_emitter *emitter, mt_index end, unsigned corner)
{
    emit_first(emitter, end, corner);
    unsigned exit = strip_first_link(emitter->links[end]);
    while (exit < 3) {
        strip_side entered = strip_across(emitter->graph, end, exit);
        end = strip_triangle_of(entered);
        exit = strip_exit(emitter->links[end], strip_place_of(entered));
        emit_next(emitter, end, strip_place_of(entered), exit);
    }
    emitter->strips->run_count++;
}

void mt_strip_emit_fan(strip_emitter *emitter, mt_index end)
{
    unsigned exit = strip_first_link(emitter->links[end]), center = exit == 3 ? 0 : strip_next(exit);
    mt_strip_emit_index(emitter, strip_vertex(emitter->graph, end, center));
    mt_strip_emit_index(emitter, strip_vertex(emitter->graph, end, strip_next(center)));
    mt_strip_emit_index(emitter, strip_vertex(emitter->graph, end, strip_previous(center)));
    count_triangle(emitter, end);
    while (exit < 3) {
        strip_side entered = strip_across(emitter->graph, end, exit);
        unsigned entry = strip_place_of(entered);
        end = strip_triangle_of(entered);
        exit = strip_exit(emitter->links[end], entry);
        mt_strip_emit_index(emitter, strip_vertex(emitter->graph, end, strip_previous(entry)));
        count_triangle(emitter, end);
    }
    emitter->strips->run_count++;
}

void mt_strip_emit_end(strip_emitter *emitter)
{
    mt_strips *strips = emitter->strips;
    strips->single_count += emitter->strip_triangles == 1;
    strips->offsets[++strips->strip_count] = emitter->index_count;
    emitter->strip_begin = emitter->index_count;
    emitter->strip_triangles = 0;
}
