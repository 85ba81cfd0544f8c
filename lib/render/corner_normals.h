/* Normals at the corners of faces: smooth where smooth, creased where creased. */
#ifndef MESHTOOL_RENDER_CORNER_NORMALS_H
#define MESHTOOL_RENDER_CORNER_NORMALS_H

#include "lib/render/model.h"

/* What a vertex knows: the unit normal that all its corners share, or, when it is creased, which of the incident faces
 * are its own. */
typedef union mt_vertex_shading {
    float normal[3];
    struct {
        mt_index first, count;
    } faces;
} mt_vertex_shading;

typedef struct mt_corner_normals {
    const mt_model *model;
    float *face_normals; /* 3 per face: along the normal, as long as twice the area; zero for skipped faces */
    mt_vertex_shading *vertices;
    mt_index *joined;          /* per vertex the one that stands for it where a seam is closed; NULL: no seam */
    mt_index *incident_faces;  /* of the creased vertices */
    double minimum_cosine;     /* between faces that share a normal at a corner */
    bool flat;                 /* each face has its own alone */
    bool own;                  /* the mesh's are not looked at */
    const mt_attribute *given; /* normals that the mesh brings, used instead; NULL: none */
} mt_corner_normals;

/* Finds the area vectors of the faces; the rest is added by mt_corner_normals_build when it is needed. */
mt_status mt_corner_normals_init(mt_context *context, const mt_model *model, mt_corner_normals *normals);

/* Makes mt_corner_normal answer. Faces that meet at more than crease_degrees do not share a normal. */
mt_status mt_corner_normals_build(mt_context *context, mt_model *model, double crease_degrees,
                                  mt_corner_normals *normals);
void mt_corner_normals_release(mt_context *context, mt_corner_normals *normals);

/* The mean over (a sample of) the faces, by area, of the cosine between face and direction, front or back: 0.5
 * for a ball, 0 for a sheet seen edge-on. 1 when there is no area. */
double mt_corner_normals_facing(const mt_corner_normals *normals, mt_vec3 direction);

/* The area vector of a face. */
static inline mt_vec3 mt_face_normal(const mt_corner_normals *normals, mt_index face)
{
    const float *n = normals->face_normals + 3 * (size_t)face;
    return mt_vec3_make((double)n[0], (double)n[1], (double)n[2]);
}

static inline mt_index mt_joined_vertex(const mt_corner_normals *normals, mt_index vertex)
{
    return normals->joined ? normals->joined[vertex] : vertex;
}

/* The unit normal of a corner of a face, on either side; zero where the face has no area and the mesh gives none. */
mt_vec3 mt_corner_normal(const mt_corner_normals *normals, mt_index face, mt_index corner);

/* For mt_corner_normals_build: finds the vertices of open fans of faces that lie bit for bit at the same place, and
 * fills normals->joined when there are any. `open`: not 0 where the faces around a vertex do not close. */
mt_status mt_join_seams(mt_context *context, mt_corner_normals *normals, const uint32_t *open);

/* For mt_corner_normals_build: lists the faces around the vertices flagged MT_VERTEX_CREASED, ascending. */
mt_status mt_list_creased(mt_context *context, mt_corner_normals *normals);

#endif
