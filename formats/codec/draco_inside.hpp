// What the two halves of the shim over Draco share.
#ifndef MESHTOOL_CODEC_DRACO_INSIDE_HPP
#define MESHTOOL_CODEC_DRACO_INSIDE_HPP

#include "formats/codec/draco.h"

#include <draco/attributes/geometry_attribute.h>

#include <cstdio>

namespace mt_draco_inside
{

// Bytes that Draco 1.5 holds for each triangle and vertex while it decodes or encodes, rounded up; for each set of
// attributes with seams of their own; and for each byte of a value: stored, as portable integers, and predicted.
constexpr uint64_t triangle_bytes = 160, vertex_bytes = 96, seam_bytes = 64, value_copies = 8;

inline draco::GeometryAttribute::Type kind_to(mt_draco_kind kind)
{
    static const draco::GeometryAttribute::Type kinds[] = {
        draco::GeometryAttribute::POSITION, draco::GeometryAttribute::NORMAL, draco::GeometryAttribute::COLOR,
        draco::GeometryAttribute::TEX_COORD, draco::GeometryAttribute::GENERIC};
    return kinds[kind];
}

inline void say(char *message, const char *text)
{
    std::snprintf(message, MT_DRACO_MESSAGE, "%s", text);
    for (char *c = message; *c; c++) {
        *c = *c >= ' ' && *c < 127 ? *c : ' ';
    }
}

} // namespace mt_draco_inside

#endif
