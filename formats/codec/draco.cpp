// The shim over Draco. Its decoders are derived from, so that the counts that a stream declares are seen after its
// header was read and before anything is allocated by them.
#ifdef MESHTOOL_DRACO

#include "formats/codec/draco_inside.hpp"

#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/compression/point_cloud/point_cloud_kd_tree_decoder.h>
#include <draco/compression/point_cloud/point_cloud_sequential_decoder.h>

#include <cstdio>
#include <cstring>
#include <memory>
#include <new>
#include <type_traits>

namespace
{

using namespace mt_draco_inside;

// Connectivity of a regular mesh, and what lies flat on it, take next to nothing; a stream may say this much more.
constexpr uint64_t elements_per_byte = 128, elements_free = 8192;

struct guard {
    mt_draco_hold hold;
    void *user;
    size_t size; // of the stream
    mt_draco_result result;

    bool take(uint64_t bytes)
    {
        if (result == MT_DRACO_OK && !hold(user, bytes)) {
            result = MT_DRACO_REFUSED;
        }
        return result == MT_DRACO_OK;
    }

    bool justify(uint64_t elements)
    {
        if (elements > elements_free && elements / elements_per_byte > size) {
            result = MT_DRACO_TOO_LARGE;
        }
        return result == MT_DRACO_OK;
    }
};

// Numbers of 7 bits a byte, the lowest first.
bool read_varint(draco::DecoderBuffer *buffer, uint32_t *number)
{
    uint64_t sum = 0;
    for (unsigned shift = 0; shift < 35; shift += 7) {
        uint8_t byte;
        if (!buffer->Decode(&byte)) {
            return false;
        }
        sum |= static_cast<uint64_t>(byte & 127) << shift;
        if (byte < 128) {
            *number = static_cast<uint32_t>(sum);
            return sum <= UINT32_MAX;
        }
    }
    return false;
}

// The values, once their headers were read.
bool check_values(guard *g, const draco::PointCloud *cloud)
{
    uint64_t bytes = 0, components = 0;
    for (int i = 0; i < cloud->num_attributes(); i++) {
        components += static_cast<uint64_t>(cloud->attribute(i)->num_components());
        bytes += static_cast<uint64_t>(cloud->attribute(i)->num_components()) * 4 + 16;
    }
    return g->justify(cloud->num_points()) && g->justify(cloud->num_points() * components / 4) &&
           g->take(cloud->num_points() * bytes * value_copies);
}

template <class Base> class bounded_mesh : public Base
{
  public:
    explicit bounded_mesh(guard *asked) : asked_(asked)
    {
    }

  protected:
    bool DecodeConnectivity() override
    {
        return check_counts() && Base::DecodeConnectivity();
    }

    bool DecodeAllAttributes() override
    {
        return check_values(asked_, this->point_cloud()) && Base::DecodeAllAttributes();
    }

  private:
    // Looks ahead with a copy of the buffer's place.
    bool check_counts()
    {
        draco::DecoderBuffer ahead(*this->buffer());
        uint32_t triangles = 0, vertices = 0;
        uint8_t traversal = 0, seams = 0;
        bool edgebreaker = std::is_base_of<draco::MeshEdgebreakerDecoder, Base>::value;
        if (edgebreaker ? !(ahead.Decode(&traversal) && read_varint(&ahead, &vertices) &&
                            read_varint(&ahead, &triangles) && ahead.Decode(&seams))
                        : !(read_varint(&ahead, &triangles) && read_varint(&ahead, &vertices))) {
            return false;
        }
        uint64_t elements = static_cast<uint64_t>(triangles) + vertices;
        return asked_->justify(elements) &&
               asked_->take(triangles * (triangle_bytes + seams * seam_bytes) + vertices * vertex_bytes);
    }

    guard *asked_;
};

template <class Base> class bounded_points : public Base
{
  public:
    explicit bounded_points(guard *asked) : asked_(asked)
    {
    }

  protected:
    bool DecodeGeometryData() override
    {
        int32_t count;
        draco::DecoderBuffer ahead(*this->buffer());
        return ahead.Decode(&count) && count >= 0 && asked_->justify(static_cast<uint64_t>(count)) &&
               asked_->take(static_cast<uint64_t>(count) * vertex_bytes) && Base::DecodeGeometryData();
    }

    bool DecodeAllAttributes() override
    {
        return check_values(asked_, this->point_cloud()) && Base::DecodeAllAttributes();
    }

  private:
    guard *asked_;
};

bool type_of(draco::DataType from, mt_type *to)
{
    switch (from) {
    case draco::DT_INT8:
        *to = MT_I8;
        return true;
    case draco::DT_UINT8:
    case draco::DT_BOOL:
        *to = MT_U8;
        return true;
    case draco::DT_INT16:
        *to = MT_I16;
        return true;
    case draco::DT_UINT16:
        *to = MT_U16;
        return true;
    case draco::DT_INT32:
        *to = MT_I32;
        return true;
    case draco::DT_UINT32:
        *to = MT_U32;
        return true;
    case draco::DT_FLOAT32:
        *to = MT_F32;
        return true;
    case draco::DT_FLOAT64:
        *to = MT_F64;
        return true;
    default:
        return false;
    }
}

mt_draco_kind kind_of(draco::GeometryAttribute::Type type)
{
    for (int kind = MT_DRACO_POSITION; kind < MT_DRACO_GENERIC; kind++) {
        if (kind_to(static_cast<mt_draco_kind>(kind)) == type) {
            return static_cast<mt_draco_kind>(kind);
        }
    }
    return MT_DRACO_GENERIC;
}

} // namespace

