/* The cut at level 0. Source of what is sharp: OpenSubdiv 3.5, TopologyRefinerFactoryBase: a vertex where sheets meet
 * is infinitely sharp, unless it lies inside of one crease of sheets: two shared edges, no boundary, more faces than
 * edges. Known difference: there, any other crease that ends at such a vertex makes it infinitely sharp here, and
 * blends there. */
#include "lib/algorithms/subdivide_crease.h"
#include "lib/algorithms/subdivide_cut.h"

#include <meshtool/split_non_manifold.h>

#include <string.h>

/* What meets at a vertex of the mesh as it was. */
typedef struct meeting {
    mt_index face_count, edge_count, boundary_count, shared_count;
    bool copied; /* the cut made several of it */
    bool creased;
} meeting;

typedef struct cutter {
    const mt_mesh *mesh;
    const mt_edge_pairs *pairs;
    mt_subdivide_cut *cut;
    mt_edge_pairs *cut_pairs;
    meeting *meetings;
} cutter;

static bool is_shared(const cutter *c, mt_index corner)
{
    mt_edge_class class = mt_edge_class_of(c->mesh, c->pairs, corner);
    return class == MT_EDGE_NON_MANIFOLD || class == MT_EDGE_MISORIENTED;
}

static mt_index next_corner(const mt_mesh *mesh, mt_index face, mt_index corner)
{
    return corner + 1 < mt_mesh_face_end(mesh, face) ? corner + 1 : mt_mesh_face_begin(mesh, face);
}

static void count_meetings(cutter *c)
{
    const mt_mesh *mesh = c->mesh;
    for (mt_index face = 0; face < mesh->face_count; face++) {
        for (mt_index corner = mt_mesh_face_begin(mesh, face); corner < mt_mesh_face_end(mesh, face); corner++) {
            meeting *ends[2] = {&c->meetings[mesh->corner_vertices[corner]],
                                &c->meetings[mesh->corner_vertices[next_corner(mesh, face, corner)]]};
            ends[0]->face_count++;
            for (unsigned i = 0; i < 2 && mt_edge_is_first(c->pairs, corner); i++) {
                ends[i]->edge_count++;
                ends[i]->boundary_count += mt_edge_class_of(mesh, c->pairs, corner) == MT_EDGE_BOUNDARY;
                ends[i]->shared_count += is_shared(c, corner);
            }
        }
    }
    for (mt_index vertex = mesh->vertex_count; vertex < c->cut->mesh->vertex_count; vertex++) {
        c->meetings[c->cut->sources[vertex]].copied = true;
    }
    for (mt_index i = 0; i < c->cut->mesh->crease_count; i++) {
        const mt_edge_value *crease = &c->cut->mesh->creases[i];
        c->meetings[c->cut->sources[crease->a]].creased |= crease->value > 0;
        c->meetings[c->cut->sources[crease->b]].creased |= crease->value > 0;
    }
}

static bool is_sharp(const meeting *at, bool corners)
{
    if (corners && at->face_count == 1 && at->edge_count == 2) {
        return true;
    }
    bool within_crease = at->shared_count == 2 && at->boundary_count == 0 && at->face_count > at->edge_count;
    return (at->copied || at->shared_count > 0) && (!within_crease || at->creased);
}

static mt_status sharpen_vertices(mt_context *context, cutter *c, bool corners)
{
    mt_mesh *cut = c->cut->mesh;
    uint64_t room = (uint64_t)cut->sharp_vertex_count + cut->vertex_count;
    mt_vertex_value *grown = mt_reallocate(context, cut->sharp_vertices, room * sizeof *grown);
    if (!grown) {
        return mt_context_error(context)->status;
    }
    cut->sharp_vertices = grown;
    for (mt_index vertex = 0; vertex < cut->vertex_count; vertex++) {
        if (is_sharp(&c->meetings[c->cut->sources[vertex]], corners)) {
            grown[cut->sharp_vertex_count++] = (mt_vertex_value){vertex, (double)MT_SHARPNESS_INFINITE};
        }
    }
    return MT_OK;
}

/* Each side of a shared edge, one of two where the cut left two together: that edge is a crease then. The sides of an
 * edge form a ring, from the lowest corner of which it is numbered. */
