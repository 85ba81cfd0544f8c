#!/bin/bash
# Writes the files of meshes/malformed: what readers must refuse with a clear message, read with a warning, or read
# rightly although it is odd. meshes/malformed/manifest.csv says what is expected of each.
#     tests/support/make_malformed.sh meshes/malformed
set -euo pipefail
folder=${1:?usage: make_malformed.sh FOLDER}
mkdir -p "$folder"/{drc,glb,gltf,obj,off,ply,stl}

# Writes standard input to a file of the folder.
file() { cat > "$folder/$1"; }
# Little-endian and big-endian words of 32 bits, 16 bits.
le32() { local w; for w in "$@"; do printf "\\x$(printf %02x $((w & 255)))\\x$(printf %02x $((w >> 8 & 255)))\\x$(printf %02x $((w >> 16 & 255)))\\x$(printf %02x $((w >> 24 & 255)))"; done; }
be32() { local w; for w in "$@"; do printf "\\x$(printf %02x $((w >> 24 & 255)))\\x$(printf %02x $((w >> 16 & 255)))\\x$(printf %02x $((w >> 8 & 255)))\\x$(printf %02x $((w & 255)))"; done; }
le16() { local w; for w in "$@"; do printf "\\x$(printf %02x $((w & 255)))\\x$(printf %02x $((w >> 8 & 255)))"; done; }
byte() { local w; for w in "$@"; do printf "\\x$(printf %02x $((w & 255)))"; done; }
# The floats used, as bits.
zero=0x00000000 one=0x3f800000 minus=0xbf800000 nan=0x7fc00000

# ---- OBJ ----
triangle=$'v 0 0 0\nv 1 0 0\nv 0 1 0\n'
obj() { file "obj/$1.obj"; }
: | obj empty
printf '%sf 0 1 2\n' "$triangle" | obj index_zero
printf '%sf 1 2 4\n' "$triangle" | obj index_past_end
printf 'f 1 2 3\n%s' "$triangle" | obj forward_references
printf '%sf -1 -2 -4\n' "$triangle" | obj negative_past_start
printf '%sf -3 -2 -1\nv 5 0 0\nf -4 -1 -2\n' "$triangle" | obj negative_indices
printf '%sf 1 2 99999999999\n' "$triangle" | obj index_overflow
printf '%sf 1 2\n' "$triangle" | obj face_of_two
printf '%sf\n' "$triangle" | obj face_of_none
printf '%sl 1 2 3\np 1 3\nf 1 2 3\n' "$triangle" | obj wires_and_points
printf '%svt 0 0\nvn 0 0 1\nf 1/1/1/1 2/1/1/1 3/1/1/1\n' "$triangle" | obj four_numbers_at_a_corner
printf '%svt 0 0\nf 1/a 2/1 3/1\n' "$triangle" | obj letter_for_an_index
printf '%sf 1.5 2 3\n' "$triangle" | obj fraction_for_an_index
printf '%svt 0 0\nvn 0 0 1\nf 1/ 2// 3/1/1\nf 1/1 2//1 3\n' "$triangle" | obj mixed_corners
printf 'v 0 0 0\nv 1 0\nv 0 1 0\nf 1 2 3\n' | obj vertex_of_two_numbers
printf 'v 0 0 zero\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' | obj word_for_a_number
printf 'v 0 0 0 1\nv 1 0 0 1\nv 0 1 0 1\nf 1 2 3\n' | obj vertices_with_weights
printf 'v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\n' | obj vertices_with_colors
printf '%sf 1 \\\n2 \\\n3\n' "$triangle" | obj continued_lines
printf '%sf 1 2 3 \\' "$triangle" | obj continued_at_the_end
printf 'mtllib missing.mtl\n%susemtl red\nf 1 2 3\n' "$triangle" | obj material_library
printf '%svt 0 0\nf 1/1 2/1 3/2\n' "$triangle" | obj uv_past_end
printf '%svn 0 0 1\nf 1//1 2//1 3//2\n' "$triangle" | obj normal_past_end
printf '%sfrobnicate 1 2\nfrobnicate 3\nf 1 2 3\n' "$triangle" | obj unknown_keyword
printf 'v 0,5 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' | obj decimal_comma
printf 'v 1e400 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' | obj number_too_large
printf 'v nan 0 0\nv inf 0 0\nv 0 1 0\nf 1 2 3\n' | obj nan_and_infinity
printf '%sf 1 2 \0 3\n' "$triangle" | obj nul_byte
printf '\xef\xbb\xbf%sf 1 2 3\n' "$triangle" | obj utf8_mark
printf '%sf 1 2 3\n' "$triangle" | sed 's/./&\x00/g; 2,$s/^/\x00/' | { printf '\xff\xfe'; cat; printf '\0'; } | obj utf16
printf '%sf 1 2 3\n' "$triangle" | sed 's/$/\r/' | obj crlf
printf '%sf 1 2 3' "$triangle" | tr '\n' '\r' | obj lone_cr
printf 'v\t0 0\v0  \n  v 1 0 0\nv 0 1 0\t\n\n\nf 1 2\t3  ' | obj odd_spaces
printf 'ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n' | obj ply_inside