struct mt_draco_mesh {
    std::unique_ptr<draco::Mesh> mesh; // without faces for points
};

namespace
{

template <class Decoder, class Geometry> draco::Status run(draco::DecoderBuffer *buffer, guard *g, Geometry *out)
{
    draco::DecoderOptions options;
    Decoder decoder(g);
    return decoder.Decode(options, buffer, out);
}

draco::Status run_any(const draco::DracoHeader &header, draco::DecoderBuffer *buffer, guard *g, draco::Mesh *out)
{
    draco::PointCloud *points = out;
    if (header.encoder_type == draco::TRIANGULAR_MESH) {
        return header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING
                   ? run<bounded_mesh<draco::MeshEdgebreakerDecoder>>(buffer, g, out)
                   : run<bounded_mesh<draco::MeshSequentialDecoder>>(buffer, g, out);
    }
    return header.encoder_method == draco::POINT_CLOUD_KD_TREE_ENCODING
               ? run<bounded_points<draco::PointCloudKdTreeDecoder>>(buffer, g, points)
               : run<bounded_points<draco::PointCloudSequentialDecoder>>(buffer, g, points);
}

mt_draco_result check_header(const draco::DracoHeader &header, char *message)
{
    bool mesh = header.encoder_type == draco::TRIANGULAR_MESH;
    if (header.encoder_type > draco::TRIANGULAR_MESH || header.encoder_method > 1) {
        say(message, "its kind of geometry or method is not known");
        return MT_DRACO_VERSION;
    }
    if (header.version_major != 2 || header.version_minor < 2 || header.version_minor > (mesh ? 2 : 3)) {
        std::snprintf(message, MT_DRACO_MESSAGE, "version %u.%u of the bit stream is not read, expected 2.2",
                      static_cast<unsigned>(header.version_major), static_cast<unsigned>(header.version_minor));
        return MT_DRACO_VERSION;
    }
    return MT_DRACO_OK;
}

mt_draco_result decode(const void *bytes, size_t size, guard *g, mt_draco_mesh **out, size_t *consumed, char *message)
{
    draco::DecoderBuffer buffer, ahead;
    draco::DracoHeader header;
    buffer.Init(static_cast<const char *>(bytes), size);
    ahead.Init(static_cast<const char *>(bytes), size);
    if (size < 5 || std::memcmp(bytes, "DRACO", 5) != 0 ||
        !draco::PointCloudDecoder::DecodeHeader(&ahead, &header).ok()) {
        say(message, "there is no whole header");
        return MT_DRACO_WRONG;
    }
    mt_draco_result result = check_header(header, message);
    if (result != MT_DRACO_OK) {
        return result;
    }
    std::unique_ptr<mt_draco_mesh> holder(new mt_draco_mesh);
    holder->mesh.reset(new draco::Mesh);
    draco::Status status = run_any(header, &buffer, g, holder->mesh.get());
    if (g->result != MT_DRACO_OK) {
        say(message, "it says that it holds more than its bytes can");
        return g->result;
    }
    if (!status.ok()) {
        say(message, status.error_msg());
        return MT_DRACO_WRONG;
    }
    if (consumed) {
        // What is left, not what was decoded: the edgebreaker decoder starts the buffer anew behind the connectivity.
        *consumed = size - static_cast<size_t>(buffer.remaining_size());
    }
    *out = holder.release();
    return MT_DRACO_OK;
}

} // namespace

