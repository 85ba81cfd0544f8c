#include "image_loss.h"

#include "files.h"
#include "line.h"
#include "message.h"
#include "quantity.h"

#define ITEMS 2

typedef struct loss_list {
    cli_line items[ITEMS];
    size_t count;
} loss_list;

static void list(const cli_image_loss *loss, loss_list *out)
{
    out->count = 0;
    if (loss->bits_before > loss->bits) {
        cli_line *item = &out->items[out->count++];
        *item = (cli_line){0};
        cli_line_add(item, "%s of %u bits", loss->bits_before >= 32 ? "floats" : "samples", loss->bits_before);
    }
    if (loss->outside > 0) {
        cli_line *item = &out->items[out->count++];
        *item = (cli_line){0};
        cli_line_add(item, "%s outside 0 to 1 (clipped)", cli_counted(loss->outside, "sample").text);
    }
}

/* "Portable Network Graphics of 8 bits cannot hold samples of 16 bits"; returns how many things are lost. */
static size_t describe(const cli_image_loss *loss, cli_line *out)
{
    loss_list found;
    list(loss, &found);
    cli_line_add(out, "%s of %s cannot hold ", loss->format->title, cli_counted(loss->bits, "bit").text);
    for (size_t i = 0; i < found.count; i++) {
        cli_line_add_item(out, i, found.count, found.items[i].text);
    }
    return found.count;
}

cli_exit cli_image_loss_find(const cli_job *job, const mt_image *image, const char *path,
                             const mt_image_write_options *how, cli_image_loss *loss)
{
    cli_line line = {0};
    if (mt_image_written_bits(job->context, loss->format, how, &loss->bits) != MT_OK) {
        return cli_report_failure(job, path);
    }
    loss->outside = loss->bits < 32 ? mt_image_count_outside(image, loss->bits) : 0;
    if (!job->common->strict_loss || describe(loss, &line) == 0) {
        return CLI_EXIT_DONE;
    }
    mt_fail(job->context, MT_ERROR_LOSS, "%s, and no loss is allowed", line.text);
    return cli_report_failure(job, path);
}

void cli_image_loss_warn(const cli_job *job, const char *path, const cli_image_loss *loss)
{
    cli_line line = {0}, sentence = {0};
    size_t count = describe(loss, &line);
    if (count > 0) {
        unsigned most = 0;
        for (size_t i = 0; i < sizeof loss->format->bits / sizeof most; i++) {
            most = loss->format->bits[i] > most ? loss->format->bits[i] : most;
        }
        cli_line_add(&sentence, "%s: %s; %s", cli_output_name(path), line.text,
                     count == 1 ? "this is lost" : "these are lost");
        if (most > loss->bits) {
            cli_line_add(&sentence, " (--bits goes up to %u)", most);
        }
        mt_warn(job->context, "%s", sentence.text);
    }
}

json_t *cli_image_loss_json(const cli_image_loss *loss)
{
    loss_list found;
    json_t *array = cli_json_array();
    list(loss, &found);
    for (size_t i = 0; i < found.count; i++) {
        cli_json_append(array, cli_json_text(found.items[i].text));
    }
    return array;
}
