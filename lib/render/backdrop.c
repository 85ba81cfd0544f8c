#include "lib/render/backdrop.h"

mt_backdrop mt_backdrop_make(const mt_preview_options *options, const mt_surface *surface)
{
    mt_backdrop backdrop = {.transparent = options->background == MT_BACKGROUND_TRANSPARENT};
    if (options->background == MT_BACKGROUND_COLOR) {
        const double *c = options->background_color;
        backdrop.top = mt_linear_color(surface, c[0], c[1], c[2]);
        backdrop.bottom = backdrop.top;
    } else {
        backdrop.top = mt_linear_color(surface, 0.965, 0.97, 0.98);
        backdrop.bottom = mt_linear_color(surface, 0.83, 0.845, 0.865);
    }
    return backdrop;
}
