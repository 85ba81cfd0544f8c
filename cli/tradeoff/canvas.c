#include "tradeoff/canvas.h"

#include <meshtool/ink.h>

#include <string.h>

/* sRGB, one byte each. */
static const unsigned char shades[PLOT_SHADE_COUNT][3] = {
    [PLOT_INK] = {30, 33, 38},     [PLOT_MUTED] = {110, 116, 126}, [PLOT_FAINT] = {216, 220, 226},
    [PLOT_ACCENT] = {200, 72, 20}, [PLOT_PAPER] = {255, 255, 255},
};

/* The height of a capital as a share of a font's size, and a letter's mean width, in the fonts that browsers have. */
#define CAPITAL 0.72
#define LETTER 0.56

static const char *shade_name(plot_shade shade, char name[16])
{
    snprintf(name, 16, "#%02x%02x%02x", shades[shade][0], shades[shade][1], shades[shade][2]);
    return name;
}

static mt_ink ink_of(const canvas *on, plot_shade shade, double radius)
{
    mt_ink ink = {.image = on->image, .radius = radius};
    ink.color = mt_vec3_make(shades[shade][0] / 255.0, shades[shade][1] / 255.0, shades[shade][2] / 255.0);
    return ink;
}

void canvas_begin(const canvas *on, double width, double height)
{
    if (on->svg) {
        fprintf(on->svg,
                "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%g\" height=\"%g\" viewBox=\"0 0 %g %g\" "
                "font-family=\"Helvetica, Arial, sans-serif\">\n<rect width=\"%g\" height=\"%g\" fill=\"#fff\"/>\n",
                width, height, width, height, width, height);
        return;
    }
    size_t count = (size_t)on->image->width * on->image->height * on->image->channel_count;
    for (size_t i = 0; i < count; i++) {
        on->image->pixels[i] = 1;
    }
}

void canvas_end(const canvas *on)
{
    if (on->svg) {
        fputs("</svg>\n", on->svg);
    }
}

void canvas_line(const canvas *on, double x0, double y0, double x1, double y1, double width, plot_shade shade)
{
    char name[16];
    if (on->svg) {
        fprintf(on->svg, "<path d=\"M%.1f %.1fL%.1f %.1f\" stroke=\"%s\" stroke-width=\"%g\"/>\n", x0, y0, x1, y1,
                shade_name(shade, name), width);
        return;
    }
    const mt_ink ink = ink_of(on, shade, 0.5 * width);
    mt_ink_line(&ink, x0, y0, x1, y1);
}

void canvas_disc(const canvas *on, double x, double y, double radius, plot_shade shade)
{
    char name[16];
    if (on->svg) {
        fprintf(on->svg, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%g\" fill=\"%s\"/>\n", x, y, radius,
                shade_name(shade, name));
        return;
    }
    const mt_ink ink = ink_of(on, shade, radius);
    mt_ink_line(&ink, x, y, x, y);
}

static void put_escaped(FILE *out, const char *text)
{
    for (; *text; text++) {
        const char *entity = *text == '&' ? "&amp;" : *text == '<' ? "&lt;" : *text == '>' ? "&gt;" : NULL;
        if (entity) {
            fputs(entity, out);
        } else {
            fputc(*text, out);
        }
    }
}

double canvas_text_width(const canvas *on, double height, const char *text)
{
    return on->svg ? (double)strlen(text) * LETTER * height / CAPITAL : mt_ink_text_width(height, text);
}

void canvas_text(const canvas *on, double x, double y, double height, plot_anchor anchor, plot_shade shade,
                 const char *text)
{
    static const char *const anchors[] = {"start", "middle", "end"};
    char name[16];
    if (on->svg) {
        fprintf(on->svg, "<text x=\"%.1f\" y=\"%.1f\" font-size=\"%g\" text-anchor=\"%s\" fill=\"%s\">", x,
                y + 0.5 * height, height / CAPITAL, anchors[anchor], shade_name(shade, name));
        put_escaped(on->svg, text);
        fputs("</text>\n", on->svg);
        return;
    }
    const mt_ink ink = ink_of(on, shade, height / 14);
    double half = 0.5 * mt_ink_text_width(height, text);
    mt_ink_text(&ink, x + (anchor == PLOT_BEGIN ? half : anchor == PLOT_END ? -half : 0), y, height, text);
}
