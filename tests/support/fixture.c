#include "tests/support/fixture.h"

#include "tests/support/unit.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

mt_context *test_context_with_threads(unsigned thread_count)
{
    mt_context_options options = {.thread_count = thread_count};
    mt_context *context = mt_context_create(&options);
    assert_non_null(context);
    return context;
}

mt_context *test_context(void)
{
    return test_context_with_threads(0);
}

void test_context_end(mt_context *context)
{
    assert_int_equal(mt_context_bytes(context), 0);
    mt_context_destroy(context);
}

mt_mesh *test_mesh(mt_context *context, mt_index vertex_count, const double *positions, mt_index face_count,
                   const mt_index *faces)
{
    mt_mesh_layout layout = {.vertex_count = vertex_count, .face_count = face_count, .position_type = MT_F64};
    const mt_index *face = faces;
    for (mt_index i = 0; i < face_count; i++) {
        layout.corner_count += face[0];
        face += face[0] + 1;
    }
    mt_mesh *mesh = NULL;
    assert_int_equal(mt_mesh_create(context, &layout, &mesh), MT_OK);
    memcpy(mesh->positions, positions, 3 * (size_t)vertex_count * sizeof(double));
    face = faces;
    for (mt_index i = 0; i < face_count; i++) {
        mesh->face_offsets[i + 1] = mesh->face_offsets[i] + face[0];
        memcpy(mesh->corner_vertices + mesh->face_offsets[i], face + 1, face[0] * sizeof(mt_index));
        face += face[0] + 1;
    }
    mt_mesh_compact_faces(context, mesh);
    return mesh;
}

uint64_t test_random_next(test_random *random)
{
    uint64_t z = (random->state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

uint64_t test_random_below(test_random *random, uint64_t limit)
{
    return test_random_next(random) % limit;
}

double test_random_unit(test_random *random)
{
    return (double)(test_random_next(random) >> 11) * 0x1p-53;
}

static uint64_t hash_more(uint64_t hash, const void *bytes, size_t size)
{
    const unsigned char *byte = bytes;
    for (size_t i = 0; bytes && i < size; i++) {
        hash = (hash ^ byte[i]) * 0x100000001b3u;
    }
    return hash;
}

uint64_t test_hash(const void *bytes, size_t size)
{
    return hash_more(0xcbf29ce484222325u, bytes, size);
}

static uint64_t hash_attribute(uint64_t hash, const mt_mesh *mesh, const mt_attribute *attribute)
{
    size_t size = attribute->component_count * mt_type_size(attribute->type);
    mt_index domain_count = mt_mesh_domain_count(mesh, attribute->domain);
    hash = hash_more(hash, attribute->name, strlen(attribute->name));
    hash = hash_more(hash, &attribute->semantic, sizeof attribute->semantic);
    hash = hash_more(hash, &attribute->domain, sizeof attribute->domain);
    hash = hash_more(hash, &attribute->type, sizeof attribute->type);
    hash = hash_more(hash, attribute->values, attribute->value_count * size);
    return hash_more(hash, attribute->indices, attribute->indices ? domain_count * sizeof(mt_index) : 0);
}

static uint64_t hash_labels(uint64_t hash, const mt_mesh *mesh, const mt_labels *labels)
{
    hash = hash_more(hash, &labels->kind, sizeof labels->kind);
    for (mt_index i = 0; i < labels->name_count; i++) {
        hash = hash_more(hash, labels->names[i], strlen(labels->names[i]) + 1);
    }
    return hash_more(hash, labels->face_labels, mesh->face_count * sizeof(mt_index));
}

uint64_t test_mesh_hash(const mt_mesh *mesh)
{
    uint64_t hash = test_hash(mesh->positions, 3 * (size_t)mesh->vertex_count * mt_type_size(mesh->position_type));
    for (mt_index face = 0; face < mesh->face_count; face++) {
        mt_index sides = mt_mesh_face_sides(mesh, face);
        hash = hash_more(hash, &sides, sizeof sides);
    }
    hash = hash_more(hash, mesh->corner_vertices, mesh->corner_count * sizeof(mt_index));
    mt_index wire_size = mesh->wire_count ? mesh->wire_offsets[mesh->wire_count] : 0;
    hash = hash_more(hash, mesh->wire_offsets, mesh->wire_count ? (mesh->wire_count + 1) * sizeof(mt_index) : 0);
    hash = hash_more(hash, mesh->wire_vertices, wire_size * sizeof(mt_index));
    hash = hash_more(hash, mesh->point_vertices, mesh->point_count * sizeof(mt_index));
    for (mt_index i = 0; i < mesh->attribute_count; i++) {
        hash = hash_attribute(hash, mesh, &mesh->attributes[i]);
    }
    for (mt_index i = 0; i < mesh->label_set_count; i++) {
        hash = hash_labels(hash, mesh, &mesh->label_sets[i]);
    }
    hash = hash_more(hash, mesh->creases, mesh->crease_count * sizeof *mesh->creases);
    for (mt_index i = 0; i < mesh->sharp_vertex_count; i++) {
        /* Not the whole struct: it has bytes between its fields. */
        hash = hash_more(hash, &mesh->sharp_vertices[i].vertex, sizeof mesh->sharp_vertices[i].vertex);
        hash = hash_more(hash, &mesh->sharp_vertices[i].value, sizeof mesh->sharp_vertices[i].value);
    }
    return hash;
}

unsigned char *test_read_file(const char *path, size_t *size)
{
    FILE *file = fopen(path, "rb");
    if (!file) {
        return NULL;
    }
    fseek(file, 0, SEEK_END);
    long length = ftell(file);
    rewind(file);
    unsigned char *bytes = malloc(length > 0 ? (size_t)length : 1);
    *size = bytes && length > 0 ? fread(bytes, 1, (size_t)length, file) : 0;
    fclose(file);
    return bytes;
}
