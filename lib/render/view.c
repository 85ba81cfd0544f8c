#include "lib/render/view.h"

/* Mean cosine between faces and view below which another direction is looked for: a ball has 0.5, a box 0.5 to 0.58,
 * a sheet or a tube along the view less than this. */
#define EDGE_ON 0.3

typedef struct direction {
    double right, up, front;
} direction;

static const direction directions[] = {
    {0.50, 0.38, 0.78},  /* three quarters */
    {0.35, 0.85, 0.45},  /* from above */
    {0.88, 0.30, 0.38},  /* from the side */
    {-0.50, 0.38, 0.78}, /* three quarters from the other side */
    {0.12, 0.25, 0.96},  /* from the front */
};

static mt_vec3 in_mesh(mt_up_axis up, direction d)
{
    mt_vec3 v = up == MT_UP_Z ? mt_vec3_make(d.right, -d.front, d.up) : mt_vec3_make(d.right, d.up, d.front);
    return mt_vec3_normalize(v);
}

mt_view mt_view_default(const mt_corner_normals *normals)
{
    mt_up_axis up = normals->model->mesh->up;
    mt_view view = {in_mesh(up, directions[0]), up == MT_UP_Z ? mt_vec3_make(0, 0, 1) : mt_vec3_make(0, 1, 0)};
    double best = mt_corner_normals_facing(normals, view.toward_eye);
    if (best >= EDGE_ON) {
        return view;
    }
    for (size_t i = 1; i < sizeof directions / sizeof *directions; i++) {
        mt_vec3 candidate = in_mesh(up, directions[i]);
        double facing = mt_corner_normals_facing(normals, candidate);
        if (facing > best) {
            best = facing;
            view.toward_eye = candidate;
        }
    }
    return view;
}
