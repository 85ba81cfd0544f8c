#include "lib/render/shadow.h"

typedef struct probe {
    const mt_look *look;
    const mt_sampling *sampling;
    uint32_t x, y;
    mt_lit_function is_lit;
    const void *user;
} probe;

/* Asks every step-th of the samples, or the others. */
static int count_lit(const probe *p, uint64_t samples, int step, bool others)
{
    int lit = 0, at = 0;
    for (; samples; samples &= samples - 1, at++) {
        if ((at % step == 0) != others) {
            int sample = __builtin_ctzll(samples);
            lit += p->is_lit(p->user, p->look, (double)p->x * MT_STEPS + (double)p->sampling->x[sample],
                             (double)p->y * MT_STEPS + (double)p->sampling->y[sample]);
        }
    }
    return lit;
}

double mt_lit_share(const mt_look *look, const mt_sampling *sampling, uint64_t samples, uint32_t x, uint32_t y,
                    mt_lit_function is_lit, const void *user)
{
    const probe p = {look, sampling, x, y, is_lit, user};
    int count = __builtin_popcountll(samples), step = count / 4 > 1 ? count / 4 : 1;
    int asked = (count + step - 1) / step, lit = count_lit(&p, samples, step, false);
    if (lit == 0 || lit == asked) {
        return lit == 0 ? 0.0 : 1.0;
    }
    return (double)(lit + count_lit(&p, samples, step, true)) / count;
}

bool mt_is_shadowed(const mt_look *look, mt_vec3 point, mt_vec3 side, mt_index skip)
{
    mt_vec3 toward_light = look->lighting.lights[0].direction;
    if (mt_vec3_dot(side, toward_light) < 0) {
        side = mt_vec3_scale(side, -1.0);
    }
    mt_ray ray = mt_ray_make(mt_ray_offset(&look->frame->model->space, point, side), toward_light);
    ray.skip = skip;
    return mt_occluder_hides(look->shadows, &ray);
}
