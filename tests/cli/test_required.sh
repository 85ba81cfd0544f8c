#!/usr/bin/env bash
# Only what is required is built: for each command what --explain --json tells is compared with tests/cli/required.txt,
# which `bash tests/cli/test_required.sh --update` writes anew: the parts built and skipped, the number of allocations,
# and the peak of memory as a multiple of the input files, rounded up to halves; without an input, for scenes,
# which name what they need, and for the surface that tradeoff refines, rounded up to 64 KiB. On one thread none of this depends on the machine.
. tests/cli/lib.sh
table=tests/cli/required.txt
ln -s "$PWD/meshes" "$folder/meshes"
cd "$folder" || exit 1
"$meshtool" generate icosphere -o sphere.ply --resolution 5
"$meshtool" generate icosphere -o larger.ply --resolution 6
cat >plain.json <<'J'
{"camera": {"eye": [0, 0, 5], "target": [0, 0, 0]}, "ambient": 0.2,
 "lights": [{"kind": "directional", "direction": [0, -1, -1], "shadows": false}],
 "meshes": {"t": {"generate": "torus"}},
 "objects": [{"kind": "mesh", "mesh": "t"}, {"kind": "plane", "point": [0, -1, 0]}]}
J
"$meshtool" generate torus -o torus.ply --resolution 64
"$meshtool" convert torus.ply torus.stl -q
"$meshtool" preview sphere.ply -o picture.ppm --size 320x240 -q

runs() {
  printf '%s\n' "info sphere.ply" "info torus.stl" "info sphere.ply --measure" "check-manifold sphere.ply" \
    "check-manifold sphere.ply --self-intersections" "check-manifold torus.ply torus.stl" \
    "check-manifold sphere.ply --paint out.ply" "convert sphere.ply out.obj" "convert torus.ply out.stl" \
    "convert torus.stl out.ply --weld" "convert torus.ply out.off --triangulate --scale 2" "repair torus.ply -o out.ply --weld" \
    "repair torus.ply -o out.ply --all" "topology torus.ply --structure half-edge" \
    "topology sphere.ply --structure winged-edge" "topology sphere.ply --structure triangle-neighbor" \
    "normals sphere.ply -o out.ply" "normals sphere.ply -o out.ply --kind face" \
    "normals sphere.ply -o out.ply --crease 30" "strips sphere.ply -o out.txt" "strips torus.ply -o out.txt --thorough" \
    "subdivide torus.ply -o out.ply -n 1" "subdivide sphere.ply -o out.ply -n 2 --limit" "subdivide torus.ply --dry-run" \
    "distance torus.ply sphere.ply" "distance torus.ply sphere.ply --signed" "generate icosphere -o out.ply --resolution 4" \
    "generate extreme:sliver -o out.obj" "image picture.ppm out.ppm --gray" \
    "image picture.ppm out.ppm --hue-shift 40 --bayer RGGB" "preview sphere.ply -o out.ppm --size 160x120" \
    "preview sphere.ply -o out.ppm --size 160x120 --shading flat" "preview sphere.ply -o out.ppm --size 160x120 --shadows" \
    "preview sphere.ply -o out.ppm --size 160x120 --method ray" "preview torus.ply -o out.ppm --size 160x120 --wireframe" \
    "render plain.json -o out.ppm --size 60x40 --samples 1" \
    "render meshes/scenes/many_lights.json -o out.ppm --size 60x40 --samples 1" \
    "render meshes/scenes/mirror_and_glass.json -o out.ppm --size 60x40 --samples 1" \
    "tradeoff meshes/valid/cube.obj --knob normal-weight --budget 0"
}

# input_bytes RUN: the size of the files that a run reads.
input_bytes() {
  local word total=0
  for word in $1; do
    [ ! -f "$word" ] || [[ $word == out.* ]] || total=$((total + $(stat -L -c %s "$word")))
  done
  echo "$total"
}

# parts JSON BUILT: the names of the parts that were built (true) or skipped (false), each once.
parts() {
  grep -o '"part": "[^"]*", "built": '"$2" <<<"$1" | cut -d'"' -f4 | awk '!seen[$0]++' | paste -sd, | sed 's/,/, /g'
}