static mt_index list_ring(cutter *c, mt_index first, mt_index face, mt_cut_side *sides, mt_edge_value *creases,
                          mt_index *crease_count)
{
    const mt_mesh *mesh = c->mesh, *cut = c->cut->mesh;
    mt_index count = 0, corner = first;
    do {
        mt_index own_face = corner == first ? face : mt_mesh_corner_face(mesh, corner);
        mt_index next = next_corner(mesh, own_face, corner), twin = c->cut_pairs->next_side[corner];
        bool flipped = mesh->corner_vertices[corner] > mesh->corner_vertices[next];
        if (twin >= corner) {
            sides[count++] = (mt_cut_side){corner, c->cut->edge_count, flipped};
        }
        if (twin > corner) {
            creases[(*crease_count)++] = (mt_edge_value){cut->corner_vertices[corner], cut->corner_vertices[next],
                                                         (double)MT_SHARPNESS_INFINITE};
        }
        corner = c->pairs->next_side[corner];
    } while (corner != first);
    c->cut->edge_count++;
    return count;
}

static mt_status list_sides(mt_context *context, cutter *c)
{
    mt_subdivide_cut *cut = c->cut;
    mt_index shared = 0;
    for (mt_index corner = 0; corner < c->mesh->corner_count; corner++) {
        shared += is_shared(c, corner);
    }
    cut->sides = mt_allocate_array(context, shared, sizeof *cut->sides);
    uint64_t room = (uint64_t)cut->mesh->crease_count + shared;
    mt_edge_value *creases = mt_reallocate(context, cut->mesh->creases, room * sizeof *creases);
    cut->mesh->creases = creases ? creases : cut->mesh->creases;
    if (!cut->sides || !creases) {
        return mt_context_error(context)->status;
    }
    for (mt_index face = 0; face < c->mesh->face_count; face++) {
        for (mt_index k = mt_mesh_face_begin(c->mesh, face); k < mt_mesh_face_end(c->mesh, face); k++) {
            if (is_shared(c, k) && mt_edge_is_first(c->pairs, k)) {
                cut->side_count +=
                    list_ring(c, k, face, cut->sides + cut->side_count, cut->mesh->creases, &cut->mesh->crease_count);
            }
        }
    }
    return MT_OK;
}

/* The mesh with all that was asked to be sharp, cut. */
static mt_status cut_mesh(mt_context *context, const mt_mesh *mesh, const mt_edge_pairs *pairs,
                          const mt_subdivide_options *settings, mt_subdivide_cut *cut)
{
    mt_mesh shell = *mesh;
    mt_status status =
        mt_subdivide_join_creases(context, mesh, pairs->next_side, settings, &shell.creases, &shell.crease_count);
    if (status != MT_OK) {
        return status;
    }
    status = mt_subdivide_join_corners(context, mesh, settings, &shell.sharp_vertices, &shell.sharp_vertex_count);
    if (status == MT_OK) {
        status = mt_split_non_manifold(context, &shell, &cut->mesh, &cut->sources);
        mt_free(context, shell.sharp_vertices);
    }
    mt_free(context, shell.creases);
    return status;
}

mt_status mt_subdivide_cut_create(mt_context *context, const mt_mesh *mesh, const mt_edge_pairs *pairs,
                                  const mt_subdivide_options *settings, mt_subdivide_cut *cut)
{
    cutter c = {.mesh = mesh, .pairs = pairs, .cut = cut};
    *cut = (mt_subdivide_cut){0};
    mt_status status = cut_mesh(context, mesh, pairs, settings, cut);
    if (status == MT_OK) {
        cut->asked_crease_count = cut->mesh->crease_count;
        cut->asked_corner_count = cut->mesh->sharp_vertex_count;
        status = mt_edge_pairs_create(context, cut->mesh, &c.cut_pairs);
    }
    if (status == MT_OK) {
        c.meetings = mt_allocate_array_zeroed(context, mesh->vertex_count, sizeof *c.meetings);
        status = c.meetings ? MT_OK : mt_context_error(context)->status;
    }
    if (status == MT_OK) {
        count_meetings(&c);
        status = sharpen_vertices(context, &c, settings->boundary == MT_SUBDIVIDE_BOUNDARY_CORNERS);
    }
    if (status == MT_OK) {
        status = list_sides(context, &c);
    }
    mt_free(context, c.meetings);
    mt_edge_pairs_destroy(context, c.cut_pairs);
    if (status != MT_OK) {
        mt_subdivide_cut_release(context, cut);
    }
    return status;
}
