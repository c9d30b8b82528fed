// SPDX-License-Identifier: GPL-3.0-or-later
// The map of the run file, in the order in which it is written.
#include "config/sections.h"

#include "protocol/plan.h"

#include <stdio.h>
#include <string.h>

static const Option title_rows[] = {
    {"title", OPTION_TEXT, offsetof(Plan, title), 0, 0, 0, "",
     "What this run is about, for its report."},
};
const OptionTable section_title_options = {title_rows, 1, sizeof(Plan)};

static const Option method_rows[] = {
    {"method", OPTION_TEXT, 0, 0, 0, 0, "", "How time advances: the name of a method.",
     .required = 1},
};
const OptionTable section_method_options = {method_rows, 1, OPTION_TEXT_SIZE};

static const char *const spacings[] = {"linear", "logarithmic", NULL};
static const Option range_rows[] = {
    {"first", OPTION_REAL, offsetof(SweepRange, first), 0, 0, 0, "", "The first value.",
     .required = 1},
    {"last", OPTION_REAL, offsetof(SweepRange, last), 0, 0, 0, "", "The last value.",
     .required = 1},
    {"count", OPTION_INTEGER, offsetof(SweepRange, count), 0, 2, 10000, "", "How many values.",
     .required = 1},
    {"spacing", OPTION_CHOICE, offsetof(SweepRange, spacing), SPACING_LINEAR, 0, 0, "",
     "Equal differences or equal ratios.", .choices = spacings},
};
const OptionTable section_range_options = {range_rows, sizeof range_rows / sizeof *range_rows,
                                           sizeof(SweepRange)};

const char *const section_root_keys[] = {"system",    "dynamics", "protocol", "observe",
                                         "ensemble",  "output",   "sweep",    "theory",
                                         "schematic", "itt",      NULL};

static const Section before_methods[] = {
    {"", NULL, "A run file is one YAML map of sections.", &section_title_options},
    {"system", NULL, "The suspension: space, density, particles.", &system_options},
    {"system.species.NAME", NULL,
     "One kind of particles, under a name of your choice. The first species sets the unit of time "
     "by its free diffusion coefficient D0.",
     &species_options},
    {"dynamics", NULL, "How time advances in all stages that do not say otherwise.",
     &section_method_options},
};
static const Section before_observables[] = {
    {"protocol", NULL, "The stages, in order: a list of maps.", &stage_options},
    {"protocol", NULL, "When a stage ends before its time or strain, which is then the limit.",
     &stage_until_options},
    {"protocol", NULL, "What drives a stage out of equilibrium: keys of the stage itself.",
     &drive_options},
    {"protocol.dynamics", NULL,
     "Keys of dynamics for one stage; those not given are as for the whole run.", NULL},
    {"protocol.observe", NULL,
     "What is measured in the stage: a list of observables, each a name, or a map from a name to "
     "settings for this stage.",
     NULL},
    {"observe", NULL,
     "Settings of observables, used in every stage that names them: a map from names to maps.",
     NULL},
};
static const Section after_observables[] = {
    {"ensemble", NULL, "Independent samples of the same system.", &ensemble_options},
    {"output", NULL, "What is written while the run goes on.", &output_options},
    {"sweep", NULL,
     "Runs over every combination of values: a map from paths, such as system.packing_fraction, to "
     "lists or ranges. Each point runs in a folder of its own, and the quantities of all are put "
     "together, as functions of what is swept.",
     NULL},
    {"sweep.PATH", NULL, "A range of values in place of a list.", &section_range_options},
    {"theory", NULL,
     "Structure factors and mode-coupling theory of hard discs and spheres, in place of system, "
     "dynamics and protocol: a run file has one or the other.",
     &theory_options},
    {"theory.species.NAME", NULL,
     "One kind of particles of the theory, under a name of your choice. The first sets the unit of "
     "time by its free diffusion coefficient D0.",
     &theory_species_options},
    {"schematic", NULL,
     "The schematic model F12 of the glass transition, one correlator at rest or under any shear, "
     "in place of system, dynamics and protocol.",
     &schematic_options},
    {"itt", NULL,
     "Mode-coupling theory of discs under shear that begins at time 0, integrated through the "
     "transients, in place of system, dynamics and protocol. Equal discs, or a mixture if species "
     "are given.",
     &itt_options},
    {"itt.species.NAME", NULL,
     "One kind of discs, under a name of your choice. The first sets the unit of time by its free "
     "diffusion coefficient D0.",
     &theory_species_options},
};
#define COUNT(array) (sizeof(array) / sizeof *(array))

static size_t method_count(void) {
    size_t count = 0;
    while (propagator_kinds[count]) count++;
    return count;
}

static size_t observable_count(void) {
    size_t count = 0;
    while (observable_kinds[count]) count++;
    return count;
}

size_t section_count(void) {
    return COUNT(before_methods) + method_count() + COUNT(before_observables) + observable_count() +
           COUNT(after_observables);
}

static Section section_of_method(const PropagatorKind *kind) {
    return (Section){"dynamics", kind->name, kind->about, &kind->options};
}

static Section section_of_observable(const ObservableKind *kind) {
    Section section = {"", NULL, kind->about, &kind->options};
    snprintf(section.path, sizeof section.path, "observe.%s", kind->name);
    return section;
}