total() { sed -n 's/.*"'"$2"'": \([0-9]*\).*/\1/p' <<<"$1"; }

row() {
  local run=$1 told input peak
  rm -f out.*
  "$meshtool" $run --explain --json --threads 1 -q >.out 2>.err || echo "$run: $(cat .err)" >>.failed
  told=$(grep '^{"parts": ' .err)
  input=$(input_bytes "$run")
  peak=$(total "$told" peak_bytes)
  [ "$(total "$told" parts_left_out)" = 0 ] || [ "${run%% *}" = tradeoff ] || echo "$run: parts are left out" >>.failed
  printf '%s\n  built: %s\n  skipped: %s\n  allocations: %s\n' "$run" "$(parts "$told" true)" \
    "$(parts "$told" false)" "$(total "$told" allocations)"
  if [ "$input" = 0 ] || [[ $run == render* || $run == tradeoff* ]]; then
    printf '  peak: %d KiB\n' $(((peak + 65535) / 65536 * 64))
    return
  fi
  awk -v peak="$peak" -v input="$input" 'BEGIN {
    halves = int(2 * peak / input); if (halves * input < 2 * peak) halves++
    printf "  peak: %.1f times the input\n", halves / 2 }'
}

while IFS= read -r run; do row "$run"; done < <(runs) >required.txt
cd "$OLDPWD" || exit 1
holds "no run failed: $(head -3 "$folder/.failed" 2>/dev/null)" test ! -s "$folder/.failed"
if [ "${1-}" = --update ]; then
  cp "$folder/required.txt" "$table"
  finish
fi
if diff "$table" "$folder/required.txt" >"$folder/.err"; then pass; else fail "what is built differs from $table"; fi

# What the table must say, whoever writes it anew: lacks RUN PART..., has RUN PART...
built() { grep -A1 -xF "$1" "$table" | sed -n 's/^  built: //p'; }
lacks() {
  local run=$1 part
  shift
  holds "$run is in the table" test -n "$(built "$run")"
  for part in "$@"; do
    holds "$run builds no $part" test -z "$(built "$run" | tr ',' '\n' | grep -x " *$part")"
  done
}
has() { holds "$1 builds $2" grep -q "\(^\|, \)$2\(,\|$\)" <<<"$(built "$1")"; }
lacks "info sphere.ply" "edge pairs" half-edges "winged edges" "triangle neighbours" "surface tree"
has "info sphere.ply --measure" half-edges
for run in "check-manifold sphere.ply" "check-manifold sphere.ply --self-intersections"; do
  lacks "$run" half-edges "winged edges" "triangle neighbours"
  has "$run" "edge pairs"
done
lacks "check-manifold sphere.ply" "pairs of triangles" "tree of boxes"
lacks "preview sphere.ply -o out.ppm --size 160x120" tree "tree of boxes" "surface tree" "stack of rays"
lacks "render plain.json -o out.ppm --size 60x40 --samples 1" "stack of rays" "shadow rays" "refracted rays"
has "render meshes/scenes/mirror_and_glass.json -o out.ppm --size 60x40 --samples 1" "stack of rays"

# A multiple of the input is one of larger inputs too: of four times the faces it is no higher.
multiple() { sed -n "s/^  peak: \([0-9.]*\) times.*/\1/p"; }
cd "$folder" || exit 1
while IFS= read -r run; do
  small=$(grep -A4 -xF "$run" required.txt | multiple)
  large=$(row "${run/sphere/larger}" | multiple)
  holds "$run: $large times a larger input, $small times this" awk "BEGIN { exit !($large <= $small) }"
done < <(runs | grep -E '^(info|check-manifold|convert|normals|strips|topology|preview) sphere.ply' | grep -v -- --measure)
cd "$OLDPWD" || exit 1

mapfile -t commands < <("$meshtool" help | sed -n '/^Commands:/,/^$/s/^  \([a-z-]*\) .*/\1/p')
holds "help lists the commands" test "${#commands[@]}" -ge 16
for command in "${commands[@]}"; do
  [ "$command" = help ] || [ "$command" = formats ] || # they build nothing
    holds "$command has a run" grep -q "^$command " <(runs)
done
finish
