/* Faces without an area, one by one. */
#include "tradeoff/integer_triangle.h"
#include "tradeoff/pair_oracle.h"

/* Faces looked at, and the sides of one: every vertex of a face is compared with every other. */
#define FACE_WORK 200000U
#define MOST_SIDES 64

static bool has_different_finite_vertices(const mt_mesh *mesh, const mt_index *vertices, mt_index sides)
{
    for (mt_index i = 0; i < sides; i++) {
        if (!mt_vec3_is_finite(mt_mesh_position(mesh, vertices[i]))) {
            return false;
        }
        for (mt_index j = 0; j < i; j++) {
            if (vertices[i] == vertices[j]) {
                return false;
            }
        }
    }
    return true;
}

/* The line goes through the first point and another one. */
static bool is_flat(const mt_mesh *mesh, const mt_index *vertices, mt_index sides)
{
    mt_vec3 line[3] = {mt_mesh_position(mesh, vertices[0])};
    line[1] = line[0];
    for (mt_index i = 1; i < sides; i++) {
        line[2] = mt_mesh_position(mesh, vertices[i]);
        if (!integer_points_are_collinear(line)) {
            return false;
        }
        bool is_one = line[0].x == line[1].x && line[0].y == line[1].y && line[0].z == line[1].z;
        line[1] = is_one ? line[2] : line[1];
    }
    return true;
}

typedef struct judging {
    const mt_mesh *mesh;
    unsigned char *is_judged, *is_flat;
    mt_index step;
} judging;

static void judge_faces(void *user, uint64_t begin, uint64_t end)
{
    const judging *j = user;
    for (uint64_t face = begin; face < end; face++) {
        mt_index sides = mt_mesh_face_sides(j->mesh, (mt_index)face);
        const mt_index *vertices = j->mesh->corner_vertices + mt_mesh_face_begin(j->mesh, (mt_index)face);
        j->is_judged[face] = face % j->step == 0 && sides <= MOST_SIDES;
        j->is_flat[face] = j->is_judged[face] && has_different_finite_vertices(j->mesh, vertices, sides) &&
                           is_flat(j->mesh, vertices, sides);
    }
}

mt_status area_oracle_make(mt_context *context, const mt_mesh *mesh, pair_oracle *out)
{
    mt_index face_count = mesh->face_count;
    judging j = {.mesh = mesh, .step = (face_count - 1) / FACE_WORK + 1};
    out->is_judged = j.is_judged = mt_allocate_zeroed(context, face_count);
    j.is_flat = mt_allocate_zeroed(context, face_count);
    out->pairs = mt_allocate_array(context, face_count < FACE_WORK ? face_count : FACE_WORK, sizeof *out->pairs);
    bool has_room = j.is_judged && j.is_flat && out->pairs;
    if (has_room) {
        mt_parallel_for(context, face_count, 1024, judge_faces, &j);
    }
    for (mt_index face = 0; has_room && face < face_count; face++) {
        out->judged_count += j.is_judged[face];
        if (j.is_flat[face]) {
            out->pairs[out->pair_count++] = (mt_face_pair){face, face};
        }
    }
    mt_free(context, j.is_flat);
    return has_room ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
}
