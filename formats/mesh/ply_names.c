#include "formats/mesh/ply_names.h"

static const ply_group groups[] = {
    {MT_SEMANTIC_NORMAL, 3, 3, false, {"nx", "ny", "nz", NULL}},
    {MT_SEMANTIC_COLOR, 3, 4, true, {"red", "green", "blue", "alpha"}},
    {MT_SEMANTIC_COLOR, 3, 4, true, {"diffuse_red", "diffuse_green", "diffuse_blue", "diffuse_alpha"}},
    {MT_SEMANTIC_COLOR, 3, 4, true, {"r", "g", "b", "a"}},
    {MT_SEMANTIC_UV, 2, 2, false, {"s", "t", NULL, NULL}},
    {MT_SEMANTIC_UV, 2, 3, false, {"u", "v", "w", NULL}},
    {MT_SEMANTIC_UV, 2, 2, false, {"texture_u", "texture_v", NULL, NULL}},
};

const ply_group *mt_ply_groups(uint32_t *count)
{
    *count = sizeof groups / sizeof *groups;
    return groups;
}
