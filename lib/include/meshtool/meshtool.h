/* meshtool: check, mend, refine, measure and see meshes. This header is the table of contents. */
#ifndef MESHTOOL_MESHTOOL_H
#define MESHTOOL_MESHTOOL_H

/* The ground floor */
#include <meshtool/area_vector.h> /* of any polygon, whatever its size and shape */
#include <meshtool/checked.h>     /* sizes that say when they overflow */
#include <meshtool/clones.h>      /* loops compiled for wider instructions */
#include <meshtool/context.h>     /* memory, threads, progress, errors, explain */
#include <meshtool/elementary.h>  /* sin, cos, log ... with the same bits everywhere */
#include <meshtool/predicates.h>  /* exact orientation */
#include <meshtool/types.h>       /* indices, status codes, number types */
#include <meshtool/vector.h>      /* three doubles */

/* The hub */
#include <meshtool/attribute.h>        /* normals, UVs, colours */
#include <meshtool/derive.h>           /* new meshes from chosen elements */
#include <meshtool/generate.h>         /* cube, torus, teapot ... */
#include <meshtool/mesh.h>             /* vertices, polygons, labels, creases */
#include <meshtool/subdivision_tags.h> /* holes, and how a file asks to be subdivided */
#include <meshtool/transform.h>        /* scale, rotate, move */
#include <meshtool/triangulate.h>      /* n-gons to triangles, in one way */
#include <meshtool/weld.h>             /* points at one place become one */

/* Connectivity */
#include <meshtool/components.h>                /* connected faces, orientability */
#include <meshtool/degenerate_faces.h>          /* faces that name a vertex twice */
#include <meshtool/edge_pairs.h>                /* which sides share an edge */
#include <meshtool/edit_log.h>                  /* what surgery did, for what lies on the mesh */
#include <meshtool/halfedge.h>                  /* half-edges in pairs */
#include <meshtool/halfedge_surgery.h>          /* swap, split, collapse, remove and add on them */
#include <meshtool/refusal.h>                   /* why a mesh is not what these need, and what can mend it */
#include <meshtool/split_non_manifold.h>        /* repeated vertices where no structure can hold one */
#include <meshtool/surgery.h>                   /* what these operations do, and when they may */
#include <meshtool/triangle_neighbor.h>         /* triangles and what lies across their sides */
#include <meshtool/triangle_neighbor_surgery.h> /* swap, split, collapse, remove and add on them */
#include <meshtool/vertex_fans.h>               /* how the faces around a vertex hang together */
#include <meshtool/winged_edge.h>               /* edges with their vertices, faces and wings */
#include <meshtool/winged_edge_surgery.h>       /* swap, split, collapse, remove and add on them */

/* Space */
#include <meshtool/aabb_tree.h>     /* a tree of boxes over triangles */
#include <meshtool/closest_point.h> /* nearest points of triangles, wires and points */
#include <meshtool/ray.h>           /* where a ray meets a triangle */
#include <meshtool/ray_structure.h> /* what rays search: boxes, a grid, a BSP tree, or nothing */
#include <meshtool/shape.h>         /* planes, spheres and triangles by their formulas */
#include <meshtool/surface_tree.h>  /* a wide tree for rays and closest points */

/* Algorithms */
#include <meshtool/deviation.h>         /* how far two meshes lie apart */
#include <meshtool/manifold.h>          /* the check that finds everything */
#include <meshtool/normals.h>           /* of faces, vertices and corners */
#include <meshtool/order.h>             /* faces and vertices in an order for caches */
#include <meshtool/repair.h>            /* mending, with an account */
#include <meshtool/self_intersection.h> /* faces that meet where they should not, decided exactly */
#include <meshtool/signed_distance.h>   /* negative inside */
#include <meshtool/storage.h>           /* bytes of each way to store a mesh */
#include <meshtool/strips.h>            /* triangles as strips and fans */
#include <meshtool/subdivide.h>         /* Catmull-Clark */

/* Pictures */
#include <meshtool/alpha.h>   /* premultiplied colours, one picture over another */
#include <meshtool/bayer.h>   /* colour filters of cameras, and colours out of them */
#include <meshtool/color.h>   /* hue, saturation and value, luminance, linear light */
#include <meshtool/image.h>   /* float raster */
#include <meshtool/ink.h>     /* lines and letters on a picture */
#include <meshtool/palette.h> /* colours for things that have numbers */
#include <meshtool/preview.h> /* a picture of any mesh */
#include <meshtool/scene.h>   /* objects, materials, lights: ray tracing */

/* Files */
#include <meshtool/file.h>         /* any bytes, written as all outputs are */
#include <meshtool/image_format.h> /* PNG, JPEG, TIFF, PPM and kin, PFM */
#include <meshtool/mesh_format.h>  /* OBJ, OFF, PLY, STL */
#include <meshtool/scene_format.h> /* scenes in JSON */
#include <meshtool/strip_format.h> /* strips and fans as text */

#endif
