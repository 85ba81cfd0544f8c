#include "files.h"

#include "line.h"
#include "message.h"
#include "profile.h"
#include "progress.h"
#include "quantity.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

bool cli_is_standard_output(const char *path)
{
    static const char *const names[] = {"-", "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        if (strcmp(path, names[i]) == 0) {
            return true;
        }
    }
    return false;
}

const char *cli_output_name(const char *path)
{
    return cli_is_standard_output(path) ? "standard output" : path;
}

const char *cli_extension(const char *text)
{
    return text && *text == '.' ? text + 1 : text;
}

cli_exit cli_check_inputs(const cli_job *job)
{
    const char *from = cli_extension(job->common->from);
    if (from) {
        const mt_mesh_format *format = mt_mesh_format_by_extension(from);
        if (!format || !format->read) {
            return cli_wrong_usage(job->command, "--from %s: no format that is read has this extension", from);
        }
    }
    size_t count = 0;
    for (size_t i = 0; i < job->operand_count; i++) {
        count += strcmp(job->operands[i], "-") == 0;
    }
    return count < 2 ? CLI_EXIT_DONE
                     : cli_wrong_usage(job->command, "standard input (-) can be read once only, and is named twice");
}

static cli_exit refuse_output(const char *path, const char *reason)
{
    fprintf(stderr, "meshtool: %s: %s\n", path, reason);
    return CLI_EXIT_IO;
}

/* What would fail after a long run is better said before it. */
static cli_exit check_place(const cli_job *job, const char *path)
{
    struct stat status;
    if (stat(path, &status) == 0) {
        if (S_ISDIR(status.st_mode)) {
            return refuse_output(path, "is a folder; name a file in it");
        }
        bool is_kept = job->common->no_clobber && S_ISREG(status.st_mode);
        return is_kept ? refuse_output(path, "exists, and --no-clobber was given") : CLI_EXIT_DONE;
    }
    const char *slash = strrchr(path, '/');
    char folder[4096] = ".";
    size_t length = slash ? (size_t)(slash - path) + 1 : 0;
    if (length >= sizeof folder) {
        return CLI_EXIT_DONE; /* opening it will say */
    }
    if (slash) {
        memcpy(folder, path, length);
        folder[length] = '\0';
    }
    if (stat(folder, &status) != 0 || !S_ISDIR(status.st_mode)) {
        return refuse_output(path, "its folder does not exist");
    }
    return access(folder, W_OK) == 0 ? CLI_EXIT_DONE : refuse_output(path, strerror(errno));
}

cli_exit cli_check_output(const cli_job *job, const char *path)
{
    if (!path) {
        return cli_wrong_usage(job->command, "where to write is missing; give -o OUT");
    }
    if (cli_is_standard_output(path)) {
        return job->common->json ? cli_wrong_usage(job->command, "--json and the data cannot both go to standard "
                                                                 "output; give -o FILE")
                                 : CLI_EXIT_DONE;
    }
    return check_place(job, path);
}

/* How to write, completed by the options that all commands have. */
static mt_mesh_write_options mesh_write_options(const cli_job *job, mt_mesh_write_options how)
{
    how.format = cli_extension(job->common->to);
    how.encoding = (mt_encoding)job->common->encoding;
    how.strict_loss = job->common->strict_loss;
    how.no_clobber = job->common->no_clobber;
    how.digits = job->common->strict_loss ? 0 : cli_profile_of(job->common)->digits;
    return how;
}

static cli_exit check_encoding(const cli_job *job, const mt_mesh_format *format)
{
    const struct {
        mt_encoding encoding;
        const char *name;
        bool is_held;
    } encodings[] = {
        {MT_ENCODING_ASCII, "ascii", format->has_ascii},
        {MT_ENCODING_BINARY, "binary", format->has_binary},
        {MT_ENCODING_BINARY_BIG, "binary-be", format->has_binary_big},
    };
    cli_line known = {0};
    for (size_t i = 0; i < sizeof encodings / sizeof encodings[0]; i++) {
        if (encodings[i].is_held && encodings[i].encoding == job->common->encoding) {
            return CLI_EXIT_DONE;
        }
        if (encodings[i].is_held) {
            cli_line_add(&known, "%s%s", known.length ? ", " : "", encodings[i].name);
        }
    }
    return cli_wrong_usage(job->command, "--encoding: %s files have only %s", format->name, known.text);
}

cli_exit cli_check_mesh_output(const cli_job *job, const char *path, const mt_mesh_format **format)
{
    cli_exit code = cli_check_output(job, path);
    if (code != CLI_EXIT_DONE) {
        return code;
    }
    mt_mesh_write_options options = mesh_write_options(job, (mt_mesh_write_options){0});
    *format = mt_mesh_format_for_output(job->context, path, &options);
    if (!*format) {
        return cli_report_failure(job, path);
    }
    return options.encoding == MT_ENCODING_DEFAULT ? CLI_EXIT_DONE : check_encoding(job, *format);
}

