#include <meshtool/attribute.h>

#include <math.h>

mt_interpolation mt_semantic_interpolation(mt_semantic semantic, mt_type type)
{
    static const mt_interpolation table[] = {
        [MT_SEMANTIC_GENERIC] = MT_INTERPOLATE_LINEAR,
        [MT_SEMANTIC_NORMAL] = MT_INTERPOLATE_UNIT,
        [MT_SEMANTIC_UV] = MT_INTERPOLATE_LINEAR,
        [MT_SEMANTIC_COLOR] = MT_INTERPOLATE_LINEAR,
    };
    bool is_integer = type != MT_F32 && type != MT_F64;
    return semantic == MT_SEMANTIC_GENERIC && is_integer ? MT_INTERPOLATE_NONE : table[semantic];
}

double mt_attribute_get(const mt_attribute *attribute, mt_index value, uint32_t component)
{
    size_t at = (size_t)value * attribute->component_count + component;
    switch (attribute->type) {
    case MT_U8:
        return ((const uint8_t *)attribute->values)[at];
    case MT_I8:
        return ((const int8_t *)attribute->values)[at];
    case MT_U16:
        return ((const uint16_t *)attribute->values)[at];
    case MT_I16:
        return ((const int16_t *)attribute->values)[at];
    case MT_U32:
        return ((const uint32_t *)attribute->values)[at];
    case MT_I32:
        return ((const int32_t *)attribute->values)[at];
    case MT_F32:
        return (double)((const float *)attribute->values)[at];
    case MT_F64:
        break;
    }
    return ((const double *)attribute->values)[at];
}

static const double integer_minimum[] = {0, -128, 0, -32768, 0, -2147483648.0};
static const double integer_maximum[] = {255, 127, 65535, 32767, 4294967295.0, 2147483647.0};

static double to_integer(mt_type type, double number)
{
    if (isnan(number)) {
        return 0;
    }
    double rounded = nearbyint(number);
    if (rounded < integer_minimum[type]) {
        return integer_minimum[type];
    }
    return rounded > integer_maximum[type] ? integer_maximum[type] : rounded;
}

void mt_attribute_set(mt_attribute *attribute, mt_index value, uint32_t component, double number)
{
    size_t at = (size_t)value * attribute->component_count + component;
    switch (attribute->type) {
    case MT_U8:
        ((uint8_t *)attribute->values)[at] = (uint8_t)to_integer(MT_U8, number);
        break;
    case MT_I8:
        ((int8_t *)attribute->values)[at] = (int8_t)to_integer(MT_I8, number);
        break;
    case MT_U16:
        ((uint16_t *)attribute->values)[at] = (uint16_t)to_integer(MT_U16, number);
        break;
    case MT_I16:
        ((int16_t *)attribute->values)[at] = (int16_t)to_integer(MT_I16, number);
        break;
    case MT_U32:
        ((uint32_t *)attribute->values)[at] = (uint32_t)to_integer(MT_U32, number);
        break;
    case MT_I32:
        ((int32_t *)attribute->values)[at] = (int32_t)to_integer(MT_I32, number);
        break;
    case MT_F32:
        ((float *)attribute->values)[at] = (float)number;
        break;
    case MT_F64:
        ((double *)attribute->values)[at] = number;
        break;
    }
}

double mt_color_maximum(mt_type type)
{
    return type == MT_F32 || type == MT_F64 ? 1.0 : integer_maximum[type];
}
