/* Catmull-Clark subdivision of any polygon mesh with boundary, and Loop subdivision of triangles.
 * Sources: Catmull and Clark, "Recursively generated B-spline surfaces on arbitrary topological meshes",
 * Computer-Aided Design 10 (1978); Dupuy and Vanhoey, "A Halfedge Refinement Rule for Parallel Catmull-Clark
 * Subdivision", Computer Graphics Forum 40 (2021), for the layout: the children of corner c are 4c .. 4c+3; Loop,
 * "Smooth Subdivision Surfaces Based on Triangles", Master's thesis, University of Utah (1987). */
#ifndef MESHTOOL_SUBDIVIDE_H
#define MESHTOOL_SUBDIVIDE_H

#include <meshtool/edge_pairs.h>
#include <meshtool/subdivision_tags.h>

#ifdef __cplusplus
extern "C" {
#endif

#define MT_SUBDIVIDE_LEVEL_LIMIT 31

typedef enum mt_subdivide_scheme {
    MT_SUBDIVIDE_SCHEME_CATMULL_CLARK,
    MT_SUBDIVIDE_SCHEME_LOOP /* triangles, into four each */
} mt_subdivide_scheme;

/* In each of these 0 is: as the mesh asks by its tags (mt_subdivision_tag), and where it has none, the first that
 * follows. */
typedef enum mt_subdivide_boundary {
    MT_SUBDIVIDE_BOUNDARY_AS_TAGGED,
    MT_SUBDIVIDE_BOUNDARY_SMOOTH,  /* boundaries are cubic B-splines: OpenSubdiv's "edge only" */
    MT_SUBDIVIDE_BOUNDARY_CORNERS, /* the same, and vertices with one face stay: "edge and corner" */
    MT_SUBDIVIDE_BOUNDARY_NONE     /* faces at boundary vertices become holes, unless all boundary edges there are
                                      infinitely sharp by tag: "none" */
} mt_subdivide_boundary;

typedef enum mt_subdivide_crease_method {
    MT_SUBDIVIDE_CREASES_AS_TAGGED,
    MT_SUBDIVIDE_CREASES_NORMAL, /* sharpness falls by 1 a level */
    MT_SUBDIVIDE_CREASES_CHAIKIN /* to 3/4 of its own and 1/4 of the mean of the others at the vertex, less 1 */
} mt_subdivide_crease_method;

/* How values at corners (UVs, normals, colours) are refined, and UVs on vertices. A seam is an edge whose two faces
 * have different values. All but ALL follow the vertex rule away from seams and boundaries, and a cubic B-spline along
 * them; the values at the ends of what is listed here stay where they are instead. */
typedef enum mt_subdivide_face_varying {
    MT_SUBDIVIDE_FACE_VARYING_AS_TAGGED,
    MT_SUBDIVIDE_FACE_VARYING_ALL,           /* linear everywhere */
    MT_SUBDIVIDE_FACE_VARYING_NONE,          /* smooth everywhere */
    MT_SUBDIVIDE_FACE_VARYING_CORNERS_ONLY,  /* values of one face alone stay */
    MT_SUBDIVIDE_FACE_VARYING_CORNERS_PLUS1, /* and all at vertices of three values or more, or where a crease ends */
    MT_SUBDIVIDE_FACE_VARYING_CORNERS_PLUS2, /* and where seams end, and both values when one is of one face alone */
    MT_SUBDIVIDE_FACE_VARYING_BOUNDARIES     /* all on seams and boundaries */
} mt_subdivide_face_varying;

typedef enum mt_subdivide_triangles {
    MT_SUBDIVIDE_TRIANGLES_AS_TAGGED,
    MT_SUBDIVIDE_TRIANGLES_NORMAL,
    MT_SUBDIVIDE_TRIANGLES_SMOOTH /* level 1 weighs faces at edges of triangles by 0.47, not 1/4, which ripples less */
} mt_subdivide_triangles;

typedef enum mt_subdivide_non_manifold {
    MT_SUBDIVIDE_NON_MANIFOLD_REFUSED,
    MT_SUBDIVIDE_NON_MANIFOLD_SHARP /* edges of three faces and more, and vertices where several fans of faces meet, are
                                       infinitely sharp; misoriented edges are refused still */
} mt_subdivide_non_manifold;

/* All zeros means the defaults. */
typedef struct mt_subdivide_options {
    unsigned level_count; /* 0: 1 level; at most MT_SUBDIVIDE_LEVEL_LIMIT, else MT_ERROR_ARGUMENT */
    bool no_levels; /* really 0 levels: a copy, unchecked but for `limit`, which then needs the scheme's own faces */
    bool limit;     /* the vertices of the last level lie on the limit surface, with its normals */
    mt_subdivide_scheme scheme;
    mt_subdivide_boundary boundary;
    mt_subdivide_crease_method crease_method;
    mt_subdivide_face_varying face_varying;
    mt_subdivide_triangles triangles;
    mt_subdivide_non_manifold non_manifold;
    double crease_angle; /* > 0: edges whose faces' normals are more radians apart become infinitely sharp */
    /* Sharpness beside the mesh's, which it replaces on the same edges and vertices (0: smooth); and holes. The
     * caller's; vertices and faces must be the mesh's, else MT_ERROR_ARGUMENT. */
    const mt_edge_value *creases;
    const mt_vertex_value *sharp_vertices;
    const mt_index *holes;
    mt_index crease_count, sharp_vertex_count, hole_count;
} mt_subdivide_options;

/* Sizes of a level, in closed form from the mesh. */
typedef struct mt_subdivide_counts {
    uint64_t vertex_count, face_count, corner_count, edge_count;
    uint64_t bytes; /* of the finished level: positions, faces, attributes and labels */
} mt_subdivide_counts;

/* The counts of level `level` (0: the mesh itself); MT_ERROR_TOO_LARGE where an index of the mesh could not hold
 * them, with out filled as far as 64 bits go. pairs are the mesh's; options may be NULL, and their level_count is not
 * looked at. O(1), or O(corners) with holes or indexed corner attributes, whose seams must be counted. */
mt_status mt_subdivide_count(mt_context *context, const mt_mesh *mesh, const mt_edge_pairs *pairs,
                             const mt_subdivide_options *options, unsigned level, mt_subdivide_counts *out);

/* Refines. With V, F and C the old vertices, faces and corners:
 * - vertices: the old ones in their order, then face points by face (V + f), then edge points by the first corner of
 *   the edge; the vertex rule is (F + 2R + (n-3)P)/n, boundary edges follow the cubic B-spline; what is in no face
 *   stays
 * - faces: one for each old corner, in their order, each (old vertex, edge point of its side, face point, edge point of
 *   the side before)
 * - by Loop's scheme: no face points, so that edge points are V + e; four triangles for each old face f: 4f .. 4f+2,
 *   each with the old vertex at the corner where f has it, then in turn the edge points of its side and of the side
 *   before, and 4f+3 in the middle, whose corner j is the edge point of side j. With E old edges there are V + E
 *   vertices, 2E + 3F edges and 4F faces. An old vertex of valence n moves by b times the sum of its neighbours'
 *   differences from it, b = (5/8 - (3/8 + cos(2 pi/n)/4)^2)/n; edge points are 3/8 of the ends and 1/8 of the
 *   vertices opposite; boundaries and creases are the same cubic B-splines. All below holds for both schemes
 * - wires, points: as they are; their vertices keep their numbers
 * - labels, face attributes: inherited from the old face; mesh attributes are copied
 * - vertex attributes: by the vertex rule, like positions, but UVs like corner attributes; integers of generic meaning
 *   are copied, to a face or edge point from the vertex of its first corner
 * - corner attributes: as face_varying says; linearly: midpoints of edges and means of faces. A seam of an indexed one
 *   stays a seam, and its values are numbered as vertices are; one without indices gets them. With other rules than
 *   linear ones each vertex gets values of its own first: by vertex, and there by the first corner around it. Corners
 *   that have no value make their face pass none on. Integers of generic meaning are copied from the old corner
 * - normals: by the same rules, then made unit: they are carried, not computed anew, and a warning says so. With
 *   `limit` they are those of the limit surface: one a vertex, or where creases and corners part some, one for each
 *   smooth part around a vertex, on corners
 * - creases, sharp vertices: as OpenSubdiv 3.5 follows them, in single precision as there: an edge or vertex of
 *   sharpness s stays sharp for s levels, 10 and more for ever, and blends with the smooth rule when less than 1 is
 *   left. Boundary edges are infinitely sharp. What is left of the sharpness is passed on to the halves of the edges
 * - holes: take part, and are left out at the end with the attribute that marks them; their vertices stay
 *
 * Integers are computed as floats over all levels and rounded once. Values are stored in the mesh's precision at each
 * level and computed in double.
 *
 * The same bytes for any number of threads. Renumbering or turning faces permutes the result and changes no bit of
 * it; mirrored input gives mirrored output. Memory: the result, and while the last level is made about as much again
 * divided by 3. Time: linear in the result.
 *
 * Errors: MT_ERROR_NOT_MANIFOLD (an edge of three faces, a vertex where several fans of faces meet, a face that names a
 * vertex twice), MT_ERROR_NOT_ORIENTED; the message names the first offender and says whether repair can help.
 * MT_ERROR_INVALID_MESH: Loop's scheme with a face that is no triangle, the limit of level 0 with one that is no quad.
 * MT_ERROR_TOO_LARGE before anything of that size is allocated; MT_ERROR_OUT_OF_MEMORY, MT_ERROR_CANCELLED. */
mt_status mt_subdivide(mt_context *context, const mt_mesh *mesh, const mt_subdivide_options *options, mt_mesh **out);

/* How far the vertices of a level lie from where they go in the limit, in the mesh's units. */
typedef struct mt_limit_distance {
    double max, root_mean_square;
    mt_index vertex; /* that of max; MT_NONE when there are none */
} mt_limit_distance;

/* Of the level that the options ask for, by the closed form of the limit and no finer level. Errors and cost: those of
 * mt_subdivide, done twice. */
mt_status mt_subdivide_evaluate(mt_context *context, const mt_mesh *mesh, const mt_subdivide_options *options,
                                mt_limit_distance *out);

#ifdef __cplusplus
}
#endif
#endif
