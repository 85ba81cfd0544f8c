# topology: tables as text and JSON, what is refused and what splitting makes of it.
. tests/cli/lib.sh

# The tetrahedron of the textbook's winged-edge figure: its faces 0 to 3 in their order, vertices A to D as 0 to 3. By
# their ends, edges 0 to 5 are b, c, a (turned), d, e, f (turned).
printf 'OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 3\n3 1 2 3\n3 0 2 1\n3 0 3 2\n' >"$folder/tetrahedron.off"

# row NUMBER...: the last output has these numbers as one row of a table.
row() {
  local pattern="^ *$1"
  shift
  pattern+=$(printf ' +%s' "$@")
  holds "a row $pattern" grep -qE "$pattern\$" "$folder/.out"
}

run 0 topology "$folder/tetrahedron.off" --structure winged-edge
prints "winged-edge of 4 vertices, 6 edges and 4 faces, closed"
row edge tail head left right lprev lnext rprev rnext
row 0 0 1 0 2 2 1 3 5
row 1 1 3 0 1 0 2 4 3
row 2 3 0 0 3 1 0 5 4
row 3 1 2 1 2 1 4 5 0
row 4 2 3 1 3 3 1 2 5
row 5 0 2 2 3 0 3 4 2
prints "264 bytes, for each edge 32 bytes, each vertex 4 bytes, each face 4 bytes"
prints "36 numbers"
prints "24 numbers"

# Without --structure: half-edges, whose pairs are neighbours in number.
run 0 topology "$folder/tetrahedron.off"
prints "half-edge of 4 vertices"
row half-edge pair next head face
row 0 1 2 1 0

run 0 topology "$folder/tetrahedron.off" --structure triangle-neighbor
row triangle v0 v1 v2 n0 n1 n2 corner0 corner1 corner2
row 0 0 1 3 2 1 3 8 5 9

# Polygons and boundaries.
run 0 topology "$folder/open.off" --structure winged-edge
prints "8 vertices, 12 edges and 5 faces, 4 edges on the boundary"
prints " -"
run 3 topology "$folder/cube.off" --structure triangle-neighbor
says "face 0 has 4 sides"
silent

# JSON has all rows, text the first twenty.
run 0 generate icosphere -o "$folder/sphere.off"
run 0 topology "$folder/sphere.off"
prints "more; --json has all"
run 0 topology "$folder/tetrahedron.off" --structure triangle-neighbor --json
prints '"structure": "triangle-neighbor"'
prints '"counts": {"vertices": 4, "edges": 6, "faces": 4, "triangles": 4, "boundary_edges": 0}'
prints '"separate_triangles": {"units": 36, "bytes": 288}'
prints '"indexed_mesh": {"units": 24, "bytes": 144}'
prints '"tables": {"triangles": [{"v0": 0, "v1": 1, "v2": 3, "n0": 2,'
prints '"vertices": [{"triangle": '
run 0 topology "$folder/open.off" --structure winged-edge --json
prints '"right": null'
prints '"boundary_edges": 4'

# What no structure can hold is refused, and split when asked.
for structure in half-edge winged-edge triangle-neighbor; do
  run 3 topology "$folder/book.off" --structure $structure
  says "edge 0-1 is shared by 3 faces"
  silent
  run 3 topology "$folder/bowtie.off" --structure $structure
  says "vertex 0"
  run 3 topology "$folder/flipped.off" --structure $structure
  run 3 topology "$folder/flipped.off" --structure $structure --split-non-manifold
  run 0 topology "$folder/book.off" --structure $structure --split-non-manifold
  prints "4 vertices added by splitting"
  run 0 topology "$folder/bowtie.off" --structure $structure --split-non-manifold --json
  prints '"split": [0]'
done

# Usage.
run 2 topology
run 2 topology "$folder/cube.off" --structure quad-edge
run 4 topology "$folder/absent.off"
run 3 topology "$folder/bad.off"
run 5 topology "$folder/cube.off" --max-memory 300
printf 'OFF\n0 0 0\n' >"$folder/empty.off"
run 0 topology "$folder/empty.off" --structure triangle-neighbor
run 0 topology "$folder/empty.off" --structure winged-edge --json
prints '"tables": {"edges": [], "vertices": [], "faces": []}'

finish