cli_exit cli_check_image_output(const cli_job *job, const char *path, const mt_image_format **format)
{
    cli_exit code = cli_check_output(job, path);
    if (code != CLI_EXIT_DONE) {
        return code;
    }
    mt_image_write_options options = {.format = cli_extension(job->common->to)};
    *format = mt_image_format_for_output(job->context, path, &options);
    return *format ? CLI_EXIT_DONE : cli_report_failure(job, path);
}

cli_exit cli_read_mesh(const cli_job *job, const char *path, mt_mesh **out, const mt_mesh_format **format)
{
    mt_mesh_read_options options = {
        .format = cli_extension(job->common->from),
        .precision = (mt_precision)job->common->precision,
    };
    int part = mt_part_begin(job->context, "input", "a mesh to work on");
    mt_status status = mt_mesh_read_file(job->context, path, &options, out, format);
    mt_part_end(job->context, part);
    if (status != MT_OK) {
        return cli_report_failure(job, path);
    }
    cli_say(job, "%s: read %s with %s and %s", path, (*format)->title, cli_counted((*out)->vertex_count, "vertex").text,
            cli_counted((*out)->face_count, "face").text);
    return CLI_EXIT_DONE;
}

static void warn_of_loss(const cli_job *job, const char *path, const mt_mesh_format *format, const mt_loss *loss)
{
    if (loss->count == 0 || job->common->quiet) {
        return;
    }
    cli_line line = {0};
    for (size_t i = 0; i < loss->count; i++) {
        cli_line_add_item(&line, i, loss->count, loss->items[i]);
    }
    cli_progress_clear();
    fprintf(stderr, "meshtool: warning: %s: %s cannot hold %s; %s\n", cli_output_name(path), format->title, line.text,
            loss->count == 1 ? "this is lost" : "these are lost");
}

/* What the profile gives up in a text file; NULL: nothing. */
static const char *lost_digits(const mt_mesh_format *format, const mt_mesh_write_options *options, char text[64])
{
    bool is_text = format->has_ascii && (options->encoding == MT_ENCODING_ASCII || !format->has_binary);
    if (options->digits == 0 || !is_text) {
        return NULL;
    }
    snprintf(text, 64, "digits of positions after the %uth", options->digits);
    return text;
}

static void warn_of_digits(const cli_job *job, const char *path, const char *digits)
{
    if (digits && !job->common->quiet) {
        cli_progress_clear();
        fprintf(stderr, "meshtool: %s: --profile %s leaves out %s\n", path, cli_profile_of(job->common)->name, digits);
    }
}

cli_exit cli_write_mesh(const cli_job *job, const mt_mesh *mesh, const char *path, json_t **lost)
{
    static const mt_mesh_write_options defaults;
    return cli_write_mesh_as(job, mesh, path, &defaults, lost);
}

cli_exit cli_write_mesh_as(const cli_job *job, const mt_mesh *mesh, const char *path, const mt_mesh_write_options *how,
                           json_t **lost)
{
    mt_mesh_write_options options = mesh_write_options(job, *how);
    mt_loss loss = {0};
    int part = mt_part_begin(job->context, "output", "asked for");
    mt_status status = mt_mesh_write_file(job->context, mesh, path, &options, &loss);
    mt_part_end(job->context, part);
    if (status != MT_OK) {
        return cli_report_failure(job, path);
    }
    char text[64];
    const mt_mesh_format *format = mt_mesh_format_for_output(job->context, path, &options);
    const char *digits = lost_digits(format, &options, text);
    warn_of_loss(job, path, format, &loss);
    warn_of_digits(job, path, digits);
    cli_say(job, "%s: wrote %s and %s", path, cli_counted(mesh->vertex_count, "vertex").text,
            cli_counted(mesh->face_count, "face").text);
    if (lost) {
        *lost = cli_json_array();
        for (size_t i = 0; i < loss.count; i++) {
            cli_json_append(*lost, cli_json_text(loss.items[i]));
        }
        if (digits) {
            cli_json_append(*lost, cli_json_text(digits));
        }
    }
    return CLI_EXIT_DONE;
}

cli_exit cli_write_image_as(const cli_job *job, const mt_image *image, const char *path,
                            const mt_image_write_options *how)
{
    mt_image_write_options options = *how;
    options.format = cli_extension(job->common->to);
    options.no_clobber = job->common->no_clobber;
    int part = mt_part_begin(job->context, "output", "asked for");
    mt_status status = mt_image_write_file(job->context, image, path, &options);
    mt_part_end(job->context, part);
    if (status != MT_OK) {
        return cli_report_failure(job, path);
    }
    cli_say(job, "%s: wrote %u x %u pixels", path, image->width, image->height);
    return CLI_EXIT_DONE;
}

cli_exit cli_write_image(const cli_job *job, const mt_image *image, const char *path)
{
    mt_image_write_options defaults = {0};
    return cli_write_image_as(job, image, path, &defaults);
}

cli_exit cli_output_operand(const cli_job *job, const char **path)
{
    *path = job->operand_count == 2 ? job->operands[1] : job->common->output;
    if (job->operand_count == 2 && job->common->output) {
        return cli_wrong_usage(job->command, "where to write is given twice, as %s and as -o %s", job->operands[1],
                               job->common->output);
    }
    return CLI_EXIT_DONE;
}
