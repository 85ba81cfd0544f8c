# Every command under limits of memory from too little to enough: it is done, or exit 5 with the limit named, and a
# failed run leaves no output.
. tests/cli/lib.sh
cd "$folder" || exit 1
"$meshtool" convert cube.off cube.stl 2>/dev/null
"$meshtool" generate icosphere -o sphere.ply
mkdir out
printf 'crease 0 1 2\ncorner 2 1\nhole 0\ncrease 1 2 10\n' >list

# limited SIZE NAME ARGUMENTS...: one run; counts those that ended well and those that met the limit.
limited() {
  local size=$1
  shift
  "$meshtool" "$@" --max-memory "$size" >/dev/null 2>err
  case $? in
    0 | 1) enough=$((enough + 1)) ;;
    5)
      refused=$((refused + 1))
      [[ $(<err) =~ limit|--max-memory\ is ]] || fail "the limit is not named: $*: $(<err)"
      ! compgen -G "out/*" >/dev/null || fail "an output of a failed run is left: $*"
      ;;
    *) fail "exit $? with --max-memory $size: $*: $(<err)" ;;
  esac
  ! compgen -G "out/*" >/dev/null || rm -f out/*
}

# A run that ends under a limit never meets a higher one: two are enough, and then the highest.
sweep() {
  enough=0
  refused=0
  for size in 1 1000 4000 16000 64000 80000 100000 150000 200000 256000 300000 400000 512000 700000 1000000 1500000 \
    2000000 4000000 8000000 64000000; do
    [ "$enough" -ge 2 ] && [ "$size" != 64000000 ] || limited "$size" "$@"
  done
  holds "some limits are too small: $*" test "$refused" -gt 0
  holds "some limits are enough: $*" test "$enough" -gt 0
}

for file in cube.stl sphere.ply; do
  sweep info "$file"
  sweep check-manifold "$file"
  sweep check-manifold "$file" --json --all-defects --paint out/painted.ply
  sweep check-manifold "$file" --paint out/painted.png
  sweep convert "$file" out/x.obj --triangulate --weld --rotate x,30
  sweep convert "$file" out/x.stl
  sweep subdivide "$file" -o out/x.ply -n 2
  sweep subdivide "$file" -o out/x.ply --limit
  sweep subdivide "$file" -o out/x.ply --creases list --crease-angle 20 --non-manifold crease --uv none
  sweep subdivide "$file" --dry-run
  sweep preview "$file" -o out/x.png --size 64x64
done
sweep generate teapot -o out/x.ply
finish
