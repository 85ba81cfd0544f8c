#include "lib/mesh/generate.h"

#define COLUMN_GRAIN 64 /* columns in a block */

typedef struct sheet_loop {
    const mt_sheet *sheet;
    mt_mesh *mesh;
} sheet_loop;

static mt_index vertex_rows(const mt_sheet *sheet)
{
    return sheet->rows + !sheet->wraps_rows;
}

static mt_index vertex_at(const mt_sheet *sheet, mt_index i, mt_index j)
{
    if (sheet->wraps_columns && i == sheet->columns) {
        i = 0;
        if (sheet->twisted) {
            j = sheet->wraps_rows ? sheet->twist_row + 2 * sheet->rows - j : sheet->rows - j;
        }
    }
    if (sheet->wraps_rows) {
        j %= sheet->rows;
    }
    return i * vertex_rows(sheet) + j;
}

static void fill_positions(void *user, uint64_t begin, uint64_t end)
{
    const sheet_loop *loop = user;
    const mt_sheet *sheet = loop->sheet;
    for (mt_index i = (mt_index)begin; i < end; i++) {
        for (mt_index j = 0; j < vertex_rows(sheet); j++) {
            mt_mesh_set_position(loop->mesh, vertex_at(sheet, i, j), sheet->position(sheet, i, j));
        }
    }
}

static void fill_faces(void *user, uint64_t begin, uint64_t end)
{
    const sheet_loop *loop = user;
    const mt_sheet *sheet = loop->sheet;
    for (mt_index i = (mt_index)begin; i < end; i++) {
        mt_index *corner = loop->mesh->corner_vertices + 4 * (size_t)i * sheet->rows;
        for (mt_index j = 0; j < sheet->rows; j++) {
            *corner++ = vertex_at(sheet, i, j);
            *corner++ = vertex_at(sheet, i + 1, j);
            *corner++ = vertex_at(sheet, i + 1, j + 1);
            *corner++ = vertex_at(sheet, i, j + 1);
        }
    }
}

mt_status mt_generate_sheet(mt_context *context, const mt_sheet *sheet, mt_mesh **out)
{
    uint64_t vertex_columns = (uint64_t)sheet->columns + !sheet->wraps_columns;
    mt_mesh_layout layout = {.vertex_count = vertex_columns * vertex_rows(sheet),
                             .face_count = (uint64_t)sheet->columns * sheet->rows,
                             .face_size = 4,
                             .position_type = MT_F64};
    mt_status status = mt_mesh_create(context, &layout, out);
    if (status == MT_OK) {
        sheet_loop loop = {sheet, *out};
        mt_parallel_for(context, vertex_columns, COLUMN_GRAIN, fill_positions, &loop);
        mt_parallel_for(context, sheet->columns, COLUMN_GRAIN, fill_faces, &loop);
    }
    return status;
}
