#!/usr/bin/env bash
# Every #include of lib, formats and cli goes to its own floor or to one below, never up, never to a sibling.
# A public header belongs to the floor in this table; one that is not named here, to the floor that has a source of
# its name (lib/<floor>/<header>.c). Run in the project's root.
set -u

declare -A public_floor=(
    [types]=base [context]=base [checked]=base [clones]=base [vector]=base [elementary]=base [predicates]=base
    [attribute]=mesh [mesh]=mesh [generate]=mesh [triangulate]=mesh
    [edge_pairs]=topology [halfedge]=topology
    [ray]=spatial [ray_structure]=spatial [closest_point]=spatial [surface_tree]=spatial
    [image]=image
    [deviation]=algorithms [signed_distance]=algorithms [manifold]=algorithms [subdivide]=algorithms
    [preview]=render [scene]=render
    [meshtool]=umbrella
)
declare -A rank=([base]=0 [mesh]=1 [topology]=2 [spatial]=2 [image]=2 [algorithms]=3 [render]=3 [formats]=4 [umbrella]=5)
declare -A folder_rank=([stream]=0 [codec]=0 [mesh]=1 [image]=1 [scene]=2)

fail_count=0
complain() {
    printf '%s\n' "$1"
    fail_count=$((fail_count + 1))
}

# floor_of ROOT HEADER: sets floor to that of <meshtool/HEADER.h>, or to nothing.
floor_of() {
    local root=$1 header=$2 sources
    if [[ -e $root/formats/include/meshtool/$header.h ]]; then
        floor=formats
        return
    fi
    floor=${public_floor[$header]-}
    if [[ -z $floor ]]; then
        sources=("$root"/lib/*/"$header".c)
        if [[ ${#sources[@]} == 1 && -e ${sources[0]} ]]; then
            floor=${sources[0]%/*}
            floor=${floor##*/}
        fi
    fi
}

# The rules of one include: check_include ROOT FILE LINE INCLUDED (with its brackets or quotes).
check_include() {
    local root=$1 file=$2 place=$2:$3 included=$4 own header target
    case $file in
    lib/include/meshtool/*.h) header=${file##*/}; floor_of "$root" "${header%.h}"; own=$floor ;;
    lib/*/*) own=${file#lib/}; own=${own%%/*} ;;
    formats/*) own=formats ;;
    cli/*) own=cli ;;
    esac
    if [[ $own != cli && -z ${rank[${own:-none}]-} ]]; then
        [[ $file == lib/include/* ]] && complain "$2: no known floor; list it in tests/unit/test_floors.sh"
        return
    fi
    case $included in
    '<meshtool/'*) header=${included#<meshtool/}; header=${header%.h>} ;;
    '<'*) return ;;
    *) check_private_include "$root" "$file" "$place" "$own" "${included//\"/}"; return ;;
    esac
    floor_of "$root" "$header"
    target=$floor
    if [[ -z $target ]]; then
        complain "$place: $included has no known floor; name its source lib/<floor>/$header.c, or list it in tests/unit/test_floors.sh"
    elif [[ $own == cli || $own == umbrella ]]; then
        return
    elif [[ $target == umbrella ]]; then
        complain "$place: $included includes every floor; include the headers that are meant"
    elif [[ ${rank[$target]} -gt ${rank[$own]} ]]; then
        complain "$place: $own must not include $included, which is above it, on floor $target"
    elif [[ ${rank[$target]} == "${rank[$own]}" && $target != "$own" ]]; then
        complain "$place: $own must not include $included, which is of its sibling $target"
    fi
}

# check_private_include ROOT FILE PLACE OWN PATH
check_private_include() {
    local root=$1 file=$2 place=$3 own=$4 path=$5 own_folder folder
    if [[ $file == */include/meshtool/* ]]; then
        complain "$place: a public header must not include the private \"$path\""
        return
    fi
    case $own in
    cli)
        if [[ $path != cli/* && ! -e $root/cli/$path ]]; then
            complain "$place: cli must not include the private \"$path\"; only <meshtool/...> and its own headers"
        fi
        ;;
    formats)
        own_folder=${file#formats/}; own_folder=${own_folder%%/*}
        folder=${path#formats/}; folder=${folder%%/*}
        if [[ $path != formats/*/* || -z ${folder_rank[$folder]-} ]]; then
            complain "$place: formats must not include the private \"$path\"; only <meshtool/...> and \"formats/<folder>/...\""
        elif [[ ${folder_rank[$folder]} -gt ${folder_rank[$own_folder]} ]]; then
            complain "$place: formats/$own_folder must not include \"$path\", which is above it"
        elif [[ ${folder_rank[$folder]} == "${folder_rank[$own_folder]}" && $folder != "$own_folder" ]]; then
            complain "$place: formats/$own_folder must not include \"$path\", which is of its sibling"
        fi
        ;;
    *)
        if [[ $path != lib/$own/* ]]; then
            complain "$place: $own must not include \"$path\"; only <meshtool/...> and its own \"lib/$own/...\""
        fi
        ;;
    esac
}

# Complains about folders whose floor nobody knows; an unknown floor would be checked by no rule.
check_folders() {
    local root=$1 folder name
    for folder in "$root"/lib/*/ "$root"/formats/*/; do
        [[ -d $folder ]] || continue
        name=${folder%/}
        name=${name##*/}
        case $folder in
        */include/) ;;
        */lib/*) [[ -n ${rank[$name]-} ]] || complain "lib/$name: not a floor; list it in tests/unit/test_floors.sh" ;;
        *) [[ -n ${folder_rank[$name]-} ]] || complain "formats/$name: not a folder of formats; list it in tests/unit/test_floors.sh" ;;
        esac
    done
}

# check_tree ROOT: complains about every wrong include; sets include_count.
check_tree() {
    local root=$1 file line included
    fail_count=0
    include_count=0
    check_folders "$root"
    while IFS=$'\t' read -r file line included; do
        include_count=$((include_count + 1))
        check_include "$root" "$file" "$line" "$included"
    done < <(cd "$root" && find lib formats cli -type f \( -name '*.[ch]' -o -name '*.[ch]pp' \) 2>/dev/null | LC_ALL=C sort |
        xargs -r awk 'match($0, /^[ \t]*#[ \t]*include[ \t]*/) {
            rest = substr($0, RLENGTH + 1); sub(/[>"][^>"]*$/, substr(rest, 1, 1) == "<" ? ">" : "\"", rest)
            print FILENAME "\t" FNR "\t" rest }')
}

