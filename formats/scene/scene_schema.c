/* The schema of scene files: one table for each kind of object. */
#include "formats/scene/scene_schema.h"

#include <meshtool/scene_format.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

static const char *const projections[] = {"perspective", "orthographic", "cabinet", "cavalier", NULL};
static const char *const shadings[] = {"crease", "flat", "smooth", NULL};
const char *const scene_light_kinds[] = {"directional", "point", NULL};
const char *const scene_object_kinds[] = {"plane", "sphere", "triangle", "mesh", "instances", NULL};

#define AT(record, member) .offset = offsetof(record, member)
#define REQUIRED .is_required = true
#define FROM(low, high) .minimum = (low), .maximum = (high)
#define ABOVE(low, high) .minimum = (low), .maximum = (high), .excludes_minimum = true
#define ANY FROM(-(double)INFINITY, (double)INFINITY)

const scene_field scene_root_fields[] = {
    {"image", SCENE_OTHER, AT(scene_root, image), .expects = "an object", .means = "size and samples"},
    {"camera", SCENE_OTHER, AT(scene_root, camera), REQUIRED, .expects = "an object", .means = "where it is seen from"},
    {"background", SCENE_OTHER, AT(scene_root, background), .expects = "an object",
     .means = "what is seen where nothing is; black"},
    {"ambient", SCENE_COLOR, AT(scene_root, ambient), FROM(0, (double)INFINITY),
     .means = "light from everywhere; none"},
    {"lights", SCENE_OTHER, AT(scene_root, lights), .expects = "an array of lights", .means = "lamps; none"},
    {"materials", SCENE_OTHER, AT(scene_root, materials), .expects = "an object of materials by name",
     .means = "what surfaces are made of"},
    {"meshes", SCENE_OTHER, AT(scene_root, meshes), .expects = "an object of meshes by name",
     .means = "each read once, however often it stands in the scene"},
    {"objects", SCENE_OTHER, AT(scene_root, objects), REQUIRED, .expects = "an array of objects",
     .means = "what stands in the scene; where two coincide the first is seen"},
    {0},
};

const scene_field scene_image_fields[] = {
    {"width", SCENE_WHOLE, AT(scene_image, width), FROM(1, MT_PREVIEW_MAXIMUM_SIZE), .means = "pixels; 1024"},
    {"height", SCENE_WHOLE, AT(scene_image, height), FROM(1, MT_PREVIEW_MAXIMUM_SIZE), .means = "pixels; 1024"},
    {"samples", SCENE_OTHER, AT(scene_image, samples), .expects = "a square number from 1 to 64, or \"adaptive\"",
     .means = "a pixel; 16. adaptive: 4, and 64 where the picture changes"},
    {"depth", SCENE_WHOLE, AT(scene_image, depth), FROM(1, MT_SCENE_MAXIMUM_DEPTH),
     .means = "reflections and refractions in a row at most; 8"},
    {"cutoff", SCENE_NUMBER, AT(scene_image, cutoff), FROM(0, 0.999),
     .means = "share of light below which rays are not followed; 1/512"},
    {0},
};

const scene_field scene_camera_fields[] = {
    {"projection", SCENE_CHOICE, AT(scene_camera, projection), .choices = projections, .means = "perspective"},
    {"eye", SCENE_POINT, AT(scene_camera, eye), REQUIRED, .means = "where the eye is"},
    {"target", SCENE_POINT, AT(scene_camera, target), REQUIRED, .means = "what is in the middle of the picture"},
    {"up", SCENE_DIRECTION, AT(scene_camera, up), .means = "upwards in the picture; 0, 1, 0"},
    {"fov", SCENE_NUMBER, AT(scene_camera, fov), FROM(0.001, 179),
     .means = "in perspective: degrees along the picture's shorter side; 40"},
    {"width", SCENE_NUMBER, AT(scene_camera, width), ABOVE(0, (double)INFINITY),
     .means = "else: of the picture, in the scene's units; the distance from eye to target"},
    {0},
};

