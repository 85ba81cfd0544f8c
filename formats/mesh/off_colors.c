/* Colours of OFF files, which come in one to four components, whole numbers to 255 or fractions, element by element. */
#include "formats/mesh/off_parts.h"

#include <math.h>

enum { KIND_NONE, KIND_FRACTION, KIND_WHOLE, KIND_EITHER };

static bool grow(mt_context *context, mt_off_colors *colors)
{
    uint64_t capacity = colors->capacity ? 2 * colors->capacity : 256;
    double *values = mt_try_allocate(context, capacity * 4 * sizeof *values);
    uint8_t *kinds = mt_try_allocate(context, capacity);
    if (!values || !kinds) {
        mt_free(context, values);
        mt_free(context, kinds);
        return false;
    }
    if (colors->count > 0) {
        memcpy(values, colors->values, colors->count * 4 * sizeof *values);
        memcpy(kinds, colors->kinds, colors->count);
    }
    mt_free(context, colors->values);
    mt_free(context, colors->kinds);
    colors->values = values;
    colors->kinds = kinds;
    colors->capacity = capacity;
    return true;
}

bool mt_off_add_color(mt_context *context, mt_off_colors *colors, uint64_t element, const double *components,
                      unsigned count, bool whole)
{
    colors->first = colors->count == 0 ? element : colors->first;
    if (colors->count == colors->capacity && !grow(context, colors)) {
        return false;
    }
    double *value = colors->values + 4 * colors->count;
    bool above_one = false;
    for (unsigned i = 0; i < 4; i++) {
        value[i] = i < count ? components[i] : NAN;
        above_one = above_one || (i < count && components[i] > 1.0);
    }
    int kind = !whole ? KIND_FRACTION : above_one ? KIND_WHOLE : KIND_EITHER;
    colors->kinds[colors->count++] = (uint8_t)(count == 0 ? KIND_NONE : kind + 8 * (int)count);
    return true;
}

void mt_off_release_colors(mt_context *context, mt_off_colors *colors)
{
    mt_free(context, colors->values);
    mt_free(context, colors->kinds);
    *colors = (mt_off_colors){0};
}

typedef struct color_survey {
    uint64_t fractions, wholes, colored;
    bool has_alpha, has_hue;
} color_survey;

static color_survey survey_colors(const mt_off_colors *parts, uint64_t part_count)
{
    color_survey survey = {0};
    for (uint64_t part = 0; part < part_count; part++) {
        for (uint64_t i = 0; i < parts[part].count; i++) {
            int kind = parts[part].kinds[i] % 8, components = parts[part].kinds[i] / 8;
            survey.colored += kind != KIND_NONE;
            survey.fractions += kind == KIND_FRACTION;
            survey.wholes += kind == KIND_WHOLE;
            survey.has_alpha |= components == 2 || components == 4;
            survey.has_hue |= components >= 3;
        }
    }
    return survey;
}

/* One element's colour, in the components of the attribute, as the attribute stores it. */
static void store_color(mt_attribute *attribute, mt_index element, const double *value, int kind, int components)
{
    double maximum = mt_color_maximum(attribute->type);
    bool divide = kind == KIND_WHOLE && attribute->type != MT_U8;
    for (uint32_t i = 0; i < attribute->component_count; i++) {
        bool alpha = attribute->component_count % 2 == 0 && i + 1 == attribute->component_count;
        int from = alpha ? components - 1 : components <= 2 ? 0 : (int)i;
        bool given = kind != KIND_NONE && !(alpha && components % 2 == 1);
        double number = given ? value[from] : maximum;
        mt_attribute_set(attribute, element, i, given && divide ? number / 255.0 : number);
    }
}

static void fill_white(mt_attribute *attribute)
{
    for (mt_index i = 0; i < attribute->value_count; i++) {
        store_color(attribute, i, NULL, KIND_NONE, 0);
    }
}

mt_status mt_off_finish_colors(mt_context *context, mt_off_colors *parts, uint64_t part_count, const char *name,
                               mt_mesh *mesh, mt_domain domain)
{
    color_survey survey = survey_colors(parts, part_count);
    mt_index count = mt_mesh_domain_count(mesh, domain);
    mt_attribute *attribute = NULL;
    mt_status status = MT_OK;
    bool whole = survey.fractions == 0 && survey.wholes > 0;
    mt_attribute_layout layout = {.semantic = MT_SEMANTIC_COLOR,
                                  .domain = domain,
                                  .type = whole ? MT_U8 : MT_F64,
                                  .component_count = (survey.has_hue ? 3u : 1u) + survey.has_alpha,
                                  .value_count = count};
    if (survey.colored > 0) {
        status = mt_mesh_add_attribute(context, mesh, &layout, &attribute);
    }
    if (attribute && survey.colored < count) {
        mt_warn(context, "%s: %llu of %lu %s have no color though others do; they become white", name,
                (unsigned long long)(count - survey.colored), (unsigned long)count,
                domain == MT_DOMAIN_FACE ? "faces" : "vertices");
        fill_white(attribute);
    }
    for (uint64_t part = 0; part < part_count; part++) {
        const mt_off_colors *own = &parts[part];
        for (uint64_t i = 0; attribute && i < own->count; i++) {
            store_color(attribute, (mt_index)(own->first + i), own->values + 4 * i, own->kinds[i] % 8,
                        own->kinds[i] / 8);
        }
        mt_off_release_colors(context, &parts[part]);
    }
    return status;
}
