// SPDX-License-Identifier: GPL-3.0-or-later
// What words mean: keys from the option tables, methods, observables, shapes, units. The manual is
// the same said of all keys.
#include "config/config.h"

#include "base/nearest.h"
#include "base/number.h"
#include "config/options.h"
#include "config/sections.h"
#include "results/results.h"

#include <string.h>

static const struct {
    const char *name;
    const char *about;
} units[] = {
    {"d", "The unit of length: the diameter of the first species, where that is given as 1."},
    {"kT", "The unit of energy: Boltzmann's constant times the temperature."},
    {"m", "The unit of mass: the mass of the first species, where that is given as 1."},
    {"D0", "Free diffusion coefficient of the first species, in the dilute limit."},
    {"d^2/D0", "The unit of time of Brownian dynamics: in it a free particle of the first species "
               "diffuses about its own diameter: <x^2> = 2 d^2 in each direction."},
    {"D0/d^2", "The unit of rates: one over the unit of time of Brownian dynamics."},
    {"d sqrt(m/kT)", "The unit of time of flight: in it a free particle of mass m flies about d."},
    {"kT/d^2", "The unit of pressure in two dimensions."},
    {"kT/d^3", "The unit of pressure in three dimensions."},
    {"s", "Wall-clock seconds; durations are written with s, min, h or d, as in 10 min."},
};
#define COUNT(array) (sizeof(array) / sizeof *(array))
enum { WORDS_MOST = 512, LABEL_SIZE = 128 };

typedef struct Label {
    char text[LABEL_SIZE];
} Label;

// "system.box.aspect"
static Label key_path(const Section *section, const Option *row) {
    Label path;
    snprintf(path.text, sizeof path.text, "%s%s%s", section->path, section->path[0] ? "." : "",
             row->name);
    return path;
}

static void write_default(const Option *row, Text *text) {
    char number[NUMBER_SIZE];
    if (row->required)
        text_put(text, "must be given");
    else if (row->fallback_text)
        text_add(text, "default %s", row->fallback_text);
    else if (row->type == OPTION_CHOICE)
        text_add(text, "default %s", row->choices[(size_t)row->fallback]);
    else if (row->type == OPTION_BOOLEAN)
        text_add(text, "default %s", row->fallback != 0 ? "true" : "false");
    else if (row->type == OPTION_REALS || row->type == OPTION_CHOICES || row->type == OPTION_TEXT)
        text_put(text, "default empty");
    else
        text_add(text, "default %s%s", number_write(number, row->fallback),
                 row->type == OPTION_DURATION ? " s" : "");
}

static void explain_row(const Section *section, const Option *row, FILE *out) {
    Text type = {0}, fallback = {0};
    option_describe(row, &type);
    write_default(row, &fallback);
    fprintf(out, "%s", key_path(section, row).text);
    if (section->method) fprintf(out, "  (with method: %s)", section->method);
    fprintf(out, "\n  %s\n  %s; %s\n", row->about, text_words(&type), text_words(&fallback));
    text_free(&type);
    text_free(&fallback);
}

static void explain_section(const Section *section, FILE *out) {
    if (section->method)
        fprintf(out, "method: %s\n  %s\n", section->method, section->about);
    else
        fprintf(out, "%s\n  %s\n", section->path[0] ? section->path : "the run file",
                section->about);
    for (size_t i = 0; section->table && i < section->table->count; i++) {
        const Option *row = &section->table->rows[i];
        fprintf(out, "    %-40s %s\n", key_path(section, row).text, row->about);
    }
}

// Whether the words between the dots of `path` hold those of `word`: "box.aspect" and "box" lie in
// "system.box.aspect".
static bool lies_in(const char *path, const char *word) {
    const size_t length = strlen(word);
    for (const char *part = path; length > 0 && *part; part++) {
        const char *after = part + length;
        const bool begins = part == path || part[-1] == '.';
        if (begins && strncmp(part, word, length) == 0 && (*after == '.' || *after == '\0'))
            return true;
    }
    return false;
}

// The section itself is asked for by the end of its path, "NAME" standing for any name.
static bool names_section(const Section *section, const char *word) {
    const bool all_methods = strcmp(word, "dynamics") == 0 || strcmp(word, "method") == 0;
    if (section->method) return all_methods || strcmp(section->method, word) == 0;
    char path[SECTION_PATH_SIZE];
    snprintf(path, sizeof path, "%s", section->path);
    char *any_name = strstr(path, ".NAME");
    if (any_name) *any_name = '\0';
    const size_t length = strlen(path), end = strlen(word);
    return end <= length && strcmp(path + length - end, word) == 0 && lies_in(path, word);
}

