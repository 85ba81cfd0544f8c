/* Strips in four steps: what lies across each side, a cover of the triangles by runs, cuts where fans are asked for,
 * and the runs written out. */
#include <meshtool/strips.h>

#include "lib/algorithms/strips_graph.h"
#include "lib/algorithms/strips_list.h"

#include <string.h>

/* A run costs its first two indices and a restart. In a fan a turn to the other side ends it. */
static const strip_prices strip_costs = {.run = 3, .equal = 1, .alternate = 0};
static const strip_prices fan_costs = {.run = 3, .equal = 0, .alternate = 3};

/* Writes out a cover, which it may cut. */
static mt_status list_cover(mt_context *context, const strip_graph *graph, const mt_strip_options *options,
                            uint8_t *links, mt_strips **out)
{
    bool with_fans = options->kind != MT_STRIP_KIND_STRIP;
    uint8_t *is_fan = with_fans ? mt_allocate(context, graph->triangle_count) : NULL;
    mt_strips *strips = mt_allocate_zeroed(context, sizeof *strips);
    mt_status status = strips && (is_fan || !with_fans) ? MT_OK : mt_context_error(context)->status;
    if (status == MT_OK && with_fans) {
        status = mt_strip_cut_fans(context, graph, options->kind == MT_STRIP_KIND_MIXED, links, is_fan);
    }
    if (status == MT_OK) {
        strips->join = options->join;
        status = mt_strip_list(context, graph, links, is_fan, strips);
    }
    mt_free(context, is_fan);
    if (status != MT_OK) {
        mt_strips_destroy(context, strips);
        strips = NULL;
    }
    *out = strips;
    return status;
}

/* The search does not count all that the list does, and so may end a little above where it began: the shorter stays. */
static mt_status search(mt_context *context, const strip_graph *graph, const mt_strip_options *options,
                        const strip_prices *prices, uint8_t *links, mt_strips **strips)
{
    mt_strips *longer = NULL;
    mt_status status = mt_strip_cover_anneal(context, graph, prices, links);
    if (status == MT_OK) {
        status = list_cover(context, graph, options, links, &longer);
    }
    if (status == MT_OK && mt_strips_index_count(longer) < mt_strips_index_count(*strips)) {
        mt_strips *shorter = longer;
        longer = *strips;
        *strips = shorter;
    }
    mt_strips_destroy(context, longer);
    return status;
}

static mt_status cover_and_list(mt_context *context, const strip_graph *graph, const mt_strip_options *options,
                                mt_strips **out)
{
    const strip_prices *prices = options->kind == MT_STRIP_KIND_FAN ? &fan_costs : &strip_costs;
    uint8_t *links = mt_allocate_zeroed(context, graph->triangle_count);
    uint8_t *searched = options->thorough ? mt_allocate(context, graph->triangle_count) : NULL;
    bool allocated = links && (searched || !options->thorough);
    mt_status status =
        allocated ? mt_strip_cover_greedily(context, graph, prices, links) : mt_context_error(context)->status;
    if (status == MT_OK && searched) {
        memcpy(searched, links, graph->triangle_count);
    }
    if (status == MT_OK) {
        status = list_cover(context, graph, options, links, out);
    }
    if (status == MT_OK && searched) {
        status = search(context, graph, options, prices, searched, out);
    }
    mt_free(context, links);
    mt_free(context, searched);
    return status;
}

mt_status mt_strips_create(mt_context *context, const mt_mesh *mesh, const mt_strip_options *options, mt_strips **out)
{
    static const mt_strip_options defaults = {0};
    options = options ? options : &defaults;
    *out = NULL;
    if (options->kind != MT_STRIP_KIND_STRIP && options->join == MT_STRIP_JOIN_DEGENERATE) {
        return mt_fail(context, MT_ERROR_ARGUMENT,
                       "fans cannot be joined by degenerate triangles; use a restart index, or strips alone");
    }
    strip_graph graph;
    mt_status status = mt_strip_graph_init(context, mesh, &graph);
    if (status != MT_OK) {
        return status;
    }
    mt_strips *strips = NULL;
    status = cover_and_list(context, &graph, options, &strips);
    mt_strip_graph_release(context, &graph);
    if (status != MT_OK) {
        mt_strips_destroy(context, strips);
        return status;
    }
    *out = strips;
    return MT_OK;
}

void mt_strips_destroy(mt_context *context, mt_strips *strips)
{
    if (strips) {
        mt_free(context, strips->offsets);
        mt_free(context, strips->indices);
        mt_free(context, strips->faces);
        mt_free(context, strips->face_runs);
        mt_free(context, strips);
    }
}
