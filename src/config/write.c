// SPDX-License-Identifier: GPL-3.0-or-later
// A run file from a Plan: every value written out, but those of drives that a stage has not.
// Settings of observables stand in the stages, so that `observe:` at the top is not needed.
#include "config/config.h"

#include "base/memory.h"
#include "config/options.h"
#include "config/sections.h"

#include <string.h>

enum { STEP = 2 }; // blanks per level

static void indent(Text *text, size_t blanks) {
    text_add(text, "%*s", (int)blanks, "");
}

static void write_row(const Option *row, const char *name, const void *settings, size_t blanks,
                      Text *text) {
    indent(text, blanks);
    text_add(text, "%s: ", name);
    option_write(row, settings, text);
    const bool commented = row->unit[0] != '\0' && row->type != OPTION_DURATION;
    text_add(text, commented ? " # in %s\n" : "\n", row->unit);
}

// Whether a row at or below the key of `row` has another value than it has without being given.
static bool is_given(const OptionTable *table, const Option *row, const void *settings) {
    const size_t length = strcspn(row->name, ".");
    for (size_t i = 0; i < table->count; i++) {
        const char *name = table->rows[i].name;
        if (strncmp(name, row->name, length) != 0 || (name[length] && name[length] != '.'))
            continue;
        if (!option_is_default(&table->rows[i], settings)) return true;
    }
    return false;
}

// Whether a row before this one begins with the same `length` letters.
static bool came_before(const OptionTable *table, size_t index, size_t length) {
    for (size_t i = 0; i < index; i++) {
        if (strncmp(table->rows[i].name, table->rows[index].name, length) == 0) return true;
    }
    return false;
}

// The first row below this one, if it is given as a map and not as a word.
static const Option *map_of(const OptionTable *table, const Option *row, const void *settings) {
    const Option *first = option_may_be_map(table, row);
    return first && ((const char *)settings)[first->offset] != '\0' ? first : NULL;
}

// Whether the first `length` letters of `path` are a row of their own.
static bool is_word(const OptionTable *table, const char *path, size_t length) {
    for (size_t i = 0; i < table->count; i++) {
        const char *name = table->rows[i].name;
        if (strlen(name) == length && strncmp(name, path, length) == 0) return true;
    }
    return false;
}

// The rows below the first `prefix` letters of row `first`: those with a further dot are a map.
static void write_level(const OptionTable *table, const char *but, const void *settings,
                        size_t first, size_t prefix, size_t blanks, Text *text) {
    for (size_t i = first; i < table->count; i++) {
        const char *path = table->rows[i].name, *name = path + prefix;
        if (strncmp(path, table->rows[first].name, prefix) != 0) continue;
        if (but && strcmp(path, but) == 0) continue;
        const Option *map = map_of(table, &table->rows[i], settings);
        const char *dot = strchr(name, '.');
        if (!dot && !map) {
            write_row(&table->rows[i], name, settings, blanks, text);
            continue;
        }
        const size_t letters = map ? strlen(name) : (size_t)(dot - name);
        const size_t below = (size_t)(name - path) + letters + 1;
        if (!map && (came_before(table, i, below) || is_word(table, path, below - 1))) continue;
        indent(text, blanks);
        text_add(text, "%.*s:\n", (int)letters, name);
        write_level(table, but, settings, map ? (size_t)(map - table->rows) : i, below,
                    blanks + STEP, text);
    }
}

// All rows but one that is not given; NULL for `but`: all.
static void write_table(const OptionTable *table, const char *but, const void *settings,
                        size_t blanks, Text *text) {
    write_level(table, but, settings, 0, 0, blanks, text);
}

static void write_system(const System *system, Text *text) {
    text_add(text, "\nsystem:\n");
    write_table(&system_options,
                system->packing_fraction > 0 ? "number_density" : "packing_fraction", system, STEP,
                text);
    text_add(text, "  species:\n");
    for (size_t s = 0; s < system->species_count; s++) {
        text_add(text, "    %s:\n", system->species[s].name);
        write_table(&species_options, NULL, &system->species[s], 3 * STEP, text);
    }
}

static void write_dynamics(const Dynamics *dynamics, size_t blanks, Text *text) {
    indent(text, blanks);
    text_add(text, "dynamics:\n");
    indent(text, blanks + STEP);
    text_add(text, "method: %s\n", dynamics->kind->name);
    write_table(&dynamics->kind->options, NULL, &dynamics->settings, blanks + STEP, text);
}

