/* The values that a subdivision refines: the positions, and every attribute that is mixed or copied by vertex. */
#ifndef LIB_ALGORITHMS_SUBDIVIDE_FIELD_H
#define LIB_ALGORITHMS_SUBDIVIDE_FIELD_H

#include "lib/algorithms/subdivide_cut.h"
#include "lib/algorithms/subdivide_value_rules.h"
#include "lib/algorithms/subdivide_values.h"

#include <meshtool/subdivide.h>

typedef struct mt_subdivide_field {
    mt_index attribute; /* its number in the mesh, MT_NONE for the positions */
    mt_index topology;  /* whose vertices it lies on */
    mt_subdivide_rule rule;
    bool face_varying; /* by the value rules of its topology, where it is smooth */
    mt_type type;      /* of the values in work: MT_F32 or MT_F64, MT_U32 for MT_SUBDIVIDE_ORIGIN */
    uint32_t component_count;
    const void *values;
    void *owned; /* the values when they are not the mesh's or the result's */
} mt_subdivide_field;

/* What one subdivision holds from level to level. */
typedef struct mt_subdivide_state {
    const mt_mesh *mesh;
    mt_index topology_count;
    mt_subdivide_topology *topologies; /* 0: of the vertices; then one for each corner attribute that is mixed */
    mt_value_rules *value_rules;       /* of each topology; of the first for UVs on vertices */
    mt_index field_count;
    mt_subdivide_field *fields;    /* 0: the positions */
    mt_subdivide_options settings; /* with the mesh's tags where nothing was asked for; level_count at least 1 */
    mt_subdivide_sharp sharp;
    mt_index sharp_vertex_count; /* as given, by the mesh and then the options */
    mt_vertex_value *sharp_vertices;
    uint8_t *holes;        /* per face of the mesh; NULL: none */
    mt_subdivide_cut *cut; /* the mesh is that of a cut; NULL: it is not */
} mt_subdivide_state;

/* Makes the topologies of the corner attributes and all fields; topologies[0] must stand. */
mt_status mt_subdivide_fields_create(mt_context *context, mt_subdivide_state *state);

/* Adds to the result, in the order of the mesh, every attribute with room for its final values. */
mt_status mt_subdivide_attributes_add(mt_context *context, const mt_subdivide_state *state, mt_mesh *result);

/* Where the last level of a field goes when it needs no conversion, else NULL. */
void *mt_subdivide_field_target(const mt_subdivide_state *state, const mt_subdivide_field *field,
                                const mt_mesh *result);

/* After the last level: converts, makes unit, gathers what is copied from old elements. */
void mt_subdivide_attributes_finish(mt_context *context, const mt_subdivide_state *state, unsigned level_count,
                                    mt_mesh *result);

/* Copies to each new face or corner of level_count levels (at least 1) the `size` bytes of the old one. */
void mt_subdivide_spread(mt_context *context, const mt_subdivide_state *state, bool of_faces, unsigned level_count,
                         size_t size, const void *from, void *to);

/* How the mesh's attributes are treated. */
typedef enum mt_subdivide_carriage {
    MT_SUBDIVIDE_CARRY_FIELD,  /* a field is refined */
    MT_SUBDIVIDE_CARRY_PARENT, /* copied from the old face or corner that a new one comes from */
    MT_SUBDIVIDE_CARRY_WHOLE   /* copied as it is: of the mesh */
} mt_subdivide_carriage;
mt_subdivide_carriage mt_subdivide_carriage_of(const mt_attribute *attribute);

#endif
