/* check-manifold's verdict: one sentence that stands alone. */
#include "check.h"
#include "check_words.h"
#include "line.h"
#include "quantity.h"

/* "not manifold: 2 edges have three faces or more and 1 vertex joins separate surfaces" */
static void add_non_manifold(cli_line *line, const mt_manifold_report *report)
{
    size_t count = 0, index = 0;
    for (mt_defect_kind kind = 0; kind < MT_DEFECT_KIND_COUNT; kind++) {
        count += cli_defect_breaks(kind) && report->defect_counts[kind];
    }
    cli_line_add(line, "not manifold: ");
    for (mt_defect_kind kind = 0; kind < MT_DEFECT_KIND_COUNT; kind++) {
        if (cli_defect_breaks(kind) && report->defect_counts[kind]) {
            cli_line_add_item(line, index++, count, cli_defects_told(report, kind).text);
        }
    }
}

static void add_orientation(cli_line *line, const mt_manifold_report *report)
{
    if (report->orientable == MT_NO) {
        cli_line_add(line, ", one-sided as a Moebius strip, so that no orientation fits");
    } else if (report->oriented == MT_NO) {
        cli_line_add(line, ", but its faces are not all turned the same way");
    } else {
        cli_line_add(line, ", consistently oriented");
    }
}

static void add_class(cli_line *line, const mt_manifold_report *report)
{
    if (report->face_count == 0) {
        cli_line_add(line, "it has no faces, so there is nothing to find fault with");
    } else if (report->manifold_class == MT_NON_MANIFOLD) {
        add_non_manifold(line, report);
    } else {
        if (report->manifold_class == MT_MANIFOLD) {
            cli_line_add(line, "manifold and closed");
        } else {
            cli_line_add(line, "manifold with boundary (%s)",
                         cli_counted(report->boundary_loop_count, "boundary loop").text);
        }
        add_orientation(line, report);
    }
}

/* What neither the class nor the orientation tells. */
static void add_others(cli_line *line, const mt_manifold_report *report)
{
    static const mt_defect_kind others[] = {MT_DEFECT_NON_FINITE_VERTEX,    MT_DEFECT_DUPLICATE_FACE,
                                            MT_DEFECT_INSIDE_OUT_COMPONENT, MT_DEFECT_ZERO_AREA_FACE,
                                            MT_DEFECT_SELF_INTERSECTION,    MT_DEFECT_ISOLATED_VERTEX};
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++) {
        if (report->defect_counts[others[i]]) {
            cli_line_add(line, "; %s", cli_defects_told(report, others[i]).text);
        }
    }
    if (report->has_self_intersections && report->defect_counts[MT_DEFECT_SELF_INTERSECTION] == 0) {
        cli_line_add(line, "; no faces intersect");
    }
}

/* "not closed and not oriented: " */
static void add_failures(cli_line *line, const cli_check *check)
{
    const char *const failures[] = {check->fails_closed ? "not closed" : NULL,
                                    check->fails_oriented ? "not oriented" : NULL,
                                    check->fails_apart ? "not free of self-intersections" : NULL};
    size_t count = 0, index = 0;
    for (int i = 0; i < 3; i++) {
        count += failures[i] != NULL;
    }
    for (int i = 0; i < 3; i++) {
        if (failures[i]) {
            cli_line_add_item(line, index++, count, failures[i]);
        }
    }
    cli_line_add(line, count ? ": " : "");
}

void cli_check_print_verdict(const cli_check *check)
{
    cli_line line = {0};
    cli_line_add(&line, "%s: ", check->file);
    add_failures(&line, check);
    add_class(&line, check->report);
    add_others(&line, check->report);
    printf("%s.\n", line.text);
}