extern "C" mt_draco_result mt_draco_decode(const void *bytes, size_t size, mt_draco_hold hold, void *user,
                                           mt_draco_mesh **out, size_t *consumed, char *message)
try {
    guard g = {hold, user, size, MT_DRACO_OK};
    *out = nullptr;
    return decode(bytes, size, &g, out, consumed, message);
} catch (const std::bad_alloc &) {
    return MT_DRACO_NO_MEMORY;
} catch (...) {
    say(message, "Draco failed");
    return MT_DRACO_WRONG;
}

extern "C" void mt_draco_destroy(mt_draco_mesh *mesh)
{
    delete mesh;
}

extern "C" mt_index mt_draco_vertex_count(const mt_draco_mesh *mesh)
{
    return mesh->mesh->num_points();
}

extern "C" mt_index mt_draco_triangle_count(const mt_draco_mesh *mesh)
{
    return mesh->mesh->num_faces();
}

extern "C" size_t mt_draco_attribute_count(const mt_draco_mesh *mesh)
{
    return static_cast<size_t>(mesh->mesh->num_attributes());
}

extern "C" bool mt_draco_attribute_at(const mt_draco_mesh *mesh, size_t number, mt_draco_attribute *out)
{
    const draco::PointAttribute *attribute = mesh->mesh->attribute(static_cast<int>(number));
    *out = mt_draco_attribute();
    out->kind = kind_of(attribute->attribute_type());
    out->component_count = attribute->num_components();
    out->normalized = attribute->normalized();
    out->id = attribute->unique_id();
    return type_of(attribute->data_type(), &out->type);
}

extern "C" bool mt_draco_copy_values(const mt_draco_mesh *mesh, size_t number, void *out)
{
    const draco::PointAttribute *attribute = mesh->mesh->attribute(static_cast<int>(number));
    size_t size = static_cast<size_t>(attribute->num_components()) *
                  static_cast<size_t>(draco::DataTypeLength(attribute->data_type()));
    char *to = static_cast<char *>(out);
    for (mt_index i = 0; i < mesh->mesh->num_points(); i++, to += size) {
        draco::AttributeValueIndex value = attribute->mapped_index(draco::PointIndex(i));
        if (value.value() >= attribute->size() || attribute->byte_stride() < static_cast<int64_t>(size)) {
            return false;
        }
        std::memcpy(to, attribute->GetAddress(value), size);
    }
    return true;
}

extern "C" bool mt_draco_copy_triangles(const mt_draco_mesh *mesh, mt_index *out)
{
    mt_index count = mesh->mesh->num_points();
    for (mt_index i = 0; i < mesh->mesh->num_faces(); i++, out += 3) {
        const draco::Mesh::Face &face = mesh->mesh->face(draco::FaceIndex(i));
        for (size_t k = 0; k < 3; k++) {
            out[k] = face[k].value();
            if (out[k] >= count) {
                return false;
            }
        }
    }
    return true;
}

#endif
