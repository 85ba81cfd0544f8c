/* Any bytes, read as a scene: an error with a sentence, or a scene whose parts are all there and which can be drawn.
 * Meshes are looked for below /dev/null, where no path leads to a file; those that a scene generates are made. Nothing
 * is leaked, and no more memory is held than the limit allows. */
#include <meshtool/scene_format.h>

#include <stdio.h>
#include <stdlib.h>

/* Small, since one line of a scene asks for a mesh of millions of faces. */
#define MEMORY_LIMIT ((uint64_t)8 << 20)

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size);

static void require(bool condition, const mt_context *context, const char *what)
{
    if (!condition) {
        fprintf(stderr, "%s: %s\n", what, mt_context_error(context)->message);
        abort();
    }
}

static void check_scene(mt_context *context, const mt_scene *scene)
{
    require(scene->material_count > 0 && scene->width > 0 && scene->height > 0, context, "a scene without a picture");
    for (mt_index i = 0; i < scene->mesh_count; i++) {
        require(mt_mesh_validate(context, scene->meshes[i].mesh) == MT_OK, context, "an invalid mesh was made");
    }
    for (mt_index i = 0; i < scene->object_count; i++) {
        const mt_scene_object *object = &scene->objects[i];
        require(object->material < scene->material_count, context, "an object of no material");
        require(object->kind != MT_OBJECT_MESH || object->mesh < scene->mesh_count, context, "an object of no mesh");
    }
}

/* In few pixels, with one sample each and few reflections. */
static void draw(mt_context *context, mt_scene *scene)
{
    mt_image *image = NULL;
    scene->width = scene->height = 4;
    scene->samples = 1;
    scene->depth_limit = scene->depth_limit > 4 ? 4 : scene->depth_limit;
    mt_status status = mt_scene_render(context, scene, NULL, &image, NULL);
    require(!status == !!image && status != MT_ERROR_INTERNAL && (image || mt_context_error(context)->message[0]),
            context, "a picture without its status");
    mt_image_destroy(context, image);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    mt_context_options options = {.thread_count = 1, .memory_limit = MEMORY_LIMIT};
    mt_context *context = mt_context_create(&options);
    mt_scene_file *file = NULL;
    if (!context) {
        return 0;
    }
    mt_status status = mt_scene_read_memory(context, "/dev/null/fuzz", bytes, size, &file);
    if (status == MT_OK) {
        check_scene(context, mt_scene_file_scene(file));
        draw(context, mt_scene_file_scene(file));
        mt_scene_file_destroy(context, file);
    } else {
        require(!file && status != MT_ERROR_INTERNAL && mt_context_error(context)->message[0], context,
                "a failure without a sentence");
    }
    require(mt_context_bytes(context) == 0, context, "memory was leaked");
    mt_context_destroy(context);
    return 0;
}
