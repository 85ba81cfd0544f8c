/* The words of check-manifold for what it finds. */
#ifndef MESHTOOL_CLI_CHECK_WORDS_H
#define MESHTOOL_CLI_CHECK_WORDS_H

#include "quantity.h"

#include <meshtool/manifold.h>

/* "2 edges have three faces or more" */
cli_quantity cli_defects_told(const mt_manifold_report *report, mt_defect_kind kind);

/* How that is mended, in the imperative. */
const char *cli_defect_cure(const mt_manifold_report *report, mt_defect_kind kind);

/* Whether the kind alone makes a mesh non-manifold. */
bool cli_defect_breaks(mt_defect_kind kind);

bool cli_defect_is_of_edges(mt_defect_kind kind);
bool cli_defect_is_of_pairs(mt_defect_kind kind); /* of faces */
bool cli_defect_is_of_components(mt_defect_kind kind);
bool cli_defect_is_of_faces(mt_defect_kind kind);

#endif