# ---- OFF ----
off() { file "off/$1.off"; }
points=$'0 0 0\n1 0 0\n0 1 0\n'
: | off empty
printf 'OFF\n0 0 0\n' | off zero_counts
printf 'OFF\n-3 1 0\n%s3 0 1 2\n' "$points" | off negative_count
printf 'OFF\n3 2 0\n%s3 0 1 2\n' "$points" | off missing_face
printf 'OFF\n4 1 0\n%s' "$points" | off missing_vertex
printf 'OFF\n3 1 0\n%s3 0 1 3\n' "$points" | off index_past_end
printf 'OFF\n3 1 0\n%s3 0 1 -1\n' "$points" | off negative_index
printf 'OFF\n3 1 0\n%s2 0 1\n' "$points" | off face_of_two
printf 'OFF\n3 1 0\n%s3 0 1\n' "$points" | off face_cut_short
printf 'OFF\n4000000000 1 0\n%s3 0 1 2\n' "$points" | off count_of_billions
printf 'OFF\n99999999999999999999 1 0\n%s3 0 1 2\n' "$points" | off count_overflow
printf 'OFF\n3 1\n%s3 0 1 2\n' "$points" | off no_edge_count
printf '3 1 0\n%s3 0 1 2\n' "$points" | off no_header
printf 'OFF 3 1 0\n%s3 0 1 2\n' "$points" | off counts_beside_header
printf '# first\nOFF # second\n# third\n3 1 0 # fourth\n0 0 0\n# fifth\n1 0 0\n0 1 0 # sixth\n3 0 1 2 # last\n' | off comments
printf 'COFF\n3 1 0\n0 0 0 1 0 0 1\n1 0 0 0 1 0 1\n0 1 0 0 0 1 1\n3 0 1 2\n' | off vertex_colors
printf 'STCNOFF\n3 1 0\n0 0 0 0 0 1 255 0 0 255 0 0\n1 0 0 0 0 1 0 255 0 255 1 0\n0 1 0 0 0 1 0 0 255 255 0 1\n3 0 1 2\n' | off all_prefixes
printf 'OFF\n3 4 0\n%s3 0 1 2 7\n3 0 1 2 255 0 0\n3 0 1 2 0.5 0.25 1\n3 0 1 2 255 0 0 128\n' "$points" | off face_colors
printf '4OFF\n3 1 0\n0 0 0 1\n1 0 0 1\n0 1 0 1\n3 0 1 2\n' | off four_dimensions
printf 'nOFF\n2\n3 1 0\n0 0\n1 0\n0 1\n3 0 1 2\n' | off any_dimensions
printf 'OFF\n3 1 0\n0 0 0\n1,5 0 0\n0 1 0\n3 0 1 2\n' | off decimal_comma
printf 'OFF\n3 1 0\n0 0 1e999\n1 0 0\n0 1 0\n3 0 1 2\n' | off number_too_large
printf 'OFF\n3 1 0\n0 0 nan\n1 0 0\n0 1 0\n3 0 1 2\n' | off nan
printf 'OFF\n3 1 0\n0 0 x\n1 0 0\n0 1 0\n3 0 1 2\n' | off word_for_a_number
{ printf 'OFF BINARY\n'; be32 3 1 3 $zero $zero $zero $one $zero $zero $zero $one $zero 3 0 1 2 0; } | off binary_big_endian
{ printf 'OFF BINARY\n'; le32 3 1 3 $zero $zero $zero $one $zero $zero $zero $one $zero 3 0 1 2 0; } | off binary_little_endian
{ printf 'OFF BINARY\n'; be32 3 1 3 $zero $zero $zero $one $zero; } | off binary_cut_short

