/* What --explain prints: parts built and skipped, and what the whole run took. */
#include "json.h"
#include "message.h"
#include "progress.h"
#include "quantity.h"

static void print_part(const mt_part *part)
{
    if (part->built || part->milliseconds > 0) {
        fprintf(stderr, "%-8s %-28s %10.2f ms %12s", part->built ? "built" : "saved", part->name, part->milliseconds,
                cli_bytes(part->bytes).text);
    } else {
        fprintf(stderr, "skipped  %-28s %10s    %12s", part->name, "", "");
    }
    fprintf(stderr, part->reason ? "  %s\n" : "\n", part->reason);
}

static json_t *part_json(const mt_part *part)
{
    json_t *object = cli_json_object();
    cli_json_set(object, "part", cli_json_text(part->name));
    cli_json_set(object, "built", json_boolean(part->built));
    cli_json_set(object, "why", part->reason ? cli_json_text(part->reason) : json_null());
    cli_json_set(object, "milliseconds", cli_json_real(part->milliseconds));
    cli_json_set(object, "bytes", cli_json_integer((int64_t)part->bytes));
    return object;
}

static void print_json(const mt_context *context, const mt_part *parts, size_t count)
{
    json_t *object = cli_json_object(), *list = cli_json_array();
    for (size_t i = 0; i < count; i++) {
        cli_json_append(list, part_json(&parts[i]));
    }
    cli_json_set(object, "parts", list);
    cli_json_set(object, "parts_left_out", cli_json_integer((int64_t)mt_context_parts_left_out(context)));
    cli_json_set(object, "allocations", cli_json_integer((int64_t)mt_context_allocation_count(context)));
    cli_json_set(object, "peak_bytes", cli_json_integer((int64_t)mt_context_peak_bytes(context)));
    cli_json_print(stderr, object);
    fputc('\n', stderr);
    json_decref(object);
}

void cli_print_parts(const mt_context *context, bool json)
{
    size_t count = 0;
    const mt_part *parts = mt_context_parts(context, &count);
    uint64_t left_out = mt_context_parts_left_out(context);
    cli_progress_clear();
    if (json) {
        print_json(context, parts, count);
        return;
    }
    for (size_t i = 0; i < count; i++) {
        print_part(&parts[i]);
    }
    if (left_out) {
        fprintf(stderr, "more     %s\n", cli_counted(left_out, "part").text);
    }
    fprintf(stderr, "peak     %-28s %13s %12s  %s\n", "memory held at once", "",
            cli_bytes(mt_context_peak_bytes(context)).text,
            cli_counted(mt_context_allocation_count(context), "allocation").text);
}
