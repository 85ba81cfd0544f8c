// The half of the shim over Draco that encodes.
#ifdef MESHTOOL_DRACO

#include "formats/codec/draco_inside.hpp"

#include <draco/compression/expert_encode.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>

namespace
{

using namespace mt_draco_inside;

draco::DataType type_to(mt_type type)
{
    static const draco::DataType types[] = {draco::DT_UINT8,  draco::DT_INT8,  draco::DT_UINT16,  draco::DT_INT16,
                                            draco::DT_UINT32, draco::DT_INT32, draco::DT_FLOAT32, draco::DT_FLOAT64};
    return types[type];
}

void add_attributes(const mt_draco_source *source, draco::PointCloud *cloud)
{
    // Draco has no buffer behind an attribute of no values; no points need no attributes.
    for (size_t i = 0; i < source->attribute_count && source->vertex_count > 0; i++) {
        const mt_draco_attribute *from = &source->attributes[i];
        size_t size = from->component_count * mt_type_size(from->type);
        draco::GeometryAttribute attribute;
        attribute.Init(kind_to(from->kind), nullptr, static_cast<uint8_t>(from->component_count), type_to(from->type),
                       from->normalized, static_cast<int64_t>(size), 0);
        int id = cloud->AddAttribute(attribute, true, source->vertex_count);
        cloud->attribute(id)->buffer()->Write(0, from->values, size * source->vertex_count);
    }
}

// Whether Draco's quantising of the values is defined: it divides by their largest extent, as a float.
bool can_quantise(const mt_draco_attribute *attribute, size_t value_count)
{
    const float *values = static_cast<const float *>(attribute->values);
    float range = 0.0F;
    for (size_t k = 0; k < attribute->component_count; k++) {
        float least = value_count > 0 ? values[k] : 0.0F, most = least;
        for (size_t i = 1; i < value_count; i++) {
            float value = values[i * attribute->component_count + k];
            least = std::min(least, value);
            most = std::max(most, value);
        }
        range = std::max(range, most - least);
    }
    float steps = static_cast<float>((uint32_t{1} << attribute->bits) - 1);
    return std::isfinite(range) && (range == 0.0F || std::isfinite(steps / range));
}

bool is_quantised(const mt_draco_source *source, const mt_draco_attribute *attribute)
{
    return attribute->type == MT_F32 && attribute->bits > 0 && can_quantise(attribute, source->vertex_count);
}

// One more than the largest symbol of values between these two, which may be differences of either sign.
uint64_t symbols_between(int64_t least, int64_t most)
{
    return 2 * static_cast<uint64_t>(most - least) + 2;
}

template <typename number> uint64_t count_symbols(const void *values, size_t count)
{
    const number *of = static_cast<const number *>(values);
    int64_t least = count > 0 ? of[0] : 0, most = least;
    for (size_t i = 1; i < count; i++) {
        least = std::min<int64_t>(least, of[i]);
        most = std::max<int64_t>(most, of[i]);
    }
    return symbols_between(least, most);
}

// Draco counts how often each symbol stands in an attribute, in a table from 0 to the largest.
uint64_t symbol_bound(const mt_draco_source *source, const mt_draco_attribute *attribute)
{
    size_t count = source->vertex_count * static_cast<size_t>(attribute->component_count);
    switch (attribute->type) {
    case MT_F32:
        return is_quantised(source, attribute) ? symbols_between(0, (int64_t{1} << attribute->bits) - 1) : 0;
    case MT_F64:
        return 0;
    case MT_U32:
        return count_symbols<uint32_t>(attribute->values, count);
    case MT_I32:
        return count_symbols<int32_t>(attribute->values, count);
    default:
        return symbols_between(0, UINT16_MAX);
    }
}

// Of the attribute that needs the most of them.
uint64_t symbol_bound(const mt_draco_source *source)
{
    uint64_t most = 0;
    for (size_t i = 0; i < source->attribute_count; i++) {
        most = std::max(most, symbol_bound(source, &source->attributes[i]));
    }
    return most;
}

// With more symbols than this the table would be larger than what it saves: whole bytes are written.
constexpr uint64_t most_symbols = uint64_t{1} << 24;

void set_options(const mt_draco_source *source, uint64_t symbols, draco::ExpertEncoder *encoder, bool points)
{
    encoder->SetUseBuiltInAttributeCompression(symbols <= most_symbols);
    int speed = static_cast<int>(source->speed);
    encoder->SetSpeedOptions(speed, speed);
    encoder->SetTrackEncodedProperties(true);
    encoder->SetEncodingMethod(points               ? static_cast<int>(draco::POINT_CLOUD_SEQUENTIAL_ENCODING)
                               : source->sequential ? static_cast<int>(draco::MESH_SEQUENTIAL_ENCODING)
                                                    : static_cast<int>(draco::MESH_EDGEBREAKER_ENCODING));
    for (size_t i = 0; i < source->attribute_count && source->vertex_count > 0; i++) {
        const mt_draco_attribute *attribute = &source->attributes[i];
        if (is_quantised(source, attribute)) {
            encoder->SetAttributeQuantization(static_cast<int>(i), static_cast<int>(attribute->bits));
        }
    }
}

mt_draco_result finish(draco::ExpertEncoder *encoder, mt_draco_allocate allocate, void *user, mt_draco_bytes *out,
                       char *message)
{
    draco::EncoderBuffer buffer;
    draco::Status status = encoder->EncodeToBuffer(&buffer);
    if (!status.ok()) {
        say(message, status.error_msg());
        return MT_DRACO_WRONG;
    }
    out->bytes = allocate(user, buffer.size());
    if (!out->bytes) {
        return MT_DRACO_REFUSED;
    }
    std::memcpy(out->bytes, buffer.data(), buffer.size());
    out->size = buffer.size();
    out->vertex_count = static_cast<mt_index>(encoder->num_encoded_points());
    out->triangle_count = static_cast<mt_index>(encoder->num_encoded_faces());
    return MT_DRACO_OK;
}

mt_draco_result encode(const mt_draco_source *source, uint64_t symbols, mt_draco_allocate allocate, void *user,
                       mt_draco_bytes *out, char *message)
{
    draco::Mesh mesh;
    bool points = !source->triangles;
    mesh.set_num_points(source->vertex_count);
    add_attributes(source, &mesh);
    mesh.SetNumFaces(points ? 0 : source->triangle_count);
    for (mt_index i = 0; !points && i < source->triangle_count; i++) {
        const mt_index *t = source->triangles + 3 * static_cast<size_t>(i);
        draco::Mesh::Face face = {{draco::PointIndex(t[0]), draco::PointIndex(t[1]), draco::PointIndex(t[2])}};
        mesh.SetFace(draco::FaceIndex(i), face);
    }
    const draco::PointCloud &cloud = mesh;
    draco::ExpertEncoder encoder = points ? draco::ExpertEncoder(cloud) : draco::ExpertEncoder(mesh);
    set_options(source, symbols, &encoder, points);
    return finish(&encoder, allocate, user, out, message);
}

} // namespace

extern "C" mt_draco_result mt_draco_encode(const mt_draco_source *source, mt_draco_hold hold,
                                           mt_draco_allocate allocate, void *user, mt_draco_bytes *out, char *message)
try {
    *out = mt_draco_bytes();
    uint64_t bytes =
        triangle_bytes * source->triangle_count + vertex_bytes * static_cast<uint64_t>(source->vertex_count);
    for (size_t i = 0; i < source->attribute_count; i++) {
        const mt_draco_attribute *attribute = &source->attributes[i];
        bytes +=
            (attribute->component_count * mt_type_size(attribute->type) + 16) * value_copies * source->vertex_count +
            source->triangle_count * seam_bytes;
    }
    uint64_t symbols = symbol_bound(source);
    bytes += sizeof(uint32_t) * std::min(symbols, most_symbols);
    return hold(user, bytes) ? encode(source, symbols, allocate, user, out, message) : MT_DRACO_REFUSED;
} catch (const std::bad_alloc &) {
    return MT_DRACO_NO_MEMORY;
} catch (...) {
    say(message, "Draco failed");
    return MT_DRACO_WRONG;
}

#endif