# ---- PLY ----
ply() { file "ply/$1.ply"; }
# A header: encoding, vertex count, face count.
header() { printf 'ply\nformat %s 1.0\nelement vertex %s\nproperty float x\nproperty float y\nproperty float z\nelement face %s\nproperty list uchar int vertex_indices\nend_header\n' "$@"; }
floats=($zero $zero $zero $one $zero $zero $zero $one $zero)
: | ply empty
printf 'plx\nformat ascii 1.0\nend_header\n' | ply wrong_magic
header ascii 0 0 | ply zero_counts
{ header ascii -3 1; printf '%s3 0 1 2\n' "$points"; } | ply negative_count
{ header ascii 4000000000 1; printf '%s3 0 1 2\n' "$points"; } | ply count_of_billions
{ header binary_little_endian 4000000000 1; le32 "${floats[@]}"; } | ply binary_count_of_billions
{ header ascii 3 1 | sed 's/list uchar/list float/'; printf '%s3 0 1 2\n' "$points"; } | ply list_count_float
{ header ascii 3 1 | sed 's/list uchar int/list uchar float/'; printf '%s3 0 1 2\n' "$points"; } | ply indices_float
{ header binary_little_endian 3 1 | sed 's/list uchar/list char/'; le32 "${floats[@]}"; byte -3; le32 0 1 2; } | ply list_count_negative
{ header binary_little_endian 3 1; le32 "${floats[@]}"; byte 255; le32 0 1 2; } | ply list_past_end
{ header ascii 3 1; printf '%s300000000 0 1 2\n' "$points"; } | ply list_of_millions
{ header ascii 3 1; printf '%s2 0 1\n' "$points"; } | ply face_of_two
header ascii 3 1 | sed '/end_header/d' | ply no_end_header
{ header ascii 3 1 | sed 's/property float y/property quad y/'; printf '%s3 0 1 2\n' "$points"; } | ply unknown_type
{ header ascii 3 1 | sed 's/property float y/property float x/'; printf '%s3 0 1 2\n' "$points"; } | ply duplicate_property
{ header ascii 3 1 | sed 's/format ascii/format morse/'; printf '%s3 0 1 2\n' "$points"; } | ply unknown_encoding
{ header ascii 3 1 | sed '/property float z/d'; printf '0 0\n1 0\n0 1\n3 0 1 2\n'; } | ply no_z
{ header ascii 3 1; printf '%s3 0 1 -1\n' "$points"; } | ply index_negative
{ header ascii 3 1; printf '%s3 0 1 3\n' "$points"; } | ply index_past_end
{ header binary_little_endian 3 1; le32 "${floats[@]}"; byte 3; le32 0 1 3; } | ply binary_index_past_end
{ header binary_big_endian 3 1; be32 "${floats[@]}"; byte 3; be32 0 1 -1; } | ply binary_index_negative
{ header ascii 3 1; printf '0 0 0\n1 0 0\n'; } | ply body_short
{ header binary_little_endian 3 1; le32 "${floats[@]}"; byte 3; le32 0 1; } | ply binary_body_short
{ header ascii 3 1; printf '%s3 0 1 2\n3 0 1 2\n' "$points"; } | ply body_long
{ header binary_little_endian 3 1; le32 "${floats[@]}"; byte 3; le32 0 1 2 7; } | ply binary_body_long
{ header ascii 3 1; printf '0,5 0 0\n1 0 0\n0 1 0\n3 0 1 2\n'; } | ply decimal_comma
{ header ascii 3 1; printf '0 nan 0\n1 0 inf\n0 1 0\n3 0 1 2\n'; } | ply nan_and_infinity
{ header ascii 3 1 | sed 's/vertex_indices/vertex_index/'; printf '%s3 0 1 2\n' "$points"; } | ply vertex_index
{ printf 'ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nend_header\n3 0 1 2\n%s' "$points"; } | ply faces_before_vertices
{ header binary_little_endian 3 1 | sed 's/list uchar int/list int8 uint16/'; le32 "${floats[@]}"; byte 3; le16 0 1 2; } | ply lists_of_other_types
{ header binary_little_endian 3 1 | sed 's/$/\r/'; le32 "${floats[@]}"; byte 3; le32 0 1 2; } | ply binary_after_crlf
{ header binary_big_endian 3 1; be32 "${floats[@]}"; byte 3; be32 0 1 2; } | ply big_endian
{ printf 'ply\nformat ascii 1.0\ncomment made by hand\nelement camera 1\nproperty float fov\nproperty list uchar short lens\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty uchar quality\nelement face 1\nproperty list uchar int vertex_indices\nproperty list uchar float texcoord\nend_header\n60 2 1 2\n0 0 0 1\n1 0 0 2\n0 1 0 3\n3 0 1 2 6 0 0 1 0 0 1\n'; } | ply unknown_elements