static bool explain_in_section(const Section *section, const char *word, FILE *out) {
    if (names_section(section, word)) {
        explain_section(section, out);
        return true;
    }
    bool found = false;
    for (size_t i = 0; section->table && i < section->table->count; i++) {
        const Option *row = &section->table->rows[i];
        const bool by_path = strlen(word) > strlen(section->path) &&
                             section_begins(key_path(section, row).text, word);
        if (!by_path && !lies_in(row->name, word)) continue;
        explain_row(section, row, out);
        found = true;
    }
    return found;
}

static bool explain_shape(const char *word, FILE *out) {
    for (int shape = 0; shape < SHAPES; shape++) {
        if (strcmp(shape_names[shape], word) != 0) continue;
        fprintf(out, "shape: %s\n  A %s body in %d dimensions.\n", word,
                shape_is_hard((ShapeKind)shape) ? "hard" : "soft",
                shape_dimension((ShapeKind)shape));
        return true;
    }
    return false;
}

static bool explain_unit(const char *word, FILE *out) {
    for (size_t i = 0; i < COUNT(units); i++) {
        if (strcmp(units[i].name, word) != 0) continue;
        fprintf(out, "unit %s\n  %s\n", word, units[i].about);
        return true;
    }
    return false;
}

// "A series among the results, in d^2, from mean_squared_displacement."
static void explain_meaning(const char *word, const ResultMeaning *meaning, const char *of,
                            const char *what, FILE *out) {
    fprintf(out, "%s\n  %s\n  A %s among the results, %s%s, from %s.\n", word, meaning->about, what,
            meaning->unit ? "in " : "without unit", meaning->unit ? meaning->unit : "", of);
}

// Of the results: "long_time_diffusion_small" as well as "long_time_diffusion"; a number, a series
// or both.
static bool explain_quantity(const char *name, FILE *out) {
    const ResultMeaning *number = result_meaning(name), *series = result_series_meaning(name);
    char source[RESULT_NAME];
    if (number) explain_meaning(name, number, number->of, "number", out);
    if (series) {
        const bool made = result_series_source(source, name, series);
        explain_meaning(name, series, made ? source : series->of, "series", out);
    }
    return number || series;
}

// The last part that is a result of "quiescent/pressure" or "stages/quiescent/pressure/mean", as
// `perrin show` and results.h5 have them.
static bool explain_path(const char *path, FILE *out) {
    char left[2 * LABEL_SIZE];
    snprintf(left, sizeof left, "%s", path);
    for (char *slash; (slash = strrchr(left, '/')); *slash = '\0') {
        if (explain_quantity(slash + 1, out)) return true;
    }
    return false;
}

static void explain_all(FILE *out) {
    for (size_t s = 0; s < section_count(); s++) {
        const Section section = section_at(s);
        explain_section(&section, out);
    }
    fprintf(out, "units\n");
    for (size_t i = 0; i < COUNT(units); i++) {
        fprintf(out, "    %-14s %s\n", units[i].name, units[i].about);
    }
}

// The last part of a path, by which a key is usually asked for.
static const char *last_part(const char *path) {
    const char *dot = strrchr(path, '.');
    return dot ? dot + 1 : path;
}

// The observable whose results begin with its name, as pressure_drift does; NULL if none.
static const ObservableKind *observable_of_result(const char *name) {
    const ObservableKind *longest = NULL;
    for (size_t i = 0; observable_kinds[i]; i++) {
        const char *kind = observable_kinds[i]->name;
        const bool begins = strncmp(name, kind, strlen(kind)) == 0;
        if (begins && (!longest || strlen(kind) > strlen(longest->name)))
            longest = observable_kinds[i];
    }
    return longest;
}

// The keys, names and results that one may have meant; a result's name without its *.
static size_t words_to_ask(const char *words[WORDS_MOST], char results[WORDS_MOST][RESULT_NAME]) {
    size_t count = 0;
    for (size_t s = 0; s < section_count(); s++) {
        const Section section = section_at(s);
        for (size_t i = 0; section.table && i < section.table->count && count < WORDS_MOST; i++)
            words[count++] = last_part(section.table->rows[i].name);
    }
    for (size_t i = 0; observable_kinds[i] && count < WORDS_MOST; i++)
        words[count++] = observable_kinds[i]->name;
    for (size_t i = 0; propagator_kinds[i] && count < WORDS_MOST; i++)
        words[count++] = propagator_kinds[i]->name;
    for (size_t i = 0; i < SHAPES && count < WORDS_MOST; i++) words[count++] = shape_names[i];
    for (size_t i = 0; result_meaning_at(i) && count < WORDS_MOST; i++) {
        const char *name = result_meaning_at(i)->name;
        snprintf(results[count], RESULT_NAME, "%.*s", (int)strcspn(name, "*"), name);
        words[count] = results[count];
        count++;
    }
    for (size_t i = 0; result_series_meaning_at(i) && count < WORDS_MOST; i++) {
        if (result_series_meaning_at(i)->of) words[count++] = result_series_meaning_at(i)->name;
    }
    return count;
}

