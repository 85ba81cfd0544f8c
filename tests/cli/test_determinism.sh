#!/usr/bin/env bash
# Every command writes the same bytes for 1, 2 and 7 threads, with fused and wide instructions masked, and from every
# compiler: sums are compared with tests/cli/determinism.sums, which `bash tests/cli/test_determinism.sh --update` writes
# anew. What other libraries compress (PNG, Draco, gz) is compared between runs alone.
. tests/cli/lib.sh
sums=tests/cli/determinism.sums
meshes=(meshes/valid/teapot.obj meshes/non_manifold/book_and_bow_tie.obj)

"$meshtool" generate torus -o "$folder/torus.ply" --resolution 48
"$meshtool" generate icosphere -o "$folder/sphere.ply" --resolution 4
"$meshtool" preview meshes/valid/teapot.obj -o "$folder/teapot.ppm" --size 64x48 -q

# A line for each run: the command and its options; OUT is the file it writes, and without it standard output counts.
runs() {
  local mesh
  for mesh in "${meshes[@]}"; do
    printf '%s\n' "check-manifold $mesh --json --self-intersections" "info $mesh --json" \
      "repair $mesh -o OUT.ply --all" "convert $mesh OUT.obj" "convert $mesh OUT.off" "convert $mesh OUT.stl" \
      "convert $mesh OUT.glb" "convert $mesh OUT.gltf" "convert $mesh OUT.ply --encoding ascii" \
      "topology $mesh --structure half-edge --split-non-manifold --json" \
      "topology $mesh --structure winged-edge --split-non-manifold --json" "normals $mesh -o OUT.ply" \
      "normals $mesh -o OUT.obj --kind corner --weight angle" "strips $mesh -o OUT.txt" \
      "preview $mesh -o OUT.ppm --size 160x120" "preview $mesh -o OUT.ppm --size 96x96 --shadows --ground" \
      "preview $mesh -o OUT.pfm --size 64x64 --samples adaptive --wireframe --color-by defect" "preview $mesh -o OUT.ppm --size 96x96 --method ray --shadows --ground" \
      "preview $mesh -o OUT.png --size 160x120" "convert $mesh OUT.drc" "convert $mesh OUT.ply.gz" \
      "convert $mesh OUT.obj.zst"
  done
  printf '%s\n' "subdivide meshes/valid/teapot.obj -o OUT.ply -n 2" "subdivide $folder/torus.ply -o OUT.ply -n 2 --limit" \
    "subdivide meshes/non_manifold/book_and_bow_tie.obj -o OUT.obj -n 2 --non-manifold crease" \
    "distance $folder/torus.ply $folder/sphere.ply --json" "distance $folder/torus.ply $folder/sphere.ply --json --signed" \
    "strips meshes/valid/torus.off -o OUT.txt --thorough --join degenerate" "generate klein -o OUT.ply --resolution 64" \
    "generate extreme:stadium -o OUT.obj" "render meshes/scenes/mirror_and_glass.json -o OUT.ppm --size 60x40 --samples 1" \
    "render meshes/scenes/mirror_and_glass.json -o OUT.pfm --size 40x30 --samples adaptive" \
    "render meshes/scenes/cut_away.json -o OUT.ppm --size 60x40 --samples 4" \
    "render meshes/scenes/many_lights.json -o OUT.ppm --size 48x32 --samples 1" \
    "topology $folder/sphere.ply --structure triangle-neighbor --json" "strips meshes/valid/teapot.obj -o OUT.glb --optimize cache" \
    "normals meshes/valid/teapot.obj -o OUT.ply --kind face" "normals meshes/valid/teapot.obj -o OUT.ply --weight max" \
    "strips meshes/valid/teapot.obj -o OUT.txt --kind mixed" \
    "image $folder/teapot.ppm OUT.pfm --linear --gray" "image $folder/teapot.ppm OUT.png --bits 16 --over 200,10,30" \
    "image $folder/teapot.ppm OUT.ppm --bayer GBRG --demosaic GBRG --srgb" \
    "image $folder/teapot.ppm OUT.ppm --hue-shift 40 --desaturate 0.5 --bayer RGGB --demosaic RGGB"
}

# sum_of RUN ARGUMENTS...: prints the sum of what a run writes.
sum_of() {
  local run=$1 extension
  shift
  rm -f "$folder"/OUT.*
  if [[ $run == *OUT.* ]]; then
    extension=$(grep -o 'OUT\.[a-z.]*' <<<"$run")
    "$meshtool" ${run//OUT./$folder/OUT.} -q "$@" 2>"$folder/.err" || echo "$run" >>"$folder/.failed"
    cat "$folder/$extension" $([ "$extension" != OUT.gltf ] || ls "$folder"/OUT.bin 2>/dev/null) | sha256sum | cut -c1-32
  else
    "$meshtool" $run -q "$@" >"$folder/OUT.txt" 2>"$folder/.err" || [ "$run" != "${run#check}" ] || echo "$run" >>"$folder/.failed"
    sed "s|$folder/||g" "$folder/OUT.txt" | sha256sum | cut -c1-32
  fi
}

is_ours() { ! grep -qE 'OUT\.(png|drc|ply\.gz|obj\.zst)' <<<"$1"; }
masked() { GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA_Usable,-FMA,-FMA4_Usable,-AVX2_Usable,-AVX2,-AVX512F sum_of "$@"; }

: >"$folder/sums"
while IFS= read -r run; do
  sum=$(sum_of "$run" --threads 1)
  for threads in 2 7; do
    holds "$run: $threads threads" test "$(sum_of "$run" --threads $threads)" = "$sum"
  done
  holds "$run: masked" test "$(masked "$run" --threads 2)" = "$sum"
  ! is_ours "$run" || printf '%s  %s\n' "$sum" "${run//$folder\//}" >>"$folder/sums"
done < <(runs)
holds "no run failed: $(sort -u "$folder/.failed" 2>/dev/null | head -3)" test ! -s "$folder/.failed"
if [ "${1-}" = --update ]; then
  cp "$folder/sums" "$sums"
  exit
fi
if diff "$sums" "$folder/sums" >"$folder/.err"; then pass; else fail "bytes differ from $sums"; fi

# A command without a run would be tested by nobody.
mapfile -t commands < <("$meshtool" help | sed -n '/^Commands:/,/^$/s/^  \([a-z-]*\) .*/\1/p')
holds "help lists the commands" test "${#commands[@]}" -ge 16
for command in "${commands[@]}"; do
  case $command in
  help | formats | tradeoff) ;; # no data, no threads; times
  *) holds "$command has a run" grep -q "^$command " <(runs) ;;
  esac
done
finish