# ---- STL ----
stl() { file "stl/$1.stl"; }
# A facet in text; the words of its three corners.
facet() { printf 'facet normal 0 0 1\nouter loop\nvertex %s\nvertex %s\nvertex %s\nendloop\nendfacet\n' "$@"; }
plain() { facet '0 0 0' '1 0 0' '0 1 0'; }
# A binary facet: the first coordinate, the attribute.
binary_facet() { le32 $zero $zero $one "$1" $zero $zero $one $zero $zero $zero $one $zero; le16 "$2"; }
binary_header() { printf '%-80s' "$1"; le32 "$2"; }
: | stl empty
printf 'solid nothing\nendsolid nothing\n' | stl zero_facets
binary_header '' 0 | stl binary_zero_facets
{ binary_header 'solid but binary' 1; binary_facet $zero 0; } | stl binary_named_solid
{ binary_header '' 2; binary_facet $zero 0; } | stl count_past_end
{ binary_header '' 2147483648; binary_facet $zero 0; } | stl count_of_billions
{ binary_header '' 1; binary_facet $zero 0; printf 'junk'; } | stl bytes_after_the_last
{ binary_header '' 1; binary_facet $nan 0; } | stl nan_facet
{ binary_header '' 2; binary_facet $zero 7; binary_facet $minus 65535; } | stl attribute_bytes
printf 'neither text nor binary' | stl neither
{ printf 'solid a\n'; plain | sed 's/endloop/vertex 1 1 0\nendloop/'; printf 'endsolid a\n'; } | stl four_vertices
{ printf 'solid a\n'; plain | sed '/0 1 0$/d'; printf 'endsolid a\n'; } | stl two_vertices
{ printf 'solid a\n'; plain | sed '/endloop/d'; printf 'endsolid a\n'; } | stl no_endloop
{ printf 'solid a\n'; plain; } | stl no_endsolid
{ printf 'solid a\n'; plain | head -n 4; } | stl ends_inside_a_facet
{ printf 'solid a\n'; plain | sed 's/1 0 0/1,5 0 0/'; printf 'endsolid a\n'; } | stl decimal_comma
{ printf 'solid a\n'; plain | sed 's/vertex 1 0 0/vertex 1 0/'; printf 'endsolid a\n'; } | stl vertex_of_two_numbers
{ printf 'SOLID A\n'; plain | tr a-z A-Z; printf 'ENDSOLID A\n'; } | stl upper_case
{ printf '   solid a\n'; plain | sed 's/^/\t  /'; printf '  endsolid a\n'; } | stl leading_spaces
{ printf 'solid a\n'; plain; printf 'endsolid a\nsolid b\n'; facet '0 0 1' '1 0 1' '0 1 1'; printf 'endsolid b\n'; } | stl several_solids
{ printf 'solid a\n'; plain; printf 'endsolid a\njunk follows\n'; } | stl junk_after_endsolid
{ printf 'solid a\n'; facet 'nan 0 0' '1 0 0' '0 1 0'; printf 'endsolid a\n'; } | stl nan_facet_in_text

