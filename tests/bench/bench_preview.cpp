// A preview of 1024 x 1024 from binary PLY to PNG, beside the least that any program has to do: read the bytes, run a
// plain depth-buffer loop at one sample a pixel, and deflate a picture of that size at level 1.
#include "tests/bench/bench.hpp"

#include <spng.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace bench
{
namespace
{

constexpr int side = 1024;

struct Screen {
    std::vector<float> depth = std::vector<float>(side * side, -1e30f);
    std::vector<unsigned char> pixels = std::vector<unsigned char>(3 * side * side, 255);
};

void draw_triangle(Screen &screen, const double (&p)[3][3], unsigned char shade)
{
    double area = (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
    int x0 = std::max(0, int(std::min({p[0][0], p[1][0], p[2][0]}))), x1 = int(std::max({p[0][0], p[1][0], p[2][0]}));
    int y0 = std::max(0, int(std::min({p[0][1], p[1][1], p[2][1]}))), y1 = int(std::max({p[0][1], p[1][1], p[2][1]}));
    for (int y = y0; y <= std::min(y1, side - 1); y++) {
        for (int x = x0; x <= std::min(x1, side - 1); x++) {
            double b = ((x - p[0][0]) * (p[2][1] - p[0][1]) - (y - p[0][1]) * (p[2][0] - p[0][0])) / area;
            double c = ((p[1][0] - p[0][0]) * (y - p[0][1]) - (p[1][1] - p[0][1]) * (x - p[0][0])) / area;
            float z = float(p[0][2] + b * (p[1][2] - p[0][2]) + c * (p[2][2] - p[0][2]));
            std::size_t at = std::size_t(y) * side + std::size_t(x);
            if (b >= 0 && c >= 0 && b + c <= 1 && z > screen.depth[at]) {
                screen.depth[at] = z;
                std::fill_n(screen.pixels.begin() + std::ptrdiff_t(3 * at), 3, shade);
            }
        }
    }
}

void draw_plainly(const mt_mesh *mesh, Screen &screen)
{
    const mt_index *corner = mesh->corner_vertices;
    for (mt_index face = 0; face < mesh->face_count; face++, corner += 3) {
        double p[3][3];
        for (int i = 0; i < 3; i++) {
            mt_vec3 q = mt_mesh_position(mesh, corner[i]);
            p[i][0] = (q.x / 3 + 0.5) * side;
            p[i][1] = (q.y / 3 + 0.5) * side;
            p[i][2] = q.z;
        }
        draw_triangle(screen, p, static_cast<unsigned char>(face & 127));
    }
}

void deflate(const Screen &screen)
{
    spng_ctx *png = spng_ctx_new(SPNG_CTX_ENCODER);
    spng_set_option(png, SPNG_ENCODE_TO_BUFFER, 1);
    spng_set_option(png, SPNG_IMG_COMPRESSION_LEVEL, 1);
    spng_ihdr header{};
    header.width = header.height = side;
    header.bit_depth = 8;
    header.color_type = SPNG_COLOR_TYPE_TRUECOLOR;
    spng_set_ihdr(png, &header);
    spng_encode_image(png, screen.pixels.data(), screen.pixels.size(), SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE);
    int error = 0;
    std::size_t size = 0;
    std::free(spng_get_png_buffer(png, &size, &error));
    spng_ctx_free(png);
}

void least_work(const mt_mesh *mesh, const std::string &path)
{
    std::ifstream file(path, std::ios::binary);
    std::vector<char> block(1 << 20);
    while (file.read(block.data(), std::streamsize(block.size()))) {
    }
    Screen screen;
    draw_plainly(mesh, screen);
    deflate(screen);
}

void preview_ours(mt_context *context, const std::string &in, const std::string &out)
{
    mt_mesh *mesh = nullptr;
    mt_image *image = nullptr;
    require(context, mt_mesh_read_file(context, in.c_str(), nullptr, &mesh, nullptr));
    require(context, mt_preview(context, mesh, nullptr, &image));
    require(context, mt_image_write_file(context, image, out.c_str(), nullptr));
    mt_image_destroy(context, image);
    mt_mesh_destroy(context, mesh);
}

} // namespace

void run_preview()
{
    std::string folder = make_scratch_folder();
    std::string in = folder + "/mesh.ply", out = folder + "/mesh.png";
    for (std::uint64_t size : sizes) {
        mt_mesh *mesh = wavy_torus(size, false, false);
        require(shared_context(), mt_mesh_set_position_type(shared_context(), mesh, MT_F32, nullptr));
        require(shared_context(), mt_mesh_write_file(shared_context(), mesh, in.c_str(), nullptr, nullptr));
        Row row;
        row.name = "preview, PLY to PNG";
        row.mesh = "torus";
        row.faces = mesh->face_count;
        row.peer = "least";
        row.note = "least: bytes + plain depth loop, 1 sample + deflate";
        compare(
            row, [&](mt_context *context) { preview_ours(context, in, out); }, [&] { least_work(mesh, in); });
        mt_mesh_destroy(shared_context(), mesh);
    }
    std::filesystem::remove_all(folder);
}

} // namespace bench
