#include "options.h"

#include "memory.h"
#include "nearest.h"

#include <popt.h>
#include <stdlib.h>
#include <string.h>

static bool is_end(const cli_option *option)
{
    return !option->name && !option->letter;
}

static size_t count_options(const cli_option *const *tables)
{
    size_t count = 0;
    for (; *tables; tables++) {
        for (const cli_option *option = *tables; !is_end(option); option++) {
            count++;
        }
    }
    return count;
}

/* A flag with a fixed value, "explain=measure", goes by "explain-measure" to popt, which cuts names at the sign. */
static const char *parser_name(const char *name)
{
    static const char *const joined[][2] = {{"explain=measure", "explain-measure"}};
    for (size_t i = 0; name && i < sizeof joined / sizeof *joined; i++) {
        if (strcmp(name, joined[i][0]) == 0) {
            return joined[i][1];
        }
    }
    return name;
}

static void join_values(int argument_count, const char **arguments)
{
    for (int i = 1; i < argument_count; i++) {
        if (strcmp(arguments[i], "--") == 0) {
            return;
        }
        if (strcmp(arguments[i], "--explain=measure") == 0) {
            arguments[i] = "--explain-measure";
        }
    }
}

/* popt's records for ours, each with its number counted from 1 as the value that poptGetNextOpt returns. */
static struct poptOption *make_parser_table(const cli_option *const *tables, const cli_option **by_number)
{
    struct poptOption *records = cli_allocate(count_options(tables) + 1, sizeof *records);
    int number = 0;
    for (; *tables; tables++) {
        for (const cli_option *option = *tables; !is_end(option); option++) {
            struct poptOption *record = &records[number];
            record->longName = parser_name(option->name);
            record->shortName = option->letter;
            record->argInfo = option->argument ? POPT_ARG_STRING : POPT_ARG_NONE;
            by_number[number] = option;
            record->val = ++number;
        }
    }
    return records;
}

static const char *spelling(const cli_option *option, char room[64])
{
    if (option->name) {
        snprintf(room, 64, "--%s", option->name);
    } else {
        snprintf(room, 64, "-%c", option->letter);
    }
    return room;
}

static bool store(const cli_option *option, const char *text, void *settings, char *problem, size_t problem_size)
{
    char *value = (char *)settings + option->offset;
    if (!option->parse) {
        *(bool *)value = true;
        return true;
    }
    if (option->parse(option, text, value)) {
        return true;
    }
    char room[64];
    snprintf(problem, problem_size, text ? "%s expects %s, not \"%s\"" : "%s: expected %s", spelling(option, room),
             option->expects, text);
    return false;
}

static const char *nearest_option(const char *wrong, const cli_option *const *by_number, size_t count)
{
    const char **names = cli_allocate(count + 1, sizeof *names);
    size_t name_count = 0;
    for (size_t i = 0; i < count; i++) {
        if (by_number[i]->name) {
            names[name_count++] = by_number[i]->name;
        }
    }
    const char *found = strncmp(wrong, "--", 2) == 0 ? cli_nearest(wrong + 2, names, name_count) : NULL;
    free(names);
    return found;
}

static void explain_failure(poptContext parser, int code, const cli_option *const *by_number, size_t count,
                            char *problem, size_t problem_size)
{
    const char *wrong = poptBadOption(parser, POPT_BADOPTION_NOALIAS);
    if (code == POPT_ERROR_NOARG) {
        snprintf(problem, problem_size, "%s needs a value", wrong);
    } else if (code == POPT_ERROR_UNWANTEDARG) {
        snprintf(problem, problem_size, "%.*s takes no value", (int)strcspn(wrong, "="), wrong);
    } else if (code != POPT_ERROR_BADOPT) {
        snprintf(problem, problem_size, "%s: %s", wrong, poptStrerror(code));
    } else {
        const char *nearest = nearest_option(wrong, by_number, count);
        snprintf(problem, problem_size, nearest ? "unknown option \"%s\"; did you mean --%s?" : "unknown option \"%s\"",
                 wrong, nearest);
    }
}

static void take_operands(poptContext parser, cli_arguments *out)
{
    out->operands = poptGetArgs(parser);
    while (out->operands && out->operands[out->operand_count]) {
        out->operand_count++;
    }
}

bool cli_options_parse(int argument_count, const char **arguments, const cli_option *const *tables, void *settings,
                       cli_arguments *out, char *problem, size_t problem_size)
{
    memset(out, 0, sizeof *out);
    size_t count = count_options(tables);
    const cli_option **by_number = cli_allocate(count + 1, sizeof(cli_option *));
    struct poptOption *records = make_parser_table(tables, by_number);
    join_values(argument_count, arguments);
    poptContext parser = poptGetContext(NULL, argument_count, arguments, records, 0);
    out->parser = parser;
    out->values = cli_allocate((size_t)argument_count + 1, sizeof *out->values);

    bool fine = true;
    int number = 0;
    while (fine && (number = poptGetNextOpt(parser)) > 0) {
        char *text = poptGetOptArg(parser);
        if (text) {
            out->values[out->value_count++] = text;
        }
        fine = store(by_number[number - 1], text, settings, problem, problem_size);
    }
    if (fine && number < -1) {
        explain_failure(parser, number, by_number, count, problem, problem_size);
        fine = false;
    }
    if (fine) {
        take_operands(parser, out);
    }
    free(records);
    free(by_number);
    return fine;
}

void cli_arguments_release(cli_arguments *arguments)
{
    for (size_t i = 0; i < arguments->value_count; i++) {
        free(arguments->values[i]);
    }
    free(arguments->values);
    poptFreeContext(arguments->parser);
    memset(arguments, 0, sizeof *arguments);
}
