/* What the files of normals share. */
#ifndef MT_ALGORITHMS_NORMALS_H
#define MT_ALGORITHMS_NORMALS_H

#include <meshtool/normals.h>

#define MT_NORMALS_GRAIN 8192 /* elements a task takes at once */

typedef struct mt_normals_job {
    mt_context *context;
    const mt_mesh *mesh;
    mt_normal_options options; /* without defaults left open */
    mt_attribute *values;      /* to be filled; of corners `indices` come, and `values` are to be made */
    mt_index undefined_count;
} mt_normals_job;

/* For the bodies of parallel loops. */
static inline void mt_count_undefined(mt_normals_job *job, mt_index count)
{
    __atomic_fetch_add(&job->undefined_count, count, __ATOMIC_RELAXED);
}

/* Each fills the values of its kind. */
void mt_normals_of_faces(mt_normals_job *job);
mt_status mt_normals_of_vertices(mt_normals_job *job);
mt_status mt_normals_of_corners(mt_normals_job *job);

/* Normals of vertices by area in one pass over the faces. *done is false, and the values are of no use, when areas are
 * too small or too large to be summed without scaling. */
mt_status mt_normals_by_area(mt_normals_job *job, bool *done);

#endif
