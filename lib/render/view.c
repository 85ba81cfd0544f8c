#include "lib/render/view.h"

#include <meshtool/elementary.h>

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

/* The sides, and which way is up where that is not the axis. */
static const struct {
    heading toward_eye, up;
} sides[MT_VIEW_COUNT] = {
    [MT_VIEW_FRONT] = {{0, 0, 1}, {0, 1, 0}}, [MT_VIEW_BACK] = {{0, 0, -1}, {0, 1, 0}},
    [MT_VIEW_LEFT] = {{-1, 0, 0}, {0, 1, 0}}, [MT_VIEW_RIGHT] = {{1, 0, 0}, {0, 1, 0}},
    [MT_VIEW_TOP] = {{0, 1, 0}, {0, 0, -1}},  [MT_VIEW_BOTTOM] = {{0, -1, 0}, {0, 0, 1}},
    [MT_VIEW_ISO] = {{1, 1, 1}, {0, 1, 0}},
};

/* The mesh's own right, up and front: with Z up the front is -Y, else +Z as far as that is at right angles. */
typedef struct directions {
    mt_vec3 right, up, front;
} directions;

static directions directions_of(mt_vec3 up)
{
    bool z_up = fabs(up.z) > fabs(up.x) && fabs(up.z) > fabs(up.y);
    mt_vec3 front = z_up ? mt_vec3_make(0, -1, 0) : mt_vec3_make(0, 0, 1);
    front = mt_vec3_normalize(mt_vec3_subtract(front, mt_vec3_scale(up, mt_vec3_dot(front, up))));
    return (directions){mt_vec3_cross(up, front), up, front};
}

static mt_vec3 in_mesh(const directions *own, heading d)
{
    mt_vec3 v = mt_vec3_add(mt_vec3_scale(own->right, d.right), mt_vec3_scale(own->up, d.up));
    return mt_vec3_normalize(mt_vec3_add(v, mt_vec3_scale(own->front, d.front)));
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

static mt_vec3 best_heading(const mt_corner_normals *normals, const directions *own)
{
    mt_vec3 found = in_mesh(own, headings[0]);
    double best = shown(normals, found);
    for (size_t i = 1; i < sizeof headings / sizeof *headings && best < 1; i++) {
        mt_vec3 candidate = in_mesh(own, headings[i]);
        double here = shown(normals, candidate);
        if (here > best) {
            best = here;
            found = candidate;
        }
    }
    return found;
}

mt_view mt_view_make(const mt_corner_normals *normals, mt_view_name name, mt_vec3 up)
{
    up = mt_vec3_normalize(up);
    if (!(mt_vec3_dot(up, up) > 0)) {
        up = normals->model->mesh->up == MT_UP_Z ? mt_vec3_make(0, 0, 1) : mt_vec3_make(0, 1, 0);
    }
    directions own = directions_of(up);
    if (name == MT_VIEW_DEFAULT) {
        return (mt_view){best_heading(normals, &own), up, up};
    }
    return (mt_view){in_mesh(&own, sides[name].toward_eye), in_mesh(&own, sides[name].up), up};
}

/* Rodrigues' formula. */
mt_vec3 mt_turned(mt_vec3 v, mt_vec3 axis, double degrees)
{
    double angle = degrees * (MT_PI / 180.0), cosine = mt_cos(angle), sine = mt_sin(angle);
    mt_vec3 along = mt_vec3_scale(axis, mt_vec3_dot(axis, v) * (1.0 - cosine));
    mt_vec3 across = mt_vec3_scale(mt_vec3_cross(axis, v), sine);
    return mt_vec3_add(mt_vec3_add(mt_vec3_scale(v, cosine), across), along);
}
