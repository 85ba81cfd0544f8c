/* The lists of defects: for each kind the first so many, with the vertices and faces that one would look at (of a
 * duplicate face also the earlier one, first).
 *
 * Cost: O(vertices + corners) time at most, and nothing for kinds of which there are none; memory as large as the
 * lists. */
#include "lib/algorithms/manifold_check.h"

#include <string.h>

const char *mt_defect_key(mt_defect_kind kind)
{
    static const char *const keys[MT_DEFECT_KIND_COUNT] = {
        "non_finite_vertices", "degenerate_faces",      "duplicate_faces",   "non_manifold_edges",
        "boundary_pinches",    "non_manifold_vertices", "misoriented_edges", "inside_out_components",
        "zero_area_faces",     "self_intersections",    "isolated_vertices", "boundary_edges"};
    return keys[kind];
}

const char *mt_defect_words(mt_defect_kind kind)
{
    static const char *const words[MT_DEFECT_KIND_COUNT] = {
        "non-finite vertex", "degenerate face",     "duplicate face",   "non-manifold edge",
        "boundary pinch",    "non-manifold vertex", "misoriented edge", "inside-out component",
        "zero-area face",    "self-intersection",   "isolated vertex",  "boundary edge"};
    return words[kind];
}

/* Lists being written: indices in one block that grows, in which the defects' pointers are set at the end. */
typedef struct defect_list {
    manifold_check *check;
    uint64_t limit; /* how many of the kind are still to be listed */
    mt_defect *defects;
    uint64_t count, room;
    mt_index *indices;
    uint64_t index_count, index_room;
    bool failed; /* no memory; what is added is dropped */
} defect_list;

/* Room for one more record; NULL, with the list marked, when memory is missing. */
static void *grow(defect_list *list, void *records, uint64_t count, uint64_t *room, size_t size)
{
    if (count < *room) {
        return records;
    }
    uint64_t more = *room ? 2 * *room : 64;
    void *grown = mt_reallocate(list->check->context, records, more * size);
    if (!grown) {
        list->failed = true;
        return records;
    }
    *room = more;
    return grown;
}

static void add_index(defect_list *list, mt_index index)
{
    list->indices = grow(list, list->indices, list->index_count, &list->index_room, sizeof *list->indices);
    if (!list->failed) {
        list->indices[list->index_count++] = index;
    }
}

/* Begins a defect; its vertices are added next, then its faces. */
static mt_defect *begin_defect(defect_list *list, mt_defect_kind kind)
{
    list->defects = grow(list, list->defects, list->count, &list->room, sizeof *list->defects);
    if (list->failed) {
        return NULL;
    }
    mt_defect *defect = &list->defects[list->count++];
    *defect = (mt_defect){.kind = kind};
    return defect;
}

static void add_vertex(defect_list *list, mt_defect *defect, mt_index vertex)
{
    if (defect) {
        add_index(list, vertex);
        defect->vertex_count++;
    }
}

static void add_face(defect_list *list, mt_defect *defect, mt_index face)
{
    if (defect) {
        add_index(list, face);
        defect->face_count++;
    }
}

static void list_vertices(defect_list *list, mt_defect_kind kind, const uint8_t *values, uint8_t value)
{
    mt_index vertex_count = list->check->mesh->vertex_count;
    for (mt_index vertex = 0; vertex < vertex_count && list->limit && !list->failed; vertex++) {
        if (values[vertex] == value) {
            add_vertex(list, begin_defect(list, kind), vertex);
            list->limit--;
        }
    }
}

static void list_faces(defect_list *list, mt_defect_kind kind, uint8_t flag)
{
    const mt_mesh *mesh = list->check->mesh;
    for (mt_index face = 0; face < mesh->face_count && list->limit && !list->failed; face++) {
        if (list->check->face_flags[face] & flag) {
            mt_defect *defect = begin_defect(list, kind);
            for (mt_index c = mt_mesh_face_begin(mesh, face); c < mt_mesh_face_end(mesh, face); c++) {
                add_vertex(list, defect, mesh->corner_vertices[c]);
            }
            add_face(list, defect, face);
            list->limit--;
        }
    }
}

