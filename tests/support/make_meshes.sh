#!/bin/bash
# Writes the files of meshes/valid and meshes/non_manifold; meshes/manifest.csv says what each is.
#     MESHTOOL=build/meshtool tests/support/make_meshes.sh meshes
set -euo pipefail
folder=${1:?usage: make_meshes.sh FOLDER}
meshtool=${MESHTOOL:-meshtool}
mkdir -p "$folder"/{valid,non_manifold}

generate() { "$meshtool" generate "$1" -q -o "$folder/$2" "${@:3}"; }
file() { cat > "$folder/$1"; }

generate tetrahedron valid/tetrahedron.obj
generate cube valid/cube.obj
generate cube valid/cube.off --encoding ascii
generate cube valid/cube.stl --encoding ascii
generate icosahedron valid/icosahedron.ply --encoding ascii
generate dodecahedron valid/dodecahedron.off --encoding ascii
generate icosphere valid/icosphere.ply --resolution 2 --encoding binary
generate torus valid/torus.off --encoding ascii
generate torus valid/torus.stl --resolution 12 --encoding binary
generate cone valid/cone.ply --encoding binary-be
generate grid valid/grid.obj
generate prism valid/prism.obj --resolution 1000
generate teapot valid/teapot.obj
generate double-torus valid/double_torus.obj
generate moebius valid/moebius.obj
generate klein valid/klein.obj
generate book non_manifold/book_of_three_pages.obj
generate bowtie non_manifold/bow_tie.obj
generate book-bowtie non_manifold/book_and_bow_tie.obj

file valid/notched_plate.obj <<'END'
# A plate of two concave twelve-gons, front and back, and its rim of quads.
v 0 0 0
v 5 0 0
v 5 4 0
v 4 4 0
v 4 1 0
v 3 1 0
v 3 3 0
v 2 3 0
v 2 1 0
v 1 1 0
v 1 4 0
v 0 4 0
v 0 0 1
v 5 0 1
v 5 4 1
v 4 4 1
v 4 1 1
v 3 1 1
v 3 3 1
v 2 3 1
v 2 1 1
v 1 1 1
v 1 4 1
v 0 4 1
f 12 11 10 9 8 7 6 5 4 3 2 1
f 13 14 15 16 17 18 19 20 21 22 23 24
f 1 2 14 13
f 2 3 15 14
f 3 4 16 15
f 4 5 17 16
f 5 6 18 17
f 6 7 19 18
f 7 8 20 19
f 8 9 21 20
f 9 10 22 21
f 10 11 23 22
f 11 12 24 23
f 12 1 13 24
END

file non_manifold/flipped_faces.obj <<'END'
# A cube: its second and fifth face look inward. Every edge has two faces, but six of them run along it in one direction.
v -1 -1 -1
v 1 -1 -1
v 1 1 -1
v -1 1 -1
v -1 -1 1
v 1 -1 1
v 1 1 1
v -1 1 1
f 1 4 3 2
f 8 7 6 5
f 1 2 6 5
f 2 3 7 6
f 7 8 4 3
f 4 1 5 8
END

file non_manifold/duplicate_faces.obj <<'END'
# A tetrahedron whose first face comes three times: turned by one corner, and the other way around.
v 1 1 1
v 1 -1 -1
v -1 1 -1
v -1 -1 1
f 1 2 3
f 1 4 2
f 1 3 4
f 2 4 3
f 2 3 1
f 3 2 1
END

file non_manifold/repeated_vertex.obj <<'END'
# Two triangles that form a square; the second names vertex 3 twice.
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
f 1 2 3
f 1 3 3 4
END

file non_manifold/isolated_vertices.obj <<'END'
# A tetrahedron, and two vertices, the third and the last, in no face.
v 1 1 1
v 1 -1 -1
v 5 5 5
v -1 1 -1
v -1 -1 1
v 6 5 5
f 1 2 4
f 1 5 2
f 1 4 5
f 2 5 4
END