static Status fail_unknown(const char *word) {
    const char *words[WORDS_MOST];
    char results[WORDS_MOST][RESULT_NAME];
    const size_t count = words_to_ask(words, results);
    const ObservableKind *kind = observable_of_result(word);
    if (kind)
        return status_fail(
            BAD_USAGE,
            "'%s' is no key; if it is a result, of %s, 'perrin show DIR %s' says what "
            "it is",
            word, kind->name, word);
    const size_t nearest = nearest_word(word, words, count);
    if (nearest < count)
        return status_fail(BAD_USAGE, "'%s' is unknown; did you mean '%s'?", word, words[nearest]);
    return status_fail(
        BAD_USAGE,
        "'%s' is unknown; 'perrin explain' lists what there is, 'perrin show DIR' says "
        "what results are",
        word);
}

// "quiescent/pressure_drift" and "stages/quiescent/pressure/mean", as `perrin show` and results.h5
// have it. What a number means stands beside it in the file, since it may depend on the run.
static Status explain_result(const char *path, FILE *out) {
    const ObservableKind *kind = NULL;
    for (const char *part = path; part && !kind; part = strchr(part, '/')) {
        part += *part == '/';
        kind = observable_of_result(part);
    }
    if (!kind) return fail_unknown(path);
    fprintf(out,
            "%s\n  A result of %s; 'perrin show DIR' says what it is, with its value and unit.\n",
            path, kind->name);
    return config_explain(kind->name, out);
}

Status config_explain(const char *word, FILE *out) {
    if (!word) {
        explain_all(out);
        return OK;
    }
    if (strchr(word, '/'))
        return explain_path(word, out) || explain_unit(word, out) ? OK : explain_result(word, out);
    bool found = explain_quantity(word, out);
    found = explain_shape(word, out) || found;
    found = explain_unit(word, out) || found;
    for (size_t s = 0; s < section_count(); s++) {
        const Section section = section_at(s);
        found = explain_in_section(&section, word, out) || found;
    }
    if (found) return OK;
    const char *hint = section_hint(word);
    return hint ? status_fail(BAD_USAGE, "%s: %s", word, hint) : fail_unknown(word);
}

// A bar would end the cell of a table.
static void write_cell(const char *words, FILE *out) {
    fputc(' ', out);
    for (const char *c = words; *c; c++) fprintf(out, *c == '|' ? "\\%c" : "%c", *c);
    fputs(" |", out);
}

static void manual_row(const Option *row, FILE *out) {
    Text type = {0}, fallback = {0};
    option_describe(row, &type);
    write_default(row, &fallback);
    fprintf(out, "| `%s` |", row->name);
    write_cell(text_words(&type), out);
    write_cell(text_words(&fallback), out);
    write_cell(row->about, out);
    fputs("\n", out);
    text_free(&type);
    text_free(&fallback);
}

static void manual_section(const Section *section, FILE *out) {
    if (section->method)
        fprintf(out, "\n### dynamics, `method: %s`\n\n%s\n", section->method, section->about);
    else
        fprintf(out, "\n## %s\n\n%s\n", section->path[0] ? section->path : "The top of the file",
                section->about);
    if (!section->table || section->table->count == 0) return;
    fputs("\n| key | value | default | meaning |\n|---|---|---|---|\n", out);
    for (size_t i = 0; i < section->table->count; i++) manual_row(&section->table->rows[i], out);
}

void config_manual(FILE *out) {
    fputs("# The run file\n\n"
          "Written by `perrin explain --manual` from the tables that read the run file.\n\n"
          "A run file is one YAML document, UTF-8, at most 1 MiB, without tabs, anchors, aliases "
          "and tags.\nA key with a dot is a map in a map: `box.aspect` is written `box: {aspect: "
          "[1, 1]}`.\nLengths are in units of d, energies in kT, times of Brownian stages in "
          "d^2/D0. `--set KEY=VALUE`\nreplaces a value; KEY is a path such as `system.particles` "
          "or, by the name of a stage,\n`protocol.quiescent.time`.\n",
          out);
    for (size_t s = 0; s < section_count(); s++) {
        const Section section = section_at(s);
        manual_section(&section, out);
    }
    fputs("\n## Shapes\n\n| shape | dimension | body axis | hard |\n|---|---|---|---|\n", out);
    for (int shape = 0; shape < SHAPES; shape++)
        fprintf(out, "| `%s` | %d | %s | %s |\n", shape_names[shape],
                shape_dimension((ShapeKind)shape),
                shape_is_oriented((ShapeKind)shape) ? "yes" : "no",
                shape_is_hard((ShapeKind)shape) ? "yes" : "no");
    fputs("\n## Units\n\n| unit | meaning |\n|---|---|\n", out);
    for (size_t i = 0; i < COUNT(units); i++)
        fprintf(out, "| %s | %s |\n", units[i].name, units[i].about);
}
