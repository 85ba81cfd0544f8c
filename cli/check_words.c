#include "check_words.h"

#include <stdio.h>

/* What a kind of defect is, for one and for several, how it is mended, and what it is found on. */
typedef struct defect_words {
    const char *one, *several, *cure_one, *cure_several;
    char element; /* v, e, f, p for a pair of faces, c for a component */
    bool breaks;
} defect_words;

static const defect_words words[MT_DEFECT_KIND_COUNT] = {
    [MT_DEFECT_NON_FINITE_VERTEX] = {"vertex has a coordinate that is NaN or infinite",
                                     "vertices have a coordinate that is NaN or infinite",
                                     "give it a place, or drop its faces", "give them places, or drop their faces", 'v',
                                     false},
    [MT_DEFECT_DEGENERATE_FACE] = {"face names a vertex more than once", "faces name a vertex more than once",
                                   "drop the face, or the repeated corner", "drop the faces, or the repeated corners",
                                   'f', true},
    [MT_DEFECT_DUPLICATE_FACE] = {"face repeats an earlier one", "faces repeat earlier ones", "drop it", "drop them",
                                  'f', false},
    [MT_DEFECT_NON_MANIFOLD_EDGE] = {"edge has three faces or more", "edges have three faces or more",
                                     "drop the faces too many, or give each surface its own edge",
                                     "drop the faces too many, or give each surface its own edges", 'e', true},
    [MT_DEFECT_BOUNDARY_PINCH] = {"vertex is where the boundary touches itself",
                                  "vertices are where the boundary touches itself",
                                  "give each part of the boundary its own copy of it",
                                  "give each part of the boundary its own copy of them", 'v', false},
    [MT_DEFECT_NON_MANIFOLD_VERTEX] = {"vertex joins separate surfaces", "vertices join separate surfaces",
                                       "give each surface its own copy of it", "give each surface its own copy of them",
                                       'v', true},
    [MT_DEFECT_MISORIENTED_EDGE] = {"edge lies between faces turned opposite ways",
                                    "edges lie between faces turned opposite ways", "turn over the faces on one side",
                                    "turn over the faces on one side of them", 'e', false},
    [MT_DEFECT_INSIDE_OUT_COMPONENT] = {"component is inside out", "components are inside out",
                                        "turn over all its faces, unless it is the wall of a cavity",
                                        "turn over all their faces, unless they are walls of cavities", 'c', false},
    [MT_DEFECT_ZERO_AREA_FACE] = {"face has no area, as its vertices lie on one line",
                                  "faces have no area, as the vertices of each lie on one line",
                                  "collapse it, or move a vertex", "collapse them, or move a vertex of each", 'f',
                                  false},
    [MT_DEFECT_SELF_INTERSECTION] = {"pair of faces intersects", "pairs of faces intersect",
                                     "move them apart, or cut both along where they meet and drop what is inside",
                                     "move them apart, or cut them along where they meet and drop what is inside", 'p',
                                     false},
    [MT_DEFECT_ISOLATED_VERTEX] = {"vertex is in no face", "vertices are in no face", "drop it, or leave it",
                                   "drop them, or leave them", 'v', false},
    [MT_DEFECT_BOUNDARY_EDGE] = {"edge has only one face", "edges have only one face",
                                 "fill the hole, if the mesh should be closed",
                                 "fill the holes, if the mesh should be closed", 'e', false},
};

cli_quantity cli_defects_told(const mt_manifold_report *report, mt_defect_kind kind)
{
    mt_index count = report->defect_counts[kind];
    cli_quantity quantity;
    snprintf(quantity.text, sizeof quantity.text, "%.30s %.80s", cli_count(count).text,
             count == 1 ? words[kind].one : words[kind].several);
    return quantity;
}

const char *cli_defect_cure(const mt_manifold_report *report, mt_defect_kind kind)
{
    if (kind == MT_DEFECT_MISORIENTED_EDGE && report->orientable == MT_NO) {
        return "a one-sided surface cannot be without, unless it is cut open";
    }
    return report->defect_counts[kind] == 1 ? words[kind].cure_one : words[kind].cure_several;
}

bool cli_defect_breaks(mt_defect_kind kind)
{
    return words[kind].breaks;
}

bool cli_defect_is_of_edges(mt_defect_kind kind)
{
    return words[kind].element == 'e';
}

bool cli_defect_is_of_pairs(mt_defect_kind kind)
{
    return words[kind].element == 'p';
}

bool cli_defect_is_of_components(mt_defect_kind kind)
{
    return words[kind].element == 'c';
}

bool cli_defect_is_of_faces(mt_defect_kind kind)
{
    return words[kind].element == 'f';
}
