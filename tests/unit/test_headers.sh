#!/usr/bin/env bash
# Every public header compiles alone, twice over, as C17 and as C++17; every private one as C17. Run in the project's
# root, with the compilers in CC and CXX.
set -u
cc=${CC:-cc}
cxx=${CXX:-c++}
warnings=(-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wundef -Werror -fsyntax-only)

# compiles ROOT INCLUDED LANGUAGE: whether INCLUDED (with its brackets or quotes) compiles; prints why not.
compiles() {
    local root=$1 included=$2 language=$3 compiler=("$cc" -std=c17 -Wstrict-prototypes -x c)
    if [[ $language == C++17 ]]; then
        compiler=("$cxx" -std=c++17 -x c++)
    fi
    printf '#include %s\n#include %s\ntypedef int no_empty_file;\n' "$included" "$included" |
        "${compiler[@]}" "${warnings[@]}" -I "$root/lib/include" -I "$root/formats/include" -I "$root" - 2>&1
}

# check_tree ROOT: prints every header that does not compile; sets checked and wrong.
check_tree() {
    local root=$1 header included language languages output
    checked=0
    wrong=0
    while read -r header; do
        case $header in
        */include/meshtool/*) included="<meshtool/${header##*/}>" languages="C17 C++17" ;;
        *) included="\"$header\"" languages="C17" ;;
        esac
        for language in $languages; do
            checked=$((checked + 1))
            if ! output=$(compiles "$root" "$included" "$language"); then
                wrong=$((wrong + 1))
                printf '%s does not compile alone as %s:\n%s\n' "$header" "$language" "$output"
            fi
        done
    done < <(cd "$root" && find lib formats -name '*.h' 2>/dev/null | LC_ALL=C sort)
}

# Plants headers in a temporary tree; check_tree must find those that are wrong, and no other.
self_test() {
    local folder output missed=0 expected
    folder=$(mktemp -d)
    mkdir -p "$folder/lib/include/meshtool" "$folder/formats/include/meshtool" "$folder/lib/base"
    echo 'static inline int mt_one(void) { return 1; }' >"$folder/lib/include/meshtool/unguarded.h"
    printf '#pragma once\nuint32_t mt_two(void);\n' >"$folder/formats/include/meshtool/lacking.h"
    printf '#pragma once\nint mt_three(int class);\n' >"$folder/lib/include/meshtool/not_cplusplus.h"
    printf '#pragma once\nint mt_four(size_t size);\n' >"$folder/lib/base/private.h"
    printf '#pragma once\n#include <stddef.h>\nint mt_five(size_t size);\n' >"$folder/lib/base/good.h"
    output=$(check_tree "$folder")
    for expected in "unguarded.h does not compile alone as C17" "unguarded.h does not compile alone as C++17" \
        "lacking.h does not compile alone as C17" "lacking.h does not compile alone as C++17" \
        "not_cplusplus.h does not compile alone as C++17" "lib/base/private.h does not compile alone as C17"; do
        if [[ $output != *"$expected"* ]]; then
            echo "self-test: not found: $expected"
            missed=1
        fi
    done
    if [[ $(grep -c 'does not compile alone' <<<"$output") != 6 ]]; then
        echo "self-test: 6 violations were planted, these were found:"
        echo "$output"
        missed=1
    fi
    rm -rf "$folder"
    return $missed
}

self_test || exit 1
check_tree .
echo "$checked compilations, $wrong wrong"
[[ $checked -gt 0 && $wrong == 0 ]]