static void write_observation(const Observation *observation, Text *text) {
    const OptionTable *table = &observation->kind->options;
    text_add(text, "      - %s%s\n", observation->kind->name, table->count ? ":" : "");
    write_table(table, NULL, &observation->settings, 5 * STEP, text);
}

// The keys that are given alone, each map whole: of what drives a stage, one thing at most.
static void write_given(const OptionTable *table, const void *settings, Text *text) {
    enum { ROWS_MOST = 32 };
    Option rows[ROWS_MOST];
    size_t count = 0;
    ASSERT(table->count <= ROWS_MOST);
    for (size_t i = 0; i < table->count; i++) {
        if (is_given(table, &table->rows[i], settings)) rows[count++] = table->rows[i];
    }
    const OptionTable given = {rows, count, table->size};
    write_table(&given, NULL, settings, 2 * STEP, text);
}

// The unit of a stage's time depends on its method, which the table cannot know.
static void write_stage(const Stage *stage, Text *text) {
    for (size_t i = 0; i < stage_options.count; i++) {
        const Option *row = &stage_options.rows[i];
        if (i > 0 && option_is_default(row, stage)) continue; // it ends at a time or at a strain
        text_add(text, "%s%s: ", i == 0 ? "  - " : "    ", row->name);
        option_write(row, stage, text);
        if (strcmp(row->name, "time") == 0)
            text_add(text, " # in %s", stage->dynamics.kind->time_unit);
        text_add(text, "\n");
    }
    write_given(&stage_until_options, stage, text);
    write_given(&drive_options, &stage->drive, text);
    write_dynamics(&stage->dynamics, 2 * STEP, text);
    text_add(text, "    observe:%s\n", stage->observation_count ? "" : " []");
    for (size_t k = 0; k < stage->observation_count; k++) {
        write_observation(&stage->observations[k], text);
    }
}

static void write_theory_species(const TheorySpecies *species, size_t count, Text *text) {
    if (count > 0) text_add(text, "  species:\n");
    for (size_t a = 0; a < count; a++) {
        text_add(text, "    %s:\n", species[a].name);
        write_table(&theory_species_options, NULL, &species[a], 3 * STEP, text);
    }
}

static void write_theory(const TheoryPlan *theory, Text *text) {
    text_add(text, "\ntheory:\n");
    write_table(&theory_options, NULL, theory, STEP, text);
    write_theory_species(theory->species, theory->species_count, text);
}

static void write_itt(const IttPlan *itt, Text *text) {
    text_add(text, "\nitt:\n");
    write_table(&itt_options, NULL, itt, STEP, text);
    write_theory_species(itt->species, itt->species_count, text);
}

static void write_schematic(const SchematicPlan *schematic, Text *text) {
    text_add(text, "\nschematic:\n");
    write_table(&schematic_options, NULL, schematic, STEP, text);
}

static void write_plan(const Plan *plan, Text *text) {
    text_add(text, "# A run file with every value written out; `perrin explain KEY` says more.\n");
    write_table(&section_title_options, NULL, plan, 0, text);
    if (plan->itt.given) {
        write_itt(&plan->itt, text);
        return;
    }
    if (plan->schematic.given) {
        write_schematic(&plan->schematic, text);
        return;
    }
    if (plan_is_theory(plan)) {
        write_theory(&plan->theory, text);
        return;
    }
    write_system(&plan->system, text);
    text_add(text, "\n");
    write_dynamics(&plan->dynamics, 0, text);
    text_add(text, "\nprotocol:\n");
    for (size_t s = 0; s < plan->stage_count; s++) write_stage(&plan->stages[s], text);
    text_add(text, "\nensemble:\n");
    write_table(&ensemble_options, NULL, &plan->ensemble, STEP, text);
    text_add(text, "\noutput:\n");
    write_table(&output_options, NULL, &plan->output, STEP, text);
}

Status config_write(const Plan *plan, char **out) {
    Text text = {0};
    write_plan(plan, &text);
    const Status status = text_status(&text);
    *out = status == OK ? text.bytes : NULL;
    if (status != OK) text_free(&text);
    return status;
}
