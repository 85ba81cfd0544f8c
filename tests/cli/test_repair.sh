# repair: exit codes, the account as text and JSON, and that repairing twice gives the same bytes.
. tests/cli/lib.sh

# Usage: something must be asked for, and somewhere to put it.
run 2 repair "$folder/book.off" -o "$folder/none.off"
says "--all"
holds "nothing is written when nothing is asked for" test ! -e "$folder/none.off"
run 2 repair "$folder/book.off" --all
run 2 repair "$folder/book.off" -o "$folder/none.off" --tolerance -1
run 2 repair "$folder/book.off" -o "$folder/none.off" --tolerance 0
run 4 repair "$folder/absent.off" -o "$folder/none.off" --all

# A failure leaves what is there.
echo precious >"$folder/kept.off"
run 3 repair "$folder/bad.off" -o "$folder/kept.off" --all
run 5 repair "$folder/cube.off" -o "$folder/kept.off" --all --max-memory 1K
holds "a failed repair leaves the output" grep -qx precious "$folder/kept.off"

# Only what is asked for is done.
run 0 repair "$folder/flipped.off" -o "$folder/split.off" --split --drop-duplicates
prints "nothing for these steps to mend"
prints "--orient would mend more of it."
prints "1 misoriented edge (first: edge 2-0)"
run 0 repair "$folder/flipped.off" -o "$folder/oriented.off" --orient
prints "turned 1 face"
run 0 check-manifold "$folder/oriented.off" --oriented
run 0 repair "$folder/open.off" -o "$folder/closed.off" --fill-holes
prints "filled 1 hole"
prints "Now it is manifold and closed."
run 0 check-manifold "$folder/closed.off" --closed --oriented
run 0 repair "$folder/open.off" -o "$folder/x.off" --max-hole 4
prints "filled 1 hole"
run 0 repair "$folder/open.off" -o "$folder/x.off" --max-hole 3
prints "left 1 part of the boundary open: "
run 2 repair "$folder/open.off" -o "$folder/x.off" --max-hole 2
run 0 repair meshes/valid/grid.obj -o "$folder/x.off" --all
prints "the rim of a flat sheet"

# What the errors of other commands promise.
run 0 repair "$folder/bowtie.off" -o "$folder/parted.off" --split
run 0 subdivide "$folder/parted.off" -o "$folder/x.off"
run 0 repair "$folder/book.off" -o "$folder/parted.off" --split
run 0 subdivide "$folder/parted.off" -o "$folder/x.off"
run 0 subdivide "$folder/oriented.off" -o "$folder/x.off"

# JSON: each step that was asked for, with its count and the numbers.
run 0 repair "$folder/flipped.off" -o "$folder/x.off" --orient --json
prints '"orient": {"count": 1, "faces": ['
prints '"vertices": []'
prints '"class": "manifold-with-boundary"'
case $out in *'"split"'*) fail "a step that was not asked for is reported" ;; *) pass ;; esac
run 0 repair "$folder/bowtie.off" -o "$folder/x.off" --all --json
for key in weld drop_degenerate drop_duplicates split orient fill_holes drop_isolated; do
  prints "\"$key\": {\"count\": "
done
prints '"split": {"count": 1, "faces": [], "vertices": [7]'

# Welding within a distance is asked for by the distance.
cat >"$folder/seam.off" <<'END_OF_MESH'
OFF
6 2 0
0 0 0
1 0 0
1 1 0
0 0.001 0
1 1.001 0
0 1 0
3 0 1 2
3 3 4 5
END_OF_MESH
run 0 repair "$folder/seam.off" -o "$folder/x.off" --weld
prints "nothing for these steps to mend"
run 0 repair "$folder/seam.off" -o "$folder/x.off" --tolerance 0.01
prints "joined 2 vertices"
run 0 repair "$folder/seam.off" -o "$folder/x.off" --tolerance 0.01 --split
prints "joined 2 vertices"

# Every defective mesh: manifold afterwards, and a second repair changes no byte and counts nothing.
mend() {
  run 0 repair "$1" -o "$folder/once.ply" --all
  run 0 check-manifold "$folder/once.ply"
  run 0 repair "$folder/once.ply" -o "$folder/twice.ply" --all --json
  holds "$1: repaired twice is as once" cmp "$folder/once.ply" "$folder/twice.ply"
  case $out in *'"count": '[1-9]*) fail "$1: the second repair counts something: $out" ;; *) pass ;; esac
}
for mesh in meshes/non_manifold/*.obj meshes/valid/*.obj "$folder/bowtie.off" "$folder/book.off"; do
  mend "$mesh"
done
if [ -d ../shared/corpus ]; then
  for mesh in ../shared/corpus/*.obj; do
    mend "$mesh"
  done
else
  echo "skipped: the corpus is not there"
fi

finish
