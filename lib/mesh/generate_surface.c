/* Primitives that are one sheet: grid, torus, Moebius strip, Klein bottle. */
#include "lib/mesh/generate.h"

#define TORUS_TUBE 0.4 /* radius of the tube; the ring's is 1 */
#define STRIP_WIDTH 0.8
#define KLEIN_SCALE (1.0 / 15)

/* ---- grid: the square from -1 to 1, facing up ---- */

static mt_vec3 grid_position(const mt_sheet *sheet, mt_index i, mt_index j)
{
    double n = sheet->columns;
    return mt_vec3_make((2.0 * i - n) / n, 0, (n - 2.0 * j) / n);
}

mt_status mt_generate_grid(mt_context *context, mt_index resolution, mt_mesh **out)
{
    mt_sheet sheet = {.columns = resolution, .rows = resolution, .position = grid_position};
    return mt_generate_sheet(context, &sheet, out);
}

/* ---- torus: around the axis of y ---- */

static mt_vec3 torus_position(const mt_sheet *sheet, mt_index i, mt_index j)
{
    mt_circle_point around = mt_circle(i, sheet->columns), tube = mt_circle(j, sheet->rows);
    double radius = 1 + TORUS_TUBE * tube.x;
    return mt_vec3_make(radius * around.x, TORUS_TUBE * tube.y, -radius * around.y);
}

mt_status mt_generate_torus(mt_context *context, mt_index resolution, mt_mesh **out)
{
    mt_sheet sheet = {.columns = resolution,
                      .rows = resolution / 2,
                      .wraps_columns = true,
                      .wraps_rows = true,
                      .position = torus_position};
    return mt_generate_sheet(context, &sheet, out);
}

/* ---- Moebius strip: its middle line is the unit circle; it turns by half the angle around ---- */

static mt_vec3 moebius_position(const mt_sheet *sheet, mt_index i, mt_index j)
{
    mt_circle_point around = mt_circle(i, sheet->columns), half = mt_circle(i, 2 * (uint64_t)sheet->columns);
    double across = STRIP_WIDTH / 2 * ((2.0 * j - sheet->rows) / sheet->rows);
    double radius = 1 + across * half.x;
    return mt_vec3_make(radius * around.x, across * half.y, -radius * around.y);
}

mt_status mt_generate_moebius(mt_context *context, mt_index resolution, mt_mesh **out)
{
    mt_sheet sheet = {.columns = resolution,
                      .rows = 1 + resolution / 8,
                      .wraps_columns = true,
                      .twisted = true,
                      .position = moebius_position};
    return mt_generate_sheet(context, &sheet, out);
}

/* ---- Klein bottle: R. Franzoni's parametrization of its usual shape (Notices of the AMS 59, 2012); it passes
 * through its own wall. u runs along the bottle for half a turn, where v meets the half turn less v. ---- */

static mt_vec3 klein_position(const mt_sheet *sheet, mt_index i, mt_index j)
{
    mt_circle_point u = mt_circle(i, 2 * (uint64_t)sheet->columns), v = mt_circle(j, sheet->rows);
    double c = u.x, s = u.y, c2 = c * c, c3 = c2 * c, c4 = c2 * c2, c5 = c4 * c, c6 = c4 * c2, c7 = c6 * c;
    double x = -2 * c * (3 * v.x - 30 * s + 90 * c4 * s - 60 * c6 * s + 5 * c * v.x * s);
    double y = -s * (3 * v.x - 3 * c2 * v.x - 48 * c4 * v.x + 48 * c6 * v.x - 60 * s + 5 * c * v.x * s -
                     5 * c3 * v.x * s - 80 * c5 * v.x * s + 80 * c7 * v.x * s);
    double z = -2 * (3 + 5 * c * s) * v.y;
    return mt_vec3_scale(mt_vec3_make(x, y, z), KLEIN_SCALE);
}

mt_status mt_generate_klein(mt_context *context, mt_index resolution, mt_mesh **out)
{
    mt_index rows = resolution / 4 * 2; /* even, for the half turn to be a vertex */
    rows = rows < 4 ? 4 : rows;
    mt_sheet sheet = {.columns = resolution,
                      .rows = rows,
                      .wraps_columns = true,
                      .wraps_rows = true,
                      .twisted = true,
                      .twist_row = rows / 2,
                      .position = klein_position};
    return mt_generate_sheet(context, &sheet, out);
}
