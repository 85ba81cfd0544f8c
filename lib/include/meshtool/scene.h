/* Scenes: planes, spheres, triangles and meshes with materials, lights and a camera, drawn by ray tracing in the manner
 * of Whitted ("An Improved Illumination Model for Shaded Display", CACM 23, 1980).
 *
 * A scene is compiled to a plan first, so that only what it requires is built: no light that casts shadows, no shadow
 * rays; no mirror and no glass, no rays after the first; then no tree either: what is seen is found by rasterising. The
 * plan is recorded as mt_context_parts. The same bytes for any number of threads, compiler and processor. */
#ifndef MESHTOOL_SCENE_H
#define MESHTOOL_SCENE_H

#include <meshtool/preview.h>
#include <meshtool/ray_structure.h>
#include <meshtool/shape.h>
#include <meshtool/transform.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Colours are linear light, red x, green y, blue z; components are not negative, and those of surfaces at most 1. */

typedef struct mt_scene_camera {
    mt_projection projection;
    mt_vec3 eye, target; /* not the same point; the target is seen in the middle of the picture */
    mt_vec3 up;          /* upwards in the picture as far as possible; all zeros: +Y */
    double fov_degrees;  /* in perspective, of the picture's shorter side, below 180; 0: 40 */
    double width;        /* of the picture in the units of the scene, for the other projections; 0: the distance from
                            the eye to the target. Oblique pictures show the plane through the target as it is */
} mt_scene_camera;

typedef enum mt_scene_light_kind { MT_LIGHT_DIRECTIONAL, MT_LIGHT_POINT } mt_scene_light_kind;

typedef struct mt_scene_light {
    mt_scene_light_kind kind;
    mt_vec3 place; /* of a directional light: from anywhere towards it, any length but 0; of a point: where it is */
    mt_vec3 color; /* of its light; larger than 1 is brighter */
    double fade;   /* of a point: the distance at which half of the light is left, f^2 / (f^2 + d^2); 0: it does not
                      grow dimmer */
    bool casts_shadows; /* what is opaque and stands between keeps the light off; false: light passes through all */
} mt_scene_light;

/* The light that a surface sends to the eye is
 *     (1 - transparency) * color * (ambient * A + diffuse * sum L max(0, n . l)) + specular * sum L max(0, n .
 * h)^exponent
 *     + mirror * R + transparency * (1 - F) * T + transparency * F * R,
 * A the scene's ambient light, L what arrives from each light (Lambert; Blinn and Phong, 1977), R and T what arrives
 * along the reflected and the refracted ray (Snell), and F what glass reflects (Fresnel; 1 past the critical angle).
 * Opaque surfaces look the same from both sides. The front of a transparent one is its outside, so that a mesh of glass
 * is closed and oriented; glass within glass is known by what was entered last. Light inside is attenuated by
 * attenuation_color to the power of the way over attenuation_distance (Beer and Lambert).
 *
 * Shadows of what is transparent: light goes straight on, not bent, and is multiplied by the transparency at each
 * surface, and by the attenuation of the way inside; so glass casts a light shadow, and none without a surface. */
typedef struct mt_material {
    mt_vec3 color;
    double ambient, diffuse; /* 0 to 1 */
    mt_vec3 specular;
    double exponent; /* 1 to 1e6 */
    mt_vec3 mirror;
    double transparency;     /* 0 to 1; 0: opaque */
    double refractive_index; /* 1 to 10, for what is transparent; the eye is in air, 1 */
    mt_vec3 attenuation_color;
    double attenuation_distance; /* 0: no attenuation */
    mt_vec3 checker_color;       /* of every other square of a plane */
    double checker_size;         /* side of the squares; 0: the plane has one colour */
} mt_material;

/* Light grey and dull: color 0.8, ambient and diffuse 1, exponent 32, refractive index 1.5, all else 0. */
mt_material mt_material_default(void);

/* A mesh, however often it stands in the scene. Its faces are drawn, both sides; wires and points are not. Its own
 * colours (by corner, vertex or face) stand in for the material's, and its own normals are used, as in a preview. */
