#include "tradeoff/unit.h"

#include <stdio.h>
#include <string.h>

static const tradeoff_unit units[] = {
    {"normal_p50, normal_p99, normal_max", "how far a vertex normal is off", "degrees"},
    {"refined", "how far a refined vertex is off, at most", "diagonals"},
    {"bounds", "how far a side of the box is off, at most", "diagonals"},
    {"wrong, wrong_pairs, wrong_faces, wrong_volumes", "verdicts that are wrong", "count"},
    {"missed_at_vertices, missed_at_edges", "rays that slip through there", "of a million"},
    {"wrong_per_million", "rays that meet another surface", "of a million"},
    {"t_p50, t_p99, t_max", "how far a hit's distance is off", "as a share of it"},
    {"wrong_rays", "rays that meet another surface", "count"},
    {"differing_rays", "rays whose hits differ from brute force", "count"},
    {"wrong_pixels", "pixels that show a wrong face", "count"},
    {"differing_pixels", "pixels in which the methods differ", "count"},
    {"rmse", "root mean square error of a pixel", "1: full brightness"},
    {"dssim", "structural difference of the pictures", "0: alike, 1: opposite"},
    {"lost_faces", "faces that fall between the samples", "count"},
    {"hausdorff", "distance from the limit surface, at most", "diagonals"},
    {"rms", "distance from the limit surface, root mean square", "diagonals"},
    {"normal_degrees", "how far a face normal is off, on average", "degrees"},
    {"degrees_p50, degrees_p99, degrees_max", "how far a vertex normal is off", "degrees"},
    {"largest_off, mean_off", "how far the distance is off", "diagonals"},
    {"displacement", "how far a vertex moves, at most", "diagonals"},
    {"moved_max, moved_rms", "how far a vertex moves", "diagonals"},
    {"flipped_faces", "faces that turn over", "count"},
    {"collapsed_faces", "faces whose area is gone", "count"},
    {"wrong_triangles", "triangles drawn too often or not at all", "count"},
    {"indices_per_triangle", "indices of a triangle", "3: without strips"},
};

static bool names(const tradeoff_unit *unit, const char *figure)
{
    size_t length = strlen(figure);
    const char *at = unit->figures;
    while (at && (strncmp(at, figure, length) != 0 || (at[length] != ',' && at[length] != '\0'))) {
        at = strstr(at, ", ");
        at = at ? at + 2 : NULL;
    }
    return at != NULL;
}

const tradeoff_unit *tradeoff_unit_of(const char *figure)
{
    for (size_t i = 0; i < sizeof units / sizeof *units; i++) {
        if (names(&units[i], figure)) {
            return &units[i];
        }
    }
    return NULL;
}

void tradeoff_print_units(const tradeoff_table *table)
{
    bool told[sizeof units / sizeof *units] = {false};
    for (size_t i = 0; i < table->row_count; i++) {
        for (size_t j = 0; j < table->rows[i].figure_count; j++) {
            const tradeoff_figure *figure = &table->rows[i].figures[j];
            const tradeoff_unit *unit = figure->is_error ? tradeoff_unit_of(figure->name) : NULL;
            if (unit && !told[unit - units]) {
                printf("  %s: %s; %s\n", unit->figures, unit->meaning, unit->unit);
                told[unit - units] = true;
            }
        }
    }
}
