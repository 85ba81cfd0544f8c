#include "tradeoff/plot_labels.h"

#include <math.h>
#include <string.h>

#define LABEL_MAXIMUM 32

typedef struct area {
    double left, top, right, bottom;
} area;

/* Around a point: right, left, above, below, and between; the first that is free is taken. */
static const struct {
    double x, y; /* of the label's middle, in halves of its size beyond the point's radius */
} places[] = {{1, -1.3}, {-1, -1.3}, {1, 1.3}, {-1, 1.3}, {0, -1}, {0, 1}, {1, -2.6}, {-1, -2.6}, {1, 2.6}, {0, -2.4}};

static double overlap(const area *a, const area *b)
{
    double width = fmin(a->right, b->right) - fmax(a->left, b->left);
    double height = fmin(a->bottom, b->bottom) - fmax(a->top, b->top);
    return width > 0 && height > 0 ? width * height : 0;
}

static area area_at(const plot_label *label, size_t place, double width, double height)
{
    double x = label->x + places[place].x * (0.5 * width + label->radius + 4);
    double y = label->y + places[place].y * (0.5 * height + (places[place].x == 0 ? label->radius + 4 : 3));
    return (area){x - 0.5 * width - 2, y - 0.5 * height - 2, x + 0.5 * width + 2, y + 0.5 * height + 2};
}

/* What a label there would hide; leaving the field costs as much as hiding all of another. */
static double cost_of(const area *at, const area *taken, size_t taken_count, const area *field)
{
    double inside = overlap(at, field), whole = (at->right - at->left) * (at->bottom - at->top);
    double cost = 10 * (whole - inside);
    for (size_t i = 0; i < taken_count; i++) {
        cost += overlap(at, &taken[i]);
    }
    return cost;
}

void plot_labels_draw(const canvas *on, const plot_label *labels, size_t count, double height, double left,
                      double right, double top)
{
    area taken[2 * LABEL_MAXIMUM];
    const area field = {left, top, right, INFINITY};
    size_t taken_count = 0;
    for (size_t i = 0; i < count && i < LABEL_MAXIMUM; i++) {
        const plot_label *p = &labels[i];
        taken[taken_count++] = (area){p->x - p->radius, p->y - p->radius, p->x + p->radius, p->y + p->radius};
    }
    for (size_t i = 0; i < count && i < LABEL_MAXIMUM; i++) {
        double width = canvas_text_width(on, height, labels[i].text), least = INFINITY;
        area best = {0, 0, 0, 0};
        for (size_t place = 0; place < sizeof places / sizeof *places; place++) {
            area at = area_at(&labels[i], place, width, height);
            double cost = cost_of(&at, taken, taken_count, &field);
            if (cost < least) {
                least = cost;
                best = at;
            }
        }
        taken[taken_count++] = best;
        canvas_text(on, 0.5 * (best.left + best.right), 0.5 * (best.top + best.bottom), height, PLOT_MIDDLE,
                    labels[i].shade, labels[i].text);
    }
}