const scene_field scene_background_fields[] = {
    {"color", SCENE_COLOR, AT(scene_background, color), FROM(0, (double)INFINITY),
     .means = "everywhere, or below when there is a top; black"},
    {"top", SCENE_COLOR, AT(scene_background, top), FROM(0, (double)INFINITY), .means = "above; the same as color"},
    {"transparent", SCENE_BOOLEAN, AT(scene_background, transparent),
     .means = "the picture has alpha; mirrors and glass see the color; false"},
    {0},
};

#define LIGHT_FIELDS                                                                                                   \
    {"kind", SCENE_CHOICE, AT(scene_light, kind), REQUIRED, .choices = scene_light_kinds, .means = "which light"},     \
        {"color", SCENE_COLOR, AT(scene_light, color), FROM(0, (double)INFINITY), .means = "white"},                   \
        {"intensity", SCENE_NUMBER, AT(scene_light, intensity), FROM(0, 1e6), .means = "factor on the color; 1"},      \
    {                                                                                                                  \
        "shadows", SCENE_BOOLEAN, AT(scene_light, shadows), .means = "whether things keep it off; true"                \
    }

const scene_field scene_directional_fields[] = {
    LIGHT_FIELDS,
    {"direction", SCENE_DIRECTION, AT(scene_light, direction), REQUIRED, .means = "in which its light travels"},
    {0},
};

const scene_field scene_point_fields[] = {
    LIGHT_FIELDS,
    {"position", SCENE_POINT, AT(scene_light, position), REQUIRED, .means = "where it is"},
    {"fade", SCENE_NUMBER, AT(scene_light, fade), ABOVE(0, (double)INFINITY),
     .means = "distance at which half of its light is left; it does not fade"},
    {0},
};

const scene_field scene_material_fields[] = {
    {"color", SCENE_COLOR, AT(mt_material, color), FROM(0, 1), .means = "0.8"},
    {"ambient", SCENE_NUMBER, AT(mt_material, ambient), FROM(0, 1), .means = "share of the ambient light; 1"},
    {"diffuse", SCENE_NUMBER, AT(mt_material, diffuse), FROM(0, 1), .means = "share of the lamps' light (Lambert); 1"},
    {"specular", SCENE_COLOR, AT(mt_material, specular), FROM(0, 1), .means = "of highlights (Blinn and Phong); 0"},
    {"exponent", SCENE_NUMBER, AT(mt_material, exponent), FROM(1, 1e6), .means = "the larger the smaller they are; 32"},
    {"mirror", SCENE_COLOR, AT(mt_material, mirror), FROM(0, 1), .means = "share of light that is reflected; 0"},
    {"transparency", SCENE_NUMBER, AT(mt_material, transparency), FROM(0, 1),
     .means = "share of light that goes through; 0"},
    {"refractive_index", SCENE_NUMBER, AT(mt_material, refractive_index), FROM(1, 10), .means = "1.5, as glass has it"},
    {"attenuation_color", SCENE_COLOR, AT(mt_material, attenuation_color), FROM(0, 1),
     .means = "what is left of white light after the attenuation_distance inside; 1"},
    {"attenuation_distance", SCENE_NUMBER, AT(mt_material, attenuation_distance), ABOVE(0, (double)INFINITY),
     .means = "it is clear"},
    {"checker_color", SCENE_COLOR, AT(mt_material, checker_color), FROM(0, 1),
     .means = "of every other square of a plane; 0"},
    {"checker_size", SCENE_NUMBER, AT(mt_material, checker_size), ABOVE(0, (double)INFINITY),
     .means = "side of the squares; there are none"},
    {0},
};

const scene_field scene_mesh_fields[] = {
    {"file", SCENE_TEXT, AT(scene_mesh, file), .expects = "a path relative to the scene's folder",
     .means = "a mesh in any format that is read"},
    {"generate", SCENE_TEXT, AT(scene_mesh, generate), .expects = "a kind that the command generate knows",
     .means = "instead of a file"},
    {"resolution", SCENE_WHOLE, AT(scene_mesh, resolution), FROM(1, 1e9), .means = "of what is generated"},
    {"shading", SCENE_CHOICE, AT(scene_mesh, shading), .choices = shadings, .means = "crease"},
    {"crease", SCENE_NUMBER, AT(scene_mesh, crease), ABOVE(0, 180),
     .means = "degrees above which faces meet at an edge; 41, or the normals of the file"},
    {"colors", SCENE_BOOLEAN, AT(scene_mesh, colors), .means = "the file's, instead of the material's; true"},
    {0},
};

