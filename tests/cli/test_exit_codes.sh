# Each exit code of the contract, from the table in the help to the runs that end with it.
. tests/cli/lib.sh

run 0 check-manifold "$folder/cube.off"
run 0 check-manifold "$folder/open.off"
run 1 check-manifold "$folder/open.off" --closed
run 0 check-manifold "$folder/cube.off" --closed --oriented
run 1 check-manifold "$folder/bowtie.off"
run 1 check-manifold "$folder/book.off"
run 0 check-manifold "$folder/flipped.off"
run 1 check-manifold "$folder/flipped.off" --oriented
run 0 check-manifold "$folder/cube.off" --watertight
run 1 check-manifold "$folder/open.off" --watertight
run 1 check-manifold "$folder/flipped.off" --watertight
run 0 check-manifold "$folder/open.off" --self-intersections
run 3 check-manifold "$folder/bad.off"
says "$folder/bad.off:5"
run 3 subdivide "$folder/bowtie.off" -o "$folder/x.off"
says "bowtie.off"
run 3 subdivide "$folder/book.off" -o "$folder/x.off"
run 3 subdivide "$folder/flipped.off" -o "$folder/x.off"
run 3 subdivide "$folder/book.off" --dry-run
run 4 info "$folder/none.off"
says "$folder/none.off"
run 3 info "$folder"
run 5 info "$folder/cube.off" --max-memory 1K
says "$folder/cube.off"
run 5 subdivide "$folder/cube.off" -n 31 -o "$folder/x.off"

# Several files: 7 when some failed, else 1 when one says no.
run 0 check-manifold "$folder/cube.off" "$folder/open.off"
run 1 check-manifold "$folder/cube.off" "$folder/book.off"
run 7 check-manifold "$folder/cube.off" "$folder/none.off" "$folder/book.off"
prints "$folder/cube.off: "
prints "$folder/book.off: not manifold"
says "$folder/none.off"
run 7 info "$folder/none.off" "$folder/cube.off"
run 7 info "$folder/bad.off" "$folder/none.off"

# Losing anything can be forbidden.
printf 'OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n5 5 5\n3 0 1 2\n' >"$folder/isolated.off"
run 0 convert "$folder/isolated.off" "$folder/isolated.stl"
says "warning: $folder/isolated.stl"
run 3 convert "$folder/isolated.off" "$folder/strict.stl" --strict-loss
holds "strict-loss writes nothing" test ! -e "$folder/strict.stl"
run 0 convert "$folder/isolated.off" "$folder/isolated.stl" -q
holds "-q prints no warning" test -z "$err"
run 0 convert "$folder/isolated.off" "$folder/isolated.stl" --json
prints '{"lost": ["'

# Quiet: the exit code alone.
run 1 check-manifold "$folder/book.off" -q
silent

holds "no output of failed runs is left" test -z "$(find "$folder" -name 'x.off*')"
finish