static void list_inside_out(defect_list *list)
{
    const mt_mesh *mesh = list->check->mesh;
    uint64_t count = list->check->report->defect_counts[MT_DEFECT_INSIDE_OUT_COMPONENT];
    for (uint64_t i = 0; i < count && i < list->limit && !list->failed; i++) {
        mt_index face = list->check->inside_out_faces[i];
        mt_defect *defect = begin_defect(list, MT_DEFECT_INSIDE_OUT_COMPONENT);
        for (mt_index c = mt_mesh_face_begin(mesh, face); c < mt_mesh_face_end(mesh, face); c++) {
            add_vertex(list, defect, mesh->corner_vertices[c]);
        }
        add_face(list, defect, face);
    }
}

static void list_duplicates(defect_list *list)
{
    const mt_mesh *mesh = list->check->mesh;
    uint64_t count = list->check->report->defect_counts[MT_DEFECT_DUPLICATE_FACE];
    for (uint64_t i = 0; i < count && i < list->limit && !list->failed; i++) {
        duplicate_face pair = list->check->duplicates[i];
        mt_defect *defect = begin_defect(list, MT_DEFECT_DUPLICATE_FACE);
        for (mt_index c = mt_mesh_face_begin(mesh, pair.face); c < mt_mesh_face_end(mesh, pair.face); c++) {
            add_vertex(list, defect, mesh->corner_vertices[c]);
        }
        add_face(list, defect, pair.earlier);
        add_face(list, defect, pair.face);
    }
}

static bool face_names(const mt_mesh *mesh, mt_index face, mt_index vertex)
{
    for (mt_index c = mt_mesh_face_begin(mesh, face); c < mt_mesh_face_end(mesh, face); c++) {
        if (mesh->corner_vertices[c] == vertex) {
            return true;
        }
    }
    return false;
}

/* The two faces, and the vertices that both name. */
static void list_self_intersections(defect_list *list)
{
    const mt_mesh *mesh = list->check->mesh;
    const mt_self_intersections *found = &list->check->intersections;
    for (uint64_t i = 0; i < found->pair_count && i < list->limit && !list->failed; i++) {
        mt_face_pair pair = found->pairs[i];
        mt_defect *defect = begin_defect(list, MT_DEFECT_SELF_INTERSECTION);
        for (mt_index c = mt_mesh_face_begin(mesh, pair.a); c < mt_mesh_face_end(mesh, pair.a); c++) {
            if (face_names(mesh, pair.b, mesh->corner_vertices[c])) {
                add_vertex(list, defect, mesh->corner_vertices[c]);
            }
        }
        add_face(list, defect, pair.a);
        add_face(list, defect, pair.b);
    }
}

static void list_edge(defect_list *list, mt_defect_kind kind, mt_index corner, mt_index tail, mt_index head)
{
    mt_defect *defect = begin_defect(list, kind);
    add_vertex(list, defect, tail);
    add_vertex(list, defect, head);
    mt_index few[8];
    mt_index *faces = few;
    mt_index count = mt_edge_faces(list->check->mesh, list->check->pairs, corner, 8, few);
    if (count > 8) {
        faces = mt_allocate_array(list->check->context, count, sizeof *faces);
        list->failed = list->failed || !faces;
        count = faces ? mt_edge_faces(list->check->mesh, list->check->pairs, corner, count, faces) : 0;
    }
    for (mt_index i = 0; i < count; i++) {
        if (i == 0 || faces[i] != faces[i - 1]) {
            add_face(list, defect, faces[i]);
        }
    }
    if (faces != few) {
        mt_free(list->check->context, faces);
    }
}

