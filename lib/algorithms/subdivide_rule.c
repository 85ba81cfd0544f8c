#include "lib/algorithms/subdivide_rule.h"

mt_subdivide_vertex_rule mt_vertex_rule_of(float vertex_sharpness, mt_index sharp_edge_count)
{
    if (vertex_sharpness > 0 || sharp_edge_count > 2) {
        return MT_VERTEX_CORNER;
    }
    return (mt_subdivide_vertex_rule)sharp_edge_count;
}

float mt_sharpness_next(float sharpness)
{
    if (sharpness >= MT_SHARPNESS_INFINITE) {
        return sharpness;
    }
    return sharpness > 1 ? sharpness - 1 : 0;
}

void mt_sharpness_sum_add(mt_sharpness_sum *sum, float sharpness)
{
    if (sharpness > 0 && sharpness < MT_SHARPNESS_INFINITE) {
        sum->sum += (double)sharpness;
        sum->count++;
    }
}

float mt_sharpness_next_at(float sharpness, bool chaikin, const mt_sharpness_sum *around)
{
    if (!chaikin || around->count < 2 || !(sharpness > 0) || sharpness >= MT_SHARPNESS_INFINITE) {
        return mt_sharpness_next(sharpness);
    }
    float mean_of_others = ((float)around->sum - sharpness) / (float)(around->count - 1);
    float child = (0.75f * sharpness + 0.25f * mean_of_others) - 1;
    return child > 0 ? child : 0;
}

/* With Chaikin's rule more than 1 may decay at once, and less than 1 may stay sharp. */
void mt_sharpness_decay_add(mt_sharpness_sum *decay, float parent, float child, bool chaikin)
{
    if (parent > 0 && (chaikin ? !(child > 0) : parent <= 1)) {
        decay->sum += (double)parent;
        decay->count++;
    }
}

float mt_sharpness_decay_weight(const mt_sharpness_sum *decay)
{
    if (decay->count == 0) {
        return 0;
    }
    float weight = (float)decay->sum / (float)decay->count;
    return weight > 1 ? 1 : weight;
}
