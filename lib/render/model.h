/* A mesh made ready to be drawn: what of it can be seen, and where, in coordinates that no magnitude upsets. */
#ifndef MESHTOOL_RENDER_MODEL_H
#define MESHTOOL_RENDER_MODEL_H

#include <meshtool/mesh.h>
#include <meshtool/ray.h>
#include <meshtool/triangulate.h>

enum {
    MT_VERTEX_FINITE = 1,
    MT_VERTEX_DRAWN = 2,  /* belongs to something that is drawn */
    MT_VERTEX_CREASED = 4 /* its faces do not all share one normal (corner_normals.c) */
};

/* A line between two vertices, or a dot when they are the same. */
typedef struct mt_stroke {
    mt_index a, b;
} mt_stroke;

typedef struct mt_model {
    const mt_mesh *mesh;
    mt_triangulation triangulation;
    unsigned char *flags;         /* per vertex, of the above */
    unsigned char *skipped_faces; /* per face not 0: it has a vertex that is not finite; NULL when there is none */
    mt_stroke *strokes;           /* wires and points; every vertex when there is nothing else */
    mt_index stroke_count;
    mt_index dot_count;
    double scales[2];   /* powers of two that bring the coordinates to 1 */
    mt_vec3 center;     /* of what is drawn, after these */
    double unit;        /* power of two that then brings the extent to 1 */
    mt_vec3 low, high;  /* bounds of what is drawn, after all this */
    mt_ray_space space; /* in which rays and triangles given in these coordinates meet */
} mt_model;

/* MT_ERROR_INVALID_MESH, with the reason, when nothing can be drawn. Warns of faces skipped. The mesh is borrowed. */
mt_status mt_model_init(mt_context *context, const mt_mesh *mesh, mt_model *model);
void mt_model_release(mt_context *context, mt_model *model);

/* Counts a vertex among the drawn ones, unless it is not finite. */
void mt_model_draw_vertex(mt_model *model, mt_index vertex);

/* Replaces the strokes by the sides of all drawn faces: for faces too thin for any sample. */
mt_status mt_model_outline(mt_context *context, mt_model *model);

/* A point of the mesh's coordinates in those of the model, and back. */
static inline mt_vec3 mt_model_point(const mt_model *model, mt_vec3 p)
{
    p.x = (p.x * model->scales[0] * model->scales[1] - model->center.x) * model->unit;
    p.y = (p.y * model->scales[0] * model->scales[1] - model->center.y) * model->unit;
    p.z = (p.z * model->scales[0] * model->scales[1] - model->center.z) * model->unit;
    return p;
}

static inline mt_vec3 mt_model_original(const mt_model *model, mt_vec3 p)
{
    p.x = (p.x / model->unit + model->center.x) / model->scales[0] / model->scales[1];
    p.y = (p.y / model->unit + model->center.y) / model->scales[0] / model->scales[1];
    p.z = (p.z / model->unit + model->center.z) / model->scales[0] / model->scales[1];
    return p;
}

/* A finite vertex relative to the centre, within [-1, 1]. */
static inline mt_vec3 mt_model_position(const mt_model *model, mt_index vertex)
{
    return mt_model_point(model, mt_mesh_position(model->mesh, vertex));
}

static inline bool mt_model_skips(const mt_model *model, mt_index face)
{
    return model->skipped_faces && model->skipped_faces[face];
}

#endif
