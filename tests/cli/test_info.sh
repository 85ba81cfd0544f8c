# info: sizes by formula and measured.
. tests/cli/lib.sh

run 0 info "$folder/cube.off" --json
prints '"sizes": {"separate_triangles": {"units": 108, "bytes": 864}'
prints '"indexed_mesh": {"units": 60, "bytes": 336}'
prints '"indexed_polygons": {"units": 48, "bytes": 288}'
prints '"triangle_strips": {"units": 38, "bytes": 248}'
prints '"triangle_fans": {"units": 42, "bytes": 264}'
prints '"triangle_neighbor": {"units": 104, "bytes": 512}'
prints '"triangle_neighbor_plain": {"units": 104, "bytes": 512}'
prints '"winged_edge": {"units": 134, "bytes": 632}'
prints '"half_edge": {"units": 110, "bytes": 536}'
prints '"formats": {'
prints '"obj": {"units": 48, "bytes": null}'
prints '"stl": {"units": 144, "bytes": 600}'
prints '"ply": {"units": 54, "bytes": 294}'

# Measured: arrays and what stands around them; STL has a header of 84 bytes.
run 0 info "$folder/cube.off" --json --measure
prints '"separate_triangles": {"units": 108, "bytes": 864, "measured": 864}'
prints '"triangle_neighbor_plain": {"units": 104, "bytes": 512, "measured": 512}'
prints '"stl": {"units": 144, "bytes": 600, "measured": 684}'
# The file is as long as was measured.
for format in obj off ply stl; do
  run 0 convert "$folder/cube.off" "$folder/written.$format" -q
  run 0 info "$folder/cube.off" --json --measure
  case $format in obj | off) bytes=null ;; ply) bytes=294 ;; stl) bytes=600 ;; esac
  holds "$format is as long as was measured" \
    grep -q "\"$format\": {\"units\": [0-9]*, \"bytes\": $bytes, \"measured\": $(stat -c %s "$folder/written.$format")}" "$folder/.out"
done

# Strips and fans are those that are written, text giving an index a word and "f" before a fan.
for kind in strip fan; do
  run 0 strips "$folder/cube.off" -o "$folder/strips.txt" --kind $kind -q
  indices=$(awk '{ n += NF - ($1 == "f") } END { print n + NR - 1 }' "$folder/strips.txt")
  run 0 info "$folder/cube.off" --json --measure
  prints "\"triangle_${kind}s\": {\"units\": $([ $kind = strip ] && echo 38, \"bytes\": 248 || echo 42, \"bytes\": 264), \"measured\": $((8 * 24 + 4 * indices))}"
done

# What a structure cannot hold is null, and no failure; nothing is built unless asked.
run 0 info "$folder/book.off" --json --measure
prints '"half_edge": {"units": 53, "bytes": 272, "measured": null}'
run 0 info "$folder/book.off" --measure
prints "by formula and measured"
prints "cannot hold"
run 0 info "$folder/book.off"
prints "half-edges           4 n_v + 6 n_e + n_f"
case $out in *"cannot hold"*) fail "nothing was asked to be held" ;; *) pass ;; esac

finish