typedef struct mt_scene_mesh {
    const mt_mesh *mesh; /* borrowed */
    mt_shading shading;
    double crease_degrees;    /* as in mt_preview_options */
    bool uses_material_color; /* the mesh's own are not looked at */
} mt_scene_mesh;

typedef enum mt_scene_object_kind {
    MT_OBJECT_PLANE,
    MT_OBJECT_SPHERE,
    MT_OBJECT_TRIANGLE,
    MT_OBJECT_MESH
} mt_scene_object_kind;

typedef struct mt_scene_object {
    mt_scene_object_kind kind;
    mt_index material;
    mt_index mesh; /* of MT_OBJECT_MESH: number in the scene's meshes */
    union {
        mt_plane plane;
        mt_sphere sphere;
        mt_triangle triangle;
        mt_transform transform; /* of MT_OBJECT_MESH, into the scene; it can be undone (mt_transform_inverse) */
    } shape;
} mt_scene_object;

typedef enum mt_scene_background_kind {
    MT_SCENE_COLOR,      /* `color` everywhere */
    MT_SCENE_GRADIENT,   /* `color` below to `top` above, by how far the ray rises along the camera's up */
    MT_SCENE_TRANSPARENT /* the picture has alpha where nothing is; mirrors and glass see `color` */
} mt_scene_background_kind;

typedef struct mt_scene_background {
    mt_scene_background_kind kind;
    mt_vec3 color, top;
} mt_scene_background;

/* Rays follow one another so often at most, and by default. */
#define MT_SCENE_MAXIMUM_DEPTH 64
#define MT_SCENE_DEFAULT_DEPTH 8
/* Rays are not followed when less than this would arrive of the light that they bring, by default. */
#define MT_SCENE_DEFAULT_CUTOFF (1.0 / 512)

/* Everything is borrowed while mt_scene_render runs. */
typedef struct mt_scene {
    mt_scene_camera camera;
    uint32_t width, height; /* pixels, up to MT_PREVIEW_MAXIMUM_SIZE; 0: 1024 */
    unsigned samples;       /* per pixel, a square number up to 64; 0: 16; MT_SAMPLES_ADAPTIVE: 4, and 64 where these or
                               the pixels beside differ in brightness */
    mt_scene_background background;
    mt_vec3 ambient; /* light that comes from everywhere */
    mt_index light_count, material_count, mesh_count, object_count;
    const mt_scene_light *lights;
    const mt_material *materials;
    const mt_scene_mesh *meshes;
    const mt_scene_object *objects;
    unsigned depth_limit; /* rays after the one from the eye, in a row; 0: MT_SCENE_DEFAULT_DEPTH */
    double cutoff;        /* 0: MT_SCENE_DEFAULT_CUTOFF; negative: none. What is left out of a chain of mirrors that
                             each reflect a share k of the light is below cutoff / (1 - k) of the brightest there is */
} mt_scene;

/* All zeros means the defaults. */
typedef struct mt_scene_options {
    mt_visibility_method method;     /* of primary rays; AUTO: raster where there are no others */
    bool has_structure;              /* false: trees of boxes, and none for few triangles */
    mt_ray_structure_kind structure; /* what rays search in each mesh */
    mt_ray_profile triangle_test;
    bool measure_skipped; /* for mt_context_parts: also build and measure what the picture does without */
} mt_scene_options;

typedef struct mt_scene_report {
    uint64_t triangles; /* in the scene, instances counted each */
    /* Rays asked about. Primary ones are the samples, also where a raster finds what they see. */
    uint64_t primary_rays, shadow_rays, reflected_rays, refracted_rays;
} mt_scene_report;

/* Draws the scene: linear, RGBA when the background is transparent, RGB otherwise. options and report may be NULL. Of
 * two surfaces at one place the object that comes first is seen. MT_ERROR_ARGUMENT, naming the part of the scene, for
 * what is out of its range; MT_ERROR_INVALID_MESH for a mesh without a finite vertex. Memory beside the picture: the
 * trees of the meshes that rays come near to, and about 40 bytes for each object. Ownership of *out: the caller's,
 * until mt_image_destroy. */
mt_status mt_scene_render(mt_context *context, const mt_scene *scene, const mt_scene_options *options, mt_image **out,
                          mt_scene_report *report);

#ifdef __cplusplus
}
#endif
#endif
