#include "lib/render/view.h"

/* Mean cosine between faces and view below which another direction is looked for: a ball has 0.5, a box 0.5 to 0.58,
 * a sheet or a tube along the view less than this. */
#define EDGE_ON 0.3

/* Part of the vertices' mean squared distance from the centre that lies across the view, likewise: a ball has 2/3, a
 * line along the view 0. */
#define END_ON 0.1

/* So many vertices tell a line from a body; the step between them depends on nothing but their number. */
#define SAMPLED_VERTICES 65536

typedef struct heading {
    double right, up, front;
} heading;

static const heading headings[] = {
    {0.50, 0.38, 0.78},  /* three quarters */
    {0.35, 0.85, 0.45},  /* from above */
    {0.88, 0.30, 0.38},  /* from the side */
    {-0.50, 0.38, 0.78}, /* three quarters from the other side */
    {0.12, 0.25, 0.96},  /* from the front */
};

static mt_vec3 in_mesh(mt_up_axis up, heading d)
{
    mt_vec3 v = up == MT_UP_Z ? mt_vec3_make(d.right, -d.front, d.up) : mt_vec3_make(d.right, d.up, d.front);
    return mt_vec3_normalize(v);
}

static double spread_across(const mt_model *model, mt_vec3 direction)
{
    double across = 0, all = 0;
    mt_index count = model->mesh->vertex_count, step = count / SAMPLED_VERTICES + 1;
    for (uint64_t vertex = 0; vertex < count; vertex += step) {
        if (model->flags[vertex] & MT_VERTEX_DRAWN) {
            mt_vec3 p = mt_model_position(model, (mt_index)vertex), q = mt_vec3_cross(p, direction);
            across += mt_vec3_dot(q, q);
            all += mt_vec3_dot(p, p);
        }
    }
    return all > 0 ? across / all : 1.0;
}

/* How much of the mesh a direction shows; 1 and more is well enough. */
static double shown(const mt_corner_normals *normals, mt_vec3 direction)
{
    double facing = mt_corner_normals_facing(normals, direction) / EDGE_ON;
    double spread = spread_across(normals->model, direction) / END_ON;
    return facing < spread ? facing : spread;
}

mt_view mt_view_default(const mt_corner_normals *normals)
{
    mt_up_axis up = normals->model->mesh->up;
    mt_view view = {in_mesh(up, headings[0]), up == MT_UP_Z ? mt_vec3_make(0, 0, 1) : mt_vec3_make(0, 1, 0)};
    double best = shown(normals, view.toward_eye);
    for (size_t i = 1; i < sizeof headings / sizeof *headings && best < 1; i++) {
        mt_vec3 candidate = in_mesh(up, headings[i]);
        double here = shown(normals, candidate);
        if (here > best) {
            best = here;
            view.toward_eye = candidate;
        }
    }
    return view;
}
