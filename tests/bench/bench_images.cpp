// Pictures of four megapixels written as files: a preview with noise on it and a flat colour. Beside them the libraries
// alone, on one thread and from bytes that are ready: libspng at its fastest level, libjpeg-turbo at our quality,
// libtiff with the compression that ours has.
#include "tests/bench/bench.hpp"

#include <jpeglib.h>
#include <spng.h>
#include <tiffio.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>

namespace bench
{
namespace
{

constexpr std::uint32_t side = 2048;
constexpr std::size_t row_size = 3 * side;

using Bytes = std::vector<unsigned char>;

void fail(const char *who)
{
    std::fprintf(stderr, "bench: %s could not write a picture\n", who);
    std::exit(1);
}

void write_spng(const Bytes &bytes, const std::string &path)
{
    std::FILE *file = std::fopen(path.c_str(), "wb");
    spng_ctx *png = spng_ctx_new(SPNG_CTX_ENCODER);
    spng_ihdr header{};
    header.width = header.height = side;
    header.bit_depth = 8;
    header.color_type = SPNG_COLOR_TYPE_TRUECOLOR;
    if (!file || spng_set_png_file(png, file) || spng_set_option(png, SPNG_IMG_COMPRESSION_LEVEL, 1) ||
        spng_set_ihdr(png, &header) ||
        spng_encode_image(png, bytes.data(), bytes.size(), SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE)) {
        fail("libspng");
    }
    spng_ctx_free(png);
    std::fclose(file);
}

void write_jpeg(const Bytes &bytes, const std::string &path)
{
    std::FILE *file = std::fopen(path.c_str(), "wb");
    if (!file) {
        fail("libjpeg");
    }
    jpeg_error_mgr errors;
    jpeg_compress_struct encoder{};
    encoder.err = jpeg_std_error(&errors);
    jpeg_create_compress(&encoder);
    jpeg_stdio_dest(&encoder, file);
    encoder.image_width = encoder.image_height = side;
    encoder.input_components = 3;
    encoder.in_color_space = JCS_RGB;
    jpeg_set_defaults(&encoder);
    jpeg_set_quality(&encoder, 90, TRUE);
    encoder.comp_info[0].h_samp_factor = encoder.comp_info[0].v_samp_factor = 1;
    jpeg_start_compress(&encoder, TRUE);
    while (encoder.next_scanline < side) {
        JSAMPROW row = const_cast<JSAMPROW>(bytes.data() + encoder.next_scanline * row_size);
        jpeg_write_scanlines(&encoder, &row, 1);
    }
    jpeg_finish_compress(&encoder);
    jpeg_destroy_compress(&encoder);
    std::fclose(file);
}

void write_tiff(const Bytes &bytes, const std::string &path)
{
    TIFF *tiff = TIFFOpen(path.c_str(), "wl");
    if (!tiff) {
        fail("libtiff");
    }
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, side);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, side);
    TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, 3);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 8);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_RGB);
    TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    TIFFSetField(tiff, TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE);
    TIFFSetField(tiff, TIFFTAG_PREDICTOR, PREDICTOR_HORIZONTAL);
    TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, (256u << 10) / static_cast<unsigned>(row_size));
    Bytes row(row_size);
    for (std::uint32_t y = 0; y < side; y++) {
        row.assign(bytes.begin() + std::ptrdiff_t(y * row_size), bytes.begin() + std::ptrdiff_t((y + 1) * row_size));
        if (TIFFWriteScanline(tiff, row.data(), y, 0) != 1) {
            fail("libtiff");
        }
    }
    TIFFClose(tiff);
}

struct Format {
    const char *extension, *peer;
    void (*write)(const Bytes &bytes, const std::string &path);
};
const Format formats[] = {
    {"png", "libspng", write_spng}, {"jpg", "libjpeg", write_jpeg}, {"tif", "libtiff", write_tiff}};

mt_image *noisy_preview()
{
    mt_mesh *mesh = wavy_torus(100000, false, false);
    mt_preview_options options{};
    options.width = options.height = side;
    mt_image *image = nullptr;
    require(shared_context(), mt_preview(shared_context(), mesh, &options, &image));
    mt_mesh_destroy(shared_context(), mesh);
    std::mt19937 random(12345);
    for (std::size_t i = 0; i < std::size_t(side) * side * image->channel_count; i++) {
        image->pixels[i] += (static_cast<float>(random() >> 8) / 0x1p24F - 0.5F) * 8.0F / 255.0F;
    }
    return image;
}

mt_image *flat_picture()
{
    mt_image *image = nullptr;
    require(shared_context(), mt_image_create(shared_context(), side, side, 3, &image));
    for (std::size_t i = 0; i < std::size_t(side) * side; i++) {
        image->pixels[3 * i] = 0.25F;
        image->pixels[3 * i + 1] = 0.5F;
        image->pixels[3 * i + 2] = 0.75F;
    }
    return image;
}

Bytes encoded(const mt_image *image)
{
    Bytes bytes(row_size * side);
    mt_image_encoder *encoder = nullptr;
    require(shared_context(), mt_image_encoder_create(shared_context(), image, 8, &encoder));
    mt_image_encode_rows(shared_context(), encoder, 0, side, bytes.data());
    mt_image_encoder_destroy(shared_context(), encoder);
    return bytes;
}

void write_formats(const char *what, const mt_image *image, const std::string &folder)
{
    Bytes bytes = encoded(image);
    for (const Format &format : formats) {
        std::string path = folder + "/ours." + format.extension, their_path = folder + "/theirs." + format.extension;
        auto ours = [&](mt_context *context) {
            require(context, mt_image_write_file(context, image, path.c_str(), nullptr));
        };
        ours(shared_context());
        format.write(bytes, their_path);
        Row row;
        row.name = std::string("write ") + format.extension;
        row.mesh = what;
        row.peer = format.peer;
        row.note = "2048 x 2048, " + std::to_string(std::filesystem::file_size(path) / 1000) + " kB, theirs " +
                   std::to_string(std::filesystem::file_size(their_path) / 1000) + " kB";
        compare(row, ours, [&] { format.write(bytes, their_path); });
    }
}

} // namespace

void run_images()
{
    std::string folder = make_scratch_folder();
    mt_image *noisy = noisy_preview(), *flat = flat_picture();
    write_formats("noisy preview", noisy, folder);
    write_formats("flat colour", flat, folder);
    mt_image_destroy(shared_context(), noisy);
    mt_image_destroy(shared_context(), flat);
    std::filesystem::remove_all(folder);
}

} // namespace bench
