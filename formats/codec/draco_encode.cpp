// The half of the shim over Draco that encodes.
#ifdef MESHTOOL_DRACO

#include "formats/codec/draco_inside.hpp"

#include <draco/compression/expert_encode.h>

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

void set_options(const mt_draco_source *source, draco::ExpertEncoder *encoder, bool points)
{
    int speed = static_cast<int>(source->speed);
    encoder->SetSpeedOptions(speed, speed);
    encoder->SetTrackEncodedProperties(true);
    encoder->SetEncodingMethod(points               ? static_cast<int>(draco::POINT_CLOUD_SEQUENTIAL_ENCODING)
                               : source->sequential ? static_cast<int>(draco::MESH_SEQUENTIAL_ENCODING)
                                                    : static_cast<int>(draco::MESH_EDGEBREAKER_ENCODING));
    for (size_t i = 0; i < source->attribute_count && source->vertex_count > 0; i++) {
        const mt_draco_attribute *attribute = &source->attributes[i];
        if (attribute->type == MT_F32 && attribute->bits > 0) {
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

mt_draco_result encode(const mt_draco_source *source, mt_draco_allocate allocate, void *user, mt_draco_bytes *out,
                       char *message)
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
    set_options(source, &encoder, points);
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
    return hold(user, bytes) ? encode(source, allocate, user, out, message) : MT_DRACO_REFUSED;
} catch (const std::bad_alloc &) {
    return MT_DRACO_NO_MEMORY;
} catch (...) {
    say(message, "Draco failed");
    return MT_DRACO_WRONG;
}

#endif