# ---- glTF ----
gltf() { file "gltf/$1.gltf"; }
# The data of a triangle: 36 bytes of positions, 6 of indices, 2 of nothing.
triangle_data() { le32 "${floats[@]}"; le16 0 1 2 0; }
data=$(triangle_data | base64 -w0)
# A whole file: the members of the first node, of the accessor of indices, and of the root are put in.
text() { printf '{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0%s}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},{"bufferView":1,"componentType":5123,"type":"SCALAR"%s}],"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":6}],"buffers":[{"byteLength":44,"uri":"data:application/octet-stream;base64,%s"}]%s}' "$1" "${2:-,\"count\":3}" "${4:-$data}" "$3"; }
: | gltf empty
text '' '' '' | gltf plain
{ printf '\xEF\xBB\xBF'; text '' '' ''; } | gltf utf8_mark
text ',"translation":[1,2,3],"scale":[-1,1,1]' '' '' | gltf moved
text '' ',"count":0' '' | gltf count_zero
text '' ',"count":4611686018427387904' '' | gltf count_overflow
text '' ',"count":4' '' | gltf accessor_past_its_view
text '' ',"count":3,"byteOffset":18446744073709551615' '' | gltf offset_overflow
text '' '' '' | sed 's/"byteLength":36}/"byteLength":36,"byteStride":8}/' | gltf stride_below_element
text '' '' '' | sed 's/"byteOffset":36,"byteLength":6/"byteOffset":36,"byteLength":60/' | gltf view_past_its_buffer
text '' ',"count":3,"sparse":{"count":2,"indices":{"bufferView":1,"componentType":5123},"values":{"bufferView":1}}' '' | gltf sparse_plain
text '' ',"count":3,"sparse":{"count":2,"indices":{"bufferView":1,"byteOffset":2,"componentType":5121},"values":{"bufferView":1}}' '' | gltf sparse_unsorted
text '' ',"count":2,"sparse":{"count":1,"indices":{"bufferView":1,"byteOffset":4,"componentType":5121},"values":{"bufferView":1}}' '' | gltf sparse_past_count
text '' '' '' "$( { le32 "${floats[@]}"; le16 0 1 3 0; } | base64 -w0)" | gltf index_past_count
text '' '' '' "$( { le32 "${floats[@]}"; le16 0 1 65535 0; } | base64 -w0)" | gltf restart_value
text '},{"children":[2]},{"children":[1]' '' '' | gltf node_cycle
text ',"children":[2]},{"children":[2]},{"mesh":0' '' '' | gltf two_parents
text ',"mesh":0' '' '' | gltf duplicate_key
{ printf '{"asset":'; printf '[%.0s' {1..10000}; printf ']%.0s' {1..10000}; printf '}'; } | gltf nested_deeply
text ',"name":"' '' '' | sed 's/"name":"/"name":"\xC3\x28"/' | gltf bad_utf8
text '' '' '' 'AAAA*AAA' | gltf data_bad_base64
text '' '' '' 'AAAAAAAA' | gltf data_short
text '' '' '' | sed 's|"data:[^"]*"|"/etc/passwd"|' | gltf uri_absolute
text '' '' '' | sed 's|"data:[^"]*"|"a/%2e%2e/../b.bin"|' | gltf uri_climbs
text '' '' '' | sed 's|"data:[^"]*"|"https://example.org/b.bin"|' | gltf uri_with_scheme
text '' '' ',"extensionsRequired":["ACME_secret_geometry"]' | gltf extension_unknown
text '' '' ',"extensionsRequired":["KHR_materials_unlit"]' | gltf extension_of_looks
text ',"matrix":[NaN,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]' '' '' | gltf nan_in_matrix
text ',"matrix":[1e999,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]' '' '' | gltf infinity_in_matrix
text '' '' '' | sed 's/"version":"2.0"/"version":"1.0"/' | gltf version_one
text '' '' '' | sed 's/"POSITION":0/"POSITION":0,"TANGENT":0,"_HEAT":0/' | gltf unknown_attributes
printf '{"asset":{"version":"2.0"}}' | gltf nothing
text '' '' '' | head -c 300 | gltf cut_short

# ---- GLB ----
glb() { file "glb/$1.glb"; }
json=$(text '' '' '' | sed 's/,"uri":"[^"]*"//')
while [ $((${#json} % 4)) -ne 0 ]; do json="$json "; done
# magic, version, length: given or right.
glb_header() { printf 'glTF'; le32 "${2:-2}" "${1:-$((12 + 8 + ${#json} + 8 + 44))}"; }
glb_json() { le32 "${1:-${#json}}"; printf 'JSON%s' "$json"; }
glb_data() { le32 "${1:-44}"; printf 'BIN\0'; triangle_data; }
: | glb empty
{ glb_header; glb_json; glb_data; } | glb plain
{ glb_header 4096; glb_json; glb_data; } | glb length_past_end
{ glb_header; glb_json; glb_data; printf 'junk'; } | glb bytes_after_the_end
{ glb_header; glb_json 100000; glb_data; } | glb chunk_past_end
{ glb_header; glb_json; glb_data 4294967295; } | glb data_past_end
{ glb_header; glb_data; glb_json; } | glb json_not_first
{ glb_header '' 1; glb_json; glb_data; } | glb version_one
{ glb_header $((12 + 8 + ${#json})); glb_json; } | glb no_data

# ---- Draco ----
drc() { file "drc/$1.drc"; }
: | drc empty
printf 'DRACO' | drc header_cut_short
{ printf 'DRACO'; byte 9 9 1 1 0 0; } | drc version_nine
{ printf 'DRACO'; byte 2 2 7 1 0 0; } | drc kind_unknown
{ printf 'DRACO'; byte 2 2 1 1 0 0 0 255 255 255 255 7 255 255 255 255 7 0; } | drc edgebreaker_bomb
{ printf 'DRACO'; byte 2 2 1 0 0 0 255 255 255 255 5 255 255 255 255 5 0; } | drc sequential_bomb
{ printf 'DRACO'; byte 2 3 0 0 0 0; le32 2000000000; } | drc points_bomb
{ printf 'DRACO'; byte 2 2 1 1 0 0 0 3 1 0 37 91 4 200 13 77 9 255; } | drc noise