Section section_at(size_t index) {
    if (index < COUNT(before_methods)) return before_methods[index];
    index -= COUNT(before_methods);
    if (index < method_count()) return section_of_method(propagator_kinds[index]);
    index -= method_count();
    if (index < COUNT(before_observables)) return before_observables[index];
    index -= COUNT(before_observables);
    if (index < observable_count()) return section_of_observable(observable_kinds[index]);
    return after_observables[index - observable_count()];
}

bool section_begins(const char *path, const char *part) {
    const size_t length = strlen(part);
    return strncmp(path, part, length) == 0 && (path[length] == '\0' || path[length] == '.');
}

static bool has_key(const OptionTable *table, const char *key) {
    for (size_t i = 0; i < table->count; i++) {
        if (section_begins(table->rows[i].name, key)) return true;
    }
    return false;
}

static bool is_of_observable(const OptionTable *table) {
    for (size_t i = 0; i < observable_count(); i++) {
        if (table == &observable_kinds[i]->options) return true;
    }
    return false;
}

bool section_of_key(const char *key, const OptionTable *table, char home[SECTION_HOME_SIZE]) {
    const bool of_observable = is_of_observable(table);
    for (size_t i = 0; i < section_count(); i++) {
        const Section section = section_at(i);
        if (!section.table || !has_key(section.table, key)) continue;
        if (of_observable && is_of_observable(section.table)) continue;
        snprintf(home, SECTION_HOME_SIZE, "%s%s%s",
                 section.path[0] ? section.path : "the top level",
                 section.method ? " with method: " : "", section.method ? section.method : "");
        return true;
    }
    return false;
}

// "system.species.NAME" leads to all keys of all species.
static bool leads_to(const Section *section, const char *path) {
    const char *any_name = strstr(section->path, ".NAME");
    const size_t length = any_name ? (size_t)(any_name - section->path) : strlen(section->path);
    return length > 0 && strncmp(path, section->path, length) == 0 && path[length] == '.';
}

static bool ends_with_key(const char *path, const char *key) {
    const size_t length = strlen(path), end = strlen(key);
    return end < length && path[length - end - 1] == '.' && strcmp(path + length - end, key) == 0;
}

const char *section_unit(const char *path) {
    for (size_t i = 0; i < section_count(); i++) {
        const Section section = section_at(i);
        if (!section.table || !leads_to(&section, path)) continue;
        for (size_t k = 0; k < section.table->count; k++) {
            if (ends_with_key(path, section.table->rows[k].name))
                return section.table->rows[k].unit;
        }
    }
    return "";
}

static const struct {
    const char *word;
    const char *sentence;
} hints[] = {
    {"closure", "where the theory takes its structure from is called structure"},
    {"shear_stress", "it is called stress"},
    {"coherent_scattering", "it is called collective_scattering"},
    {"N", "the number of particles is called particles"},
    {"phi", "the packing fraction is called packing_fraction"},
    {"volume_fraction", "it is called packing_fraction"},
    {"area_fraction", "it is called packing_fraction"},
    {"rho", "the number density is called number_density"},
    {"sigma", "sizes are given as a diameter"},
    {"radius", "sizes are given as a diameter"},
    {"polydispersity", "it is written spread: {distribution: gaussian, width: 0.1}"},
    {"circle", "the shape in two dimensions is called disc"},
    {"temperature", "energies are in units of kT, so that there is no temperature to set"},
    {"dt", "there is no time step; see thermostat_interval of event-driven and step of "
           "dynamic-monte-carlo"},
    {"timestep", "there is no time step; see thermostat_interval of event-driven and step of "
                 "dynamic-monte-carlo"},
    {"time_step", "there is no time step; see thermostat_interval of event-driven and step of "
                  "dynamic-monte-carlo"},
    {"steps", "a stage lasts a time, not a number of steps"},
    {"brownian", "Brownian dynamics is the method event-driven, or dynamic-monte-carlo"},
    {"langevin", "Brownian dynamics is the method event-driven, or dynamic-monte-carlo"},
    {"dmc", "it is called dynamic-monte-carlo"},
    {"mc", "it is called monte-carlo"},
    {"rod", "the shape is called spherocylinder"},
    {"capsule", "the shape is called spherocylinder"},
    {"plate", "the shape is called platelet, and is infinitely thin"},
    {"thickness", "a platelet is infinitely thin: it has a diameter alone"},
    {"aspect_ratio", "a spherocylinder has a diameter and a length, that of the cylinder in d"},
    {"soft", "the shape is called soft-sphere"},
    {"VA", "it is called acceptance-rescaling"},
    {"VD", "it is called diffusion-matching"},
    {"S2", "it is called nematic_order"},
    {"order_parameter", "it is called nematic_order"},
    {"P2", "it is called orientation_correlation"},
    {"msd", "it is called mean_squared_displacement"},
    {"rdf", "it is called pair_distribution"},
    {"g_of_r", "it is called pair_distribution"},
};

const char *section_hint(const char *word) {
    for (size_t i = 0; i < COUNT(hints); i++) {
        if (strcmp(hints[i].word, word) == 0) return hints[i].sentence;
    }
    return NULL;
}