# Plants files in a temporary tree; each must be complained about, by its place, or not at all.
self_test() {
    local folder output missed=0
    folder=$(mktemp -d)
    plant() {
        mkdir -p "$folder/$(dirname "$1")"
        printf '/* planted */\n%s\n' "$2" >"$folder/$1"
    }
    plant formats/include/meshtool/mesh_format.h '#include <meshtool/mesh.h>'
    plant lib/algorithms/good.c '#include <meshtool/halfedge.h>'
    plant lib/spatial/tree.c '#include "lib/spatial/tree.h"'
    plant lib/spatial/other.c '#include <meshtool/tree.h>'
    plant cli/good.c '#include <meshtool/meshtool.h>'
    plant cli/commands.c '#include "commands.h"'
    plant cli/commands.h '#include <stdio.h>'
    plant formats/mesh/good.c '#include "formats/stream/input.h"'
    plant formats/stream/good.c '#include <meshtool/mesh_format.h>'
    check_tree "$folder" >/dev/null
    if [[ $fail_count != 0 ]]; then
        echo "self-test: a tree without a violation was complained about:"
        check_tree "$folder"
        missed=1
    fi
    plant lib/mesh/up.c '#include <meshtool/halfedge.h>'
    plant lib/topology/sibling.c '  #  include   <meshtool/image.h>  /* why */'
    plant lib/render/sibling.c '#include <meshtool/manifold.h>'
    plant lib/image/private.c '#include "lib/base/context.h"'
    plant lib/base/relative.c '#include "context.h"'
    plant lib/mesh/by_name.c '#include <meshtool/tree.h>'
    plant lib/algorithms/all.c '#include <meshtool/meshtool.h>'
    plant lib/algorithms/file.c '#include <meshtool/mesh_format.h>'
    plant lib/algorithms/unknown.c '#include <meshtool/nowhere.h>'
    plant lib/include/meshtool/mesh.h '#include <meshtool/subdivide.h>'
    plant lib/include/meshtool/vector.h '#include "lib/base/wide_integer.h"'
    plant formats/stream/up.cpp '#include "formats/mesh/records.h"'
    plant formats/image/sibling.c '#include "formats/mesh/records.h"'
    plant formats/mesh/library.c '#include "lib/mesh/mesh.h"'
    plant cli/private.c '#include "lib/mesh/mesh.h"'
    plant cli/stream.c '#include "formats/stream/input.h"'
    output=$(check_tree "$folder")
    for place in lib/mesh/up.c lib/topology/sibling.c lib/render/sibling.c lib/image/private.c lib/base/relative.c \
        lib/mesh/by_name.c lib/algorithms/all.c lib/algorithms/file.c lib/algorithms/unknown.c \
        lib/include/meshtool/mesh.h lib/include/meshtool/vector.h formats/stream/up.cpp formats/image/sibling.c \
        formats/mesh/library.c cli/private.c cli/stream.c; do
        if [[ $'\n'$output != *$'\n'"$place:2: "* ]]; then
            echo "self-test: the violation planted in $place was not found"
            missed=1
        fi
    done
    if [[ $(wc -l <<<"$output") != 16 ]]; then
        echo "self-test: 16 violations were planted, these were found:"
        echo "$output"
        missed=1
    fi
    plant lib/attic/file.c '#include <meshtool/mesh.h>'
    plant lib/include/meshtool/nobody.h '#include <meshtool/mesh.h>'
    output=$(check_tree "$folder")
    if [[ $output != *"lib/attic: not a floor"* || $output != *"lib/include/meshtool/nobody.h: no known floor"* ]]; then
        echo "self-test: an unknown floor was not found"
        missed=1
    fi
    rm -rf "$folder"
    return $missed
}

self_test || exit 1
check_tree .
# The top level holds these and dot files, nothing else.
top=$(git ls-files 2>/dev/null | cut -d/ -f1 | sort -u | grep -vE '^\.' |
    grep -vxE 'CMakeLists.txt|CMakePresets.json|CONTRIBUTING.md|LICENSE|README.md|cli|dev|formats|lib|meshes|tests' || true)
if [[ $top ]]; then
    echo "does not belong at the top level: $top"
    exit 1
fi
echo "$include_count includes, $fail_count wrong"
[[ $include_count -gt 0 && $fail_count == 0 ]]
