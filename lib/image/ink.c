/* Anti-aliased by the distance to the line, in linear light. Letters are polylines on a grid of 4 x 6, so that no font
 * file is needed. */
#include <meshtool/ink.h>

#include <math.h>
#include <string.h>

#define GRID_HEIGHT 6.0
#define GRID_WIDTH 4.0
#define ADVANCE 6.0 /* from one letter to the next, on the grid */

/* Polylines, with spaces between them; a point is a column and a row from the top left. */
static const struct {
    char letter;
    const char *lines;
} glyphs[] = {
    {'0', "103041453616050110"},
    {'1', "112026 1636"},
    {'2', "01103041420646"},
    {'3', "01103041423313 334445361605"},
    {'4', "36300444"},
    {'5', "400002324345361605"},
    {'6', "30100105163645443304"},
    {'7', "004016"},
    {'8', "103041423313020110 130405163645443313"},
    {'9', "16364541301001021343"},
    {'.', "2626"},
    {'-', "0343"},
    {'+', "0343 2125"},
    {'A', "062046 1434"},
    {'B', "06003041423303 3344453606"},
    {'C', "4130100105163645"},
    {'D', "06003041453606"},
    {'E', "40000646 0333"},
    {'F', "400006 0333"},
    {'G', "413010010516364543 23"},
    {'H', "0006 4046 0343"},
    {'I', "1030 2026 1636"},
    {'J', "4045361605"},
    {'K', "0006 4003 0346"},
    {'L', "000646"},
    {'M', "0600234046"},
    {'N', "06004640"},
    {'O', "103041453616050110"},
    {'P', "06003041423303"},
    {'Q', "103041453616050110 3446"},
    {'R', "06003041423303 2346"},
    {'S', "413010010213334445361605"},
    {'T', "0040 2026"},
    {'U', "000516364540"},
    {'V', "002640"},
    {'W', "0016233640"},
    {'X', "0046 4006"},
    {'Y', "0023 4023 2326"},
    {'Z', "00400646"},
    {'/', "0640"},
    {'%', "0640 0001 4546"},
    {':', "2222 2525"},
    {',', "2517"},
    {'(', "30121436"},
    {')', "10323416"},
    {'=', "0242 0444"},
    {'?', "01103041422324 2626"},
    {'*', "2125 0244 0442"},
};

static void blend(float *pixel, uint32_t channels, mt_vec3 color, double cover)
{
    double old = channels == 4 ? (double)pixel[3] : 1.0, alpha = cover + old * (1.0 - cover);
    const double rgb[3] = {color.x, color.y, color.z};
    for (int i = 0; i < 3; i++) {
        double sum = (double)pixel[i] * old * (1.0 - cover) + rgb[i] * cover;
        pixel[i] = (float)(alpha > 0 ? sum / alpha : 0.0);
    }
    if (channels == 4) {
        pixel[3] = (float)alpha;
    }
}

static double distance(double x, double y, double x0, double y0, double x1, double y1)
{
    double dx = x1 - x0, dy = y1 - y0, squared = dx * dx + dy * dy;
    double t = squared > 0 ? ((x - x0) * dx + (y - y0) * dy) / squared : 0.0;
    t = fmin(fmax(t, 0.0), 1.0);
    double ax = x0 + t * dx - x, ay = y0 + t * dy - y;
    return sqrt(ax * ax + ay * ay);
}

/* The pixels from `low` to `high`, inside the picture. */
static void clip(double low, double high, uint32_t size, uint32_t *first, uint32_t *end)
{
    *first = low > 0 ? (low < size ? (uint32_t)low : size) : 0;
    *end = high > 0 ? (high < size ? (uint32_t)high + 1 : size) : 0;
}

void mt_ink_line(const mt_ink *ink, double x0, double y0, double x1, double y1)
{
    double reach = ink->radius + 1.0;
    uint32_t first_x, end_x, first_y, end_y;
    clip(fmin(x0, x1) - reach, fmax(x0, x1) + reach, ink->image->width, &first_x, &end_x);
    clip(fmin(y0, y1) - reach, fmax(y0, y1) + reach, ink->image->height, &first_y, &end_y);
    for (uint32_t y = first_y; y < end_y; y++) {
        for (uint32_t x = first_x; x < end_x; x++) {
            double cover = ink->radius + 0.5 - distance(x + 0.5, y + 0.5, x0, y0, x1, y1);
            if (cover > 0) {
                blend(mt_image_pixel(ink->image, x, y), ink->image->channel_count, ink->color, fmin(cover, 1.0));
            }
        }
    }
}

static const char *lines_of(char letter)
{
    char capital = letter >= 'a' && letter <= 'z' ? (char)(letter - 'a' + 'A') : letter;
    for (size_t i = 0; i < sizeof glyphs / sizeof *glyphs; i++) {
        if (glyphs[i].letter == capital) {
            return glyphs[i].lines;
        }
    }
    return "";
}

static void draw_letter(const mt_ink *ink, double left, double top, double scale, const char *lines)
{
    double x = 0, y = 0;
    bool begun = false;
    for (const char *at = lines; *at; at += *at == ' ' ? 1 : 2) {
        if (*at == ' ') {
            begun = false;
            continue;
        }
        double next_x = left + (at[0] - '0') * scale, next_y = top + (at[1] - '0') * scale;
        if (begun) {
            mt_ink_line(ink, x, y, next_x, next_y);
        }
        x = next_x;
        y = next_y;
        begun = true;
    }
}

double mt_ink_text_width(double height, const char *text)
{
    return (ADVANCE * (double)strlen(text) - (ADVANCE - GRID_WIDTH)) * height / GRID_HEIGHT;
}

void mt_ink_text(const mt_ink *ink, double x, double y, double height, const char *text)
{
    double scale = height / GRID_HEIGHT, left = x - 0.5 * mt_ink_text_width(height, text);
    for (; *text; text++, left += ADVANCE * scale) {
        draw_letter(ink, left, y - 0.5 * height, scale, lines_of(*text));
    }
}
