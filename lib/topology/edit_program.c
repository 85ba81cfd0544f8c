/* One attribute through the steps. Every value is known by a number: that of the source's value while it is copied, and
 * value_count + k once step k has mixed it; so what was shared by an index stays shared. Cost: O(steps) time, 4 bytes
 * and the mixed components as doubles a step. */
#include "lib/topology/edit_program.h"

#include <math.h>
#include <string.h>

/* The last mixtures, so that corners which take the same one share it. */
#define MEMORY 8
typedef struct mixture {
    mt_index a, b, result;
    double weight;
} mixture;

typedef struct runner {
    const mt_edit_program *program;
    const mt_attribute *source;
    mt_interpolation interpolation;
    mt_index *results; /* per step its value */
    double *values;    /* per step what it mixed */
    mixture memory[MEMORY];
} runner;

static mt_index value_of(const runner *at, mt_index slot)
{
    if (slot == MT_NONE) {
        return MT_NONE;
    }
    return slot < at->program->element_count ? mt_attribute_value_index(at->source, slot)
                                             : at->results[slot - at->program->element_count];
}

static double component(const runner *at, mt_index value, uint32_t which)
{
    return value < at->source->value_count
               ? mt_attribute_get(at->source, value, which)
               : at->values[(size_t)(value - at->source->value_count) * at->source->component_count + which];
}

static void make_unit(uint32_t component_count, double *value)
{
    double sum = 0;
    for (uint32_t i = 0; i < component_count; i++) {
        sum += value[i] * value[i];
    }
    double length = sqrt(sum);
    for (uint32_t i = 0; i < component_count && length > 0; i++) {
        value[i] /= length;
    }
}

static void compute(runner *at, mt_index step, mt_index a, mt_index b, double weight)
{
    uint32_t component_count = at->source->component_count;
    double *result = at->values + (size_t)step * component_count;
    for (uint32_t i = 0; i < component_count; i++) {
        result[i] = (1 - weight) * component(at, a, i) + weight * component(at, b, i);
    }
    if (at->interpolation == MT_INTERPOLATE_UNIT) {
        make_unit(component_count, result);
    }
}

static mt_index mix(runner *at, mt_index step, mt_index a, mt_index b, double weight)
{
    bool copies = at->interpolation == MT_INTERPOLATE_NONE || a == MT_NONE || b == MT_NONE;
    if (copies || a == b || weight <= 0 || weight >= 1) {
        return weight > 0.5 ? b : a;
    }
    for (int i = 0; i < MEMORY; i++) {
        const mixture *last = &at->memory[i];
        if (last->a == a && last->b == b && last->weight == weight && last->result != MT_NONE) {
            return last->result;
        }
    }
    compute(at, step, a, b, weight);
    mt_index result = at->source->value_count + step;
    at->memory[step % MEMORY] = (mixture){a, b, result, weight};
    return result;
}

static bool are_equal(const runner *at, mt_index a, mt_index b)
{
    bool equal = a == b || (a != MT_NONE && b != MT_NONE);
    for (uint32_t i = 0; a != b && equal && i < at->source->component_count; i++) {
        equal = component(at, a, i) == component(at, b, i);
    }
    return equal;
}

static mt_index run_step(runner *at, mt_index which)
{
    const mt_edit_step *step = &at->program->steps[which];
    if (!step->is_wedge) {
        return mix(at, which, value_of(at, step->kept[0]), value_of(at, step->gone[0]), step->weight);
    }
    mt_index own = value_of(at, step->own);
    for (int i = 0; i < 2; i++) {
        if (step->end[i] != MT_NONE && are_equal(at, own, value_of(at, step->end[i]))) {
            return mix(at, which, value_of(at, step->kept[i]), value_of(at, step->gone[i]), step->weight);
        }
    }
    return own;
}

static void store_plain(const runner *at, mt_index value, mt_attribute *target, mt_index element)
{
    size_t size = at->source->component_count * mt_type_size(at->source->type);
    if (value < at->source->value_count) {
        memcpy((char *)target->values + element * size, (const char *)at->source->values + value * size, size);
    } else if (value != MT_NONE) {
        for (uint32_t i = 0; i < at->source->component_count; i++) {
            mt_attribute_set(target, element, i, component(at, value, i));
        }
    }
}

/* Numbers the mixed values in use after those of the source, and makes room for them. */
static mt_status extend(mt_context *context, const runner *at, const mt_index *slots, const mt_index *sources,
                        mt_index count, mt_index *numbers, mt_attribute *target)
{
    uint64_t value_count = at->source->value_count;
    memset(numbers, 0xff, at->program->step_count * sizeof *numbers);
    for (mt_index i = 0; i < count; i++) {
        mt_index value = sources[i] == MT_NONE ? value_of(at, slots[i]) : MT_NONE;
        if (value != MT_NONE && value >= at->source->value_count) {
            mt_index *number = &numbers[value - at->source->value_count];
            *number = *number == MT_NONE ? (mt_index)value_count++ : *number;
        }
    }
    if (value_count > MT_INDEX_MAX) {
        return mt_fail(context, MT_ERROR_TOO_LARGE, "surgery makes more values than an index can number");
    }
    size_t size = target->component_count * mt_type_size(target->type);
    void *values = mt_reallocate(context, target->values, value_count * size);
    if (!values) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    target->values = values;
    target->value_count = (mt_index)value_count;
    return MT_OK;
}

static mt_status store_indexed(mt_context *context, const runner *at, const mt_index *slots, const mt_index *sources,
                               mt_index count, mt_attribute *target)
{
    mt_index *numbers = mt_allocate_array(context, at->program->step_count, sizeof *numbers);
    mt_status status = numbers ? extend(context, at, slots, sources, count, numbers, target) : MT_ERROR_OUT_OF_MEMORY;
    for (mt_index i = 0; status == MT_OK && i < count; i++) {
        if (sources[i] == MT_NONE) {
            mt_index value = value_of(at, slots[i]);
            bool is_mixed = value != MT_NONE && value >= at->source->value_count;
            target->indices[i] = is_mixed ? numbers[value - at->source->value_count] : value;
            if (is_mixed) {
                store_plain(at, value, target, target->indices[i]);
            }
        }
    }
    mt_free(context, numbers);
    return status;
}

mt_status mt_edit_program_run(mt_context *context, const mt_edit_program *program, const mt_attribute *source,
                              const mt_index *slots, const mt_index *sources, mt_index count, mt_attribute *target)
{
    if ((uint64_t)source->value_count + program->step_count > MT_INDEX_MAX) {
        return mt_fail(context, MT_ERROR_TOO_LARGE, "surgery makes more values than an index can number");
    }
    runner at = {program, source, mt_semantic_interpolation(source->semantic, source->type), NULL, NULL, {{0}}};
    memset(at.memory, 0xff, sizeof at.memory);
    at.results = mt_allocate_array(context, program->step_count, sizeof *at.results);
    at.values = mt_allocate_array(context, (uint64_t)program->step_count * source->component_count, sizeof *at.values);
    mt_status status = at.results && at.values ? MT_OK : mt_context_error(context)->status;
    if (status == MT_OK) {
        for (mt_index i = 0; i < program->step_count; i++) {
            at.results[i] = run_step(&at, i);
        }
        if (target->indices) {
            status = store_indexed(context, &at, slots, sources, count, target);
        } else {
            for (mt_index i = 0; i < count; i++) {
                if (sources[i] == MT_NONE) {
                    store_plain(&at, value_of(&at, slots[i]), target, i);
                }
            }
        }
    }
    mt_free(context, at.results);
    mt_free(context, at.values);
    return status;
}
