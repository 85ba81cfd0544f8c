/* The shared triangulation. Triangle t of the mesh belongs to a face whose triangles begin at
 * (first corner - 2 * face): so every face knows where its triangles go, and faces are done in parallel. */
#include <meshtool/triangulate.h>

#include "lib/mesh/ear_clipping.h"
#include "lib/mesh/triangulate_quad.h"

#include <stdatomic.h>

/* Faces in a block of the parallel loop: enough to make handing one out cheap. */
#define FACE_GRAIN 4096

void mt_triangulator_release(mt_context *context, mt_triangulator *triangulator)
{
    mt_free(context, triangulator->memory);
    *triangulator = (mt_triangulator){0};
}

/* Makes room for a polygon; its size in *missing when there is none. */
static bool reserve(mt_context *context, mt_triangulator *triangulator, mt_index sides, uint64_t *missing)
{
    if (sides <= triangulator->capacity) {
        return true;
    }
    mt_triangulator_release(context, triangulator);
    mt_index capacity = sides < 64 ? 64 : sides;
    uint64_t size = (uint64_t)capacity * sizeof(mt_point2) + mt_ear_clipping_size(capacity);
    triangulator->memory = mt_try_allocate(context, size);
    *missing = triangulator->memory ? 0 : size;
    triangulator->capacity = triangulator->memory ? capacity : 0;
    return triangulator->memory != NULL;
}

static void fan(mt_index sides, mt_index *triangles)
{
    for (mt_index i = 0; i + 2 < sides; i++) {
        triangles[3 * (size_t)i] = 0;
        triangles[3 * (size_t)i + 1] = i + 1;
        triangles[3 * (size_t)i + 2] = i + 2;
    }
}

static void triangulate_polygon(const mt_triangulator *triangulator, const mt_mesh *mesh, mt_index face,
                                mt_index *triangles)
{
    mt_index sides = mt_mesh_face_sides(mesh, face);
    mt_point2 *points = triangulator->memory;
    if (mt_polygon_project(mesh, face, points)) {
        mt_ear_clip(points, sides, points + triangulator->capacity, triangles);
    } else {
        fan(sides, triangles);
    }
}

/* Local corner numbers; false, with the bytes in *missing, when memory is. Records no error. */
static bool triangulate(mt_context *context, mt_triangulator *triangulator, const mt_mesh *mesh, mt_index face,
                        mt_index *triangles, uint64_t *missing)
{
    mt_index sides = mt_mesh_face_sides(mesh, face);
    if (sides == 3) {
        fan(3, triangles);
    } else if (sides == 4) {
        mt_triangulate_quad(mesh, face, triangles);
    } else if (reserve(context, triangulator, sides, missing)) {
        triangulate_polygon(triangulator, mesh, face, triangles);
    } else {
        return false;
    }
    return true;
}

static mt_status fail_memory(mt_context *context, uint64_t missing)
{
    return mt_fail(context, MT_ERROR_OUT_OF_MEMORY,
                   "out of memory: %llu bytes to triangulate a polygon could not be had", (unsigned long long)missing);
}

mt_status mt_triangulate_face(mt_context *context, mt_triangulator *triangulator, const mt_mesh *mesh, mt_index face,
                              mt_index *triangles)
{
    uint64_t missing = 0;
    bool done = triangulate(context, triangulator, mesh, face, triangles, &missing);
    return done ? MT_OK : fail_memory(context, missing);
}

typedef struct face_loop {
    mt_context *context;
    const mt_mesh *mesh;
    mt_index *corners, *faces;
    atomic_uint_fast64_t missing; /* bytes that a block could not have */
} face_loop;

static void triangulate_block(void *user, uint64_t begin, uint64_t end)
{
    face_loop *loop = user;
    mt_triangulator triangulator = {0};
    for (mt_index face = (mt_index)begin; face < end && !atomic_load(&loop->missing); face++) {
        mt_index first_corner = mt_mesh_face_begin(loop->mesh, face);
        size_t first = first_corner - 2 * (size_t)face, count = mt_mesh_face_sides(loop->mesh, face) - 2;
        mt_index *corners = loop->corners + 3 * first;
        uint64_t missing = 0;
        if (!triangulate(loop->context, &triangulator, loop->mesh, face, corners, &missing)) {
            atomic_store(&loop->missing, missing);
            break;
        }
        for (size_t i = 0; i < 3 * count; i++) {
            corners[i] += first_corner;
        }
        for (size_t i = 0; i < count; i++) {
            loop->faces[first + i] = face;
        }
    }
    mt_triangulator_release(loop->context, &triangulator);
}

mt_status mt_triangulation_init(mt_context *context, const mt_mesh *mesh, mt_triangulation *out)
{
    uint64_t count = mesh->corner_count - 2 * (uint64_t)mesh->face_count;
    *out = (mt_triangulation){.triangle_count = (mt_index)count};
    if (count == mesh->face_count) {
        return MT_OK;
    }
    out->corners = mt_allocate_array(context, 3 * count, sizeof *out->corners);
    out->faces = mt_allocate_array(context, count, sizeof *out->faces);
    face_loop loop = {.context = context, .mesh = mesh, .corners = out->corners, .faces = out->faces};
    if (out->corners && out->faces) {
        mt_parallel_for(context, mesh->face_count, FACE_GRAIN, triangulate_block, &loop);
        uint64_t missing = atomic_load(&loop.missing);
        if (!missing) {
            return MT_OK;
        }
        fail_memory(context, missing);
    }
    mt_triangulation_release(context, out);
    return mt_context_error(context)->status;
}

void mt_triangulation_release(mt_context *context, mt_triangulation *triangulation)
{
    mt_free(context, triangulation->corners);
    mt_free(context, triangulation->faces);
    *triangulation = (mt_triangulation){0};
}