static void list_edges(defect_list *list, mt_defect_kind kind, mt_edge_class edge_class)
{
    const mt_mesh *mesh = list->check->mesh;
    const mt_edge_pairs *pairs = list->check->pairs;
    for (mt_index face = 0; face < mesh->face_count && list->limit && !list->failed; face++) {
        mt_index begin = mt_mesh_face_begin(mesh, face), end = mt_mesh_face_end(mesh, face);
        for (mt_index c = begin; c < end && list->limit; c++) {
            if (mt_edge_is_first(pairs, c) && mt_edge_class_of(mesh, pairs, c) == edge_class) {
                mt_index next = c + 1 < end ? c + 1 : begin;
                list_edge(list, kind, c, mesh->corner_vertices[c], mesh->corner_vertices[next]);
                list->limit--;
            }
        }
    }
}

/* The faces of the listed non-manifold vertices. */
typedef struct fan_faces {
    const manifold_check *check;
    mt_index count;
    mt_index *vertices; /* ascending */
    mt_index *last;     /* per vertex the face met last, MT_NONE: none */
    mt_index *ends;     /* per vertex how many faces, then where the next goes, then where they end */
    mt_index *faces;
} fan_faces;

/* Where the vertex stands among the listed ones, by bisection; MT_NONE when it is not. */
static mt_index find_listed(const fan_faces *fans, mt_index vertex)
{
    mt_index low = 0, high = fans->count;
    while (low < high) {
        mt_index middle = low + (high - low) / 2;
        if (fans->vertices[middle] == vertex) {
            return middle;
        }
        if (fans->vertices[middle] < vertex) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return MT_NONE;
}

/* Counts the faces of each listed vertex, or, when there is room for them, writes them. */
static void gather_faces(fan_faces *fans)
{
    const mt_mesh *mesh = fans->check->mesh;
    memset(fans->last, 0xff, fans->count * sizeof *fans->last);
    for (mt_index face = 0; face < mesh->face_count; face++) {
        for (mt_index c = mt_mesh_face_begin(mesh, face); c < mt_mesh_face_end(mesh, face); c++) {
            mt_index vertex = mesh->corner_vertices[c];
            bool several = fans->check->fans->fans[vertex] == MT_FANS_SEVERAL;
            mt_index at = several ? find_listed(fans, vertex) : MT_NONE;
            if (at == MT_NONE || fans->last[at] == face) {
                continue;
            }
            fans->last[at] = face;
            if (fans->faces) {
                fans->faces[fans->ends[at]] = face;
            }
            fans->ends[at]++;
        }
    }
}

static mt_index place_faces(fan_faces *fans)
{
    mt_index at = 0;
    for (mt_index i = 0; i < fans->count; i++) {
        mt_index here = fans->ends[i];
        fans->ends[i] = at;
        at += here;
    }
    return at;
}

static void list_fans(defect_list *list, const fan_faces *fans)
{
    mt_index at = 0;
    for (mt_index i = 0; i < fans->count && !list->failed; i++) {
        mt_defect *defect = begin_defect(list, MT_DEFECT_NON_MANIFOLD_VERTEX);
        add_vertex(list, defect, fans->vertices[i]);
        for (; at < fans->ends[i]; at++) {
            add_face(list, defect, fans->faces[at]);
        }
    }
}

static void gather_and_list_fans(defect_list *list, fan_faces *fans)
{
    mt_context *context = list->check->context;
    mt_index found = 0;
    for (mt_index vertex = 0; found < fans->count; vertex++) {
        if (list->check->fans->fans[vertex] == MT_FANS_SEVERAL) {
            fans->vertices[found++] = vertex;
        }
    }
    gather_faces(fans);
    fans->faces = mt_allocate_array(context, place_faces(fans), sizeof *fans->faces);
    list->failed = list->failed || !fans->faces;
    if (fans->faces) {
        gather_faces(fans);
        list_fans(list, fans);
    }
    mt_free(context, fans->faces);
}

static void list_non_manifold_vertices(defect_list *list)
{
    mt_context *context = list->check->context;
    mt_index several = list->check->fans->several_count;
    fan_faces fans = {.check = list->check, .count = several < list->limit ? several : (mt_index)list->limit};
    fans.vertices = mt_allocate_array(context, fans.count, sizeof *fans.vertices);
    fans.last = mt_allocate_array(context, fans.count, sizeof *fans.last);
    fans.ends = mt_allocate_array_zeroed(context, fans.count, sizeof *fans.ends);
    if (fans.vertices && fans.last && fans.ends) {
        gather_and_list_fans(list, &fans);
    } else {
        list->failed = true;
    }
    mt_free(context, fans.vertices);
    mt_free(context, fans.last);
    mt_free(context, fans.ends);
}

static void list_kind(defect_list *list, mt_defect_kind kind)
{
    const manifold_check *check = list->check;
    switch (kind) {
    case MT_DEFECT_NON_FINITE_VERTEX:
        list_vertices(list, kind, check->vertex_is_non_finite, 1);
        break;
    case MT_DEFECT_DEGENERATE_FACE:
        list_faces(list, kind, FACE_DEGENERATE);
        break;
    case MT_DEFECT_DUPLICATE_FACE:
        list_duplicates(list);
        break;
    case MT_DEFECT_NON_MANIFOLD_EDGE:
        list_edges(list, kind, MT_EDGE_NON_MANIFOLD);
        break;
    case MT_DEFECT_BOUNDARY_PINCH:
        list_vertices(list, kind, check->boundary_ends, PINCH_ENDS);
        break;
    case MT_DEFECT_INSIDE_OUT_COMPONENT:
        list_inside_out(list);
        break;
    case MT_DEFECT_NON_MANIFOLD_VERTEX:
        list_non_manifold_vertices(list);
        break;
    case MT_DEFECT_MISORIENTED_EDGE:
        list_edges(list, kind, MT_EDGE_MISORIENTED);
        break;
    case MT_DEFECT_ZERO_AREA_FACE:
        list_faces(list, kind, FACE_ZERO_AREA);
        break;
    case MT_DEFECT_SELF_INTERSECTION:
        list_self_intersections(list);
        break;
    case MT_DEFECT_ISOLATED_VERTEX:
        list_vertices(list, kind, check->fans->fans, MT_FANS_NONE);
        break;
    case MT_DEFECT_BOUNDARY_EDGE:
        list_edges(list, kind, MT_EDGE_BOUNDARY);
        break;
    case MT_DEFECT_KIND_COUNT:
        break;
    }
}

/* The indices no longer move. */
static void set_pointers(const defect_list *list)
{
    const mt_index *at = list->indices;
    for (uint64_t i = 0; i < list->count; i++) {
        mt_defect *defect = &list->defects[i];
        defect->vertices = at;
        defect->faces = at + defect->vertex_count;
        at += (size_t)defect->vertex_count + defect->face_count;
    }
}

mt_status mt_manifold_list_defects(manifold_check *check, uint64_t defects_per_kind)
{
    defect_list list = {.check = check};
    for (mt_defect_kind kind = 0; kind < MT_DEFECT_KIND_COUNT && !list.failed; kind++) {
        mt_index count = check->report->defect_counts[kind];
        list.limit = count < defects_per_kind ? count : defects_per_kind;
        if (count) {
            list_kind(&list, kind);
        }
    }
    if (list.failed) {
        mt_free(check->context, list.defects);
        mt_free(check->context, list.indices);
        return mt_context_error(check->context)->status;
    }
    set_pointers(&list);
    check->report->defect_list_count = (size_t)list.count;
    check->report->defects = list.defects;
    check->report->storage = list.indices;
    return MT_OK;
}