#define OBJECT_FIELDS                                                                                                  \
    {"kind", SCENE_CHOICE, AT(scene_object, kind), REQUIRED, .choices = scene_object_kinds, .means = "what it is"},    \
    {                                                                                                                  \
        "material", SCENE_TEXT, AT(scene_object, material), .expects = "the name of a material",                       \
                                                            .means = "a dull light grey"                               \
    }

static const scene_field plane_fields[] = {
    OBJECT_FIELDS,
    {"point", SCENE_POINT, AT(scene_object, point), .means = "any point of it; 0, 0, 0"},
    {"normal", SCENE_DIRECTION, AT(scene_object, normal), .means = "0, 1, 0"},
    {0},
};

static const scene_field sphere_fields[] = {
    OBJECT_FIELDS,
    {"center", SCENE_POINT, AT(scene_object, center), REQUIRED, .means = "its middle"},
    {"radius", SCENE_NUMBER, AT(scene_object, radius), REQUIRED, ABOVE(0, (double)INFINITY), .means = "its size"},
    {0},
};

static const scene_field triangle_fields[] = {
    OBJECT_FIELDS,
    {"corners", SCENE_OTHER, AT(scene_object, corners), REQUIRED, .expects = "three points of three numbers each",
     .means = "counter-clockwise seen from the front"},
    {0},
};

#define TRANSFORM_EXPECTS "an object, or 12 numbers: three rows of a matrix of four columns"

static const scene_field mesh_fields[] = {
    OBJECT_FIELDS,
    {"mesh", SCENE_TEXT, AT(scene_object, mesh), REQUIRED, .expects = "the name of a mesh", .means = "which"},
    {"transform", SCENE_OTHER, AT(scene_object, transform), .expects = TRANSFORM_EXPECTS, .means = "where it stands"},
    {0},
};

static const scene_field instances_fields[] = {
    OBJECT_FIELDS,
    {"mesh", SCENE_TEXT, AT(scene_object, mesh), REQUIRED, .expects = "the name of a mesh", .means = "which"},
    {"transforms", SCENE_OTHER, AT(scene_object, transforms), REQUIRED, .expects = "an array of transforms",
     .means = "where it stands, each time"},
    {0},
};

const scene_field *const scene_object_fields[SCENE_OBJECT_KINDS] = {plane_fields, sphere_fields, triangle_fields,
                                                                    mesh_fields, instances_fields};

const scene_field scene_transform_fields[] = {
    {"scale", SCENE_OTHER, AT(scene_transform, scale), .expects = "a number, or three, none 0",
     .means = "first; along the axes"},
    {"rotate", SCENE_OTHER, AT(scene_transform, rotation), .expects = "four numbers: an axis x, y, z and degrees",
     .means = "then; counter-clockwise seen against the axis"},
    {"translate", SCENE_POINT, AT(scene_transform, translate), .means = "last"},
    {0},
};

bool mt_scene_key_at(size_t index, mt_scene_key *out)
{
    static const struct {
        const char *section;
        const scene_field *fields;
    } sections[] = {
        {"", scene_root_fields},
        {"image", scene_image_fields},
        {"camera", scene_camera_fields},
        {"background", scene_background_fields},
        {"a directional light", scene_directional_fields},
        {"a point light", scene_point_fields},
        {"a material", scene_material_fields},
        {"a mesh", scene_mesh_fields},
        {"a plane", plane_fields},
        {"a sphere", sphere_fields},
        {"a triangle", triangle_fields},
        {"a mesh object", mesh_fields},
        {"instances", instances_fields},
        {"a transform", scene_transform_fields},
    };
    for (size_t s = 0; s < sizeof sections / sizeof *sections; s++) {
        for (const scene_field *field = sections[s].fields; field->key; field++, index--) {
            if (index == 0) {
                *out = (mt_scene_key){sections[s].section, field->key, "", field->means, field->is_required};
                scene_expects(field, out->expects);
                return true;
            }
        }
    }
    return false;
}
