/* Lambert's cosine law, Blinn's half-vector highlight (1977), and ambient light that knows up from down. The
 * exponent of the highlight is a power of two, so that it is squarings and the same bits everywhere; it begins with the
 * cosine's square, which needs no root. */
#include "lib/render/shade.h"

#define GLOSS_SQUARINGS 4 /* of the square: exponent 32 */

static mt_vec3 in_camera(const mt_camera *camera, double right, double up, double back)
{
    mt_vec3 v = mt_vec3_add(mt_vec3_scale(camera->right, right), mt_vec3_scale(camera->up, up));
    return mt_vec3_normalize(mt_vec3_add(v, mt_vec3_scale(camera->forward, -back)));
}

mt_lighting mt_lighting_default(const mt_camera *camera, mt_vec3 up)
{
    mt_lighting lighting = {
        .lights = {{in_camera(camera, -0.50, 0.62, 1.0), {0.86, 0.84, 0.80}},
                   {in_camera(camera, 0.95, 0.05, 0.30), {0.19, 0.22, 0.27}}},
        .up = up,
        .sky = {0.22, 0.24, 0.27},
        .ground = {0.10, 0.09, 0.085},
        .gloss = 0.20,
    };
    return lighting;
}

static double positive(double x)
{
    return x > 0 ? x : 0.0;
}

static mt_vec3 add_scaled(mt_vec3 a, mt_vec3 b, double s)
{
    return mt_vec3_make(a.x + b.x * s, a.y + b.y * s, a.z + b.z * s);
}

mt_vec3 mt_shade(const mt_lighting *lighting, mt_vec3 normal, mt_vec3 toward_eye, mt_vec3 color, double lit)
{
    double sky = 0.5 + 0.5 * mt_vec3_dot(normal, lighting->up);
    mt_vec3 diffuse = add_scaled(mt_vec3_scale(lighting->ground, 1.0 - sky), lighting->sky, sky);
    mt_vec3 glossy = mt_vec3_make(0, 0, 0);
    for (int i = 0; i < MT_LIGHT_COUNT; i++) {
        const mt_light *light = &lighting->lights[i];
        double cosine = positive(mt_vec3_dot(normal, light->direction)), arrives = i == 0 ? lit : 1.0;
        mt_vec3 half = mt_vec3_add(light->direction, toward_eye);
        double along = positive(mt_vec3_dot(normal, half)), squared = mt_vec3_dot(half, half);
        double highlight = cosine > 0 && squared > 0 ? along * along / squared : 0.0;
        for (int k = 0; k < GLOSS_SQUARINGS; k++) {
            highlight *= highlight;
        }
        diffuse = add_scaled(diffuse, light->color, cosine * arrives);
        glossy = add_scaled(glossy, light->color, lighting->gloss * highlight * arrives);
    }
    return mt_vec3_make(color.x * diffuse.x + glossy.x, color.y * diffuse.y + glossy.y, color.z * diffuse.z + glossy.z);
}
