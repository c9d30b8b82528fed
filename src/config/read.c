// SPDX-License-Identifier: GPL-3.0-or-later
// A Plan from a run file: each section of the tree goes through its option tables into the plan.
// What can only be judged when all is read (density, stages, observables) is judged in judge.c.
#include "config/config.h"

#include "base/memory.h"
#include "base/nearest.h"
#include "config/faults.h"
#include "config/judge.h"
#include "config/options.h"
#include "config/points.h"
#include "config/rate_table.h"
#include "config/sections.h"
#include "config/tree.h"

#include <string.h>

#define COUNT(array) (sizeof(array) / sizeof *(array))
enum { NAMES_MOST = 64 };
static const char SPECIES_ARE[] = "a map from names to particles";

// The nearest of the names of methods or observables, or a list of all, for a sentence.
static Status fail_unknown_name(const Node *node, const char *what, const char *word,
                                const char *const *names, size_t count) {
    char shown[QUOTE_SIZE];
    tree_quote(shown, word);
    const char *hint = section_hint(word);
    if (hint) return tree_fail(node, "%s: %s", shown, hint);
    const size_t nearest = nearest_word(word, names, count);
    if (nearest < count)
        return tree_fail(node, "unknown %s '%s'; did you mean %s?", what, shown, names[nearest]);
    Text list = {0};
    for (size_t i = 0; i < count; i++) text_add(&list, "%s%s", i ? ", " : "", names[i]);
    const Status status =
        tree_fail(node, "unknown %s '%s'; expected one of %s", what, shown, text_words(&list));
    text_free(&list);
    return status;
}

static Status find_method(const Node *node, const char *word, const PropagatorKind **kind) {
    *kind = propagator_kind_named(word);
    if (*kind) return OK;
    const char *names[NAMES_MOST];
    size_t count = 0;
    for (; propagator_kinds[count]; count++) names[count] = propagator_kinds[count]->name;
    return fail_unknown_name(node, "method", word, names, count);
}

static Status find_observable(const Node *node, const char *word, const ObservableKind **kind) {
    *kind = observable_kind_named(word);
    if (*kind) return OK;
    const char *names[NAMES_MOST];
    size_t count = 0;
    for (; observable_kinds[count]; count++) names[count] = observable_kinds[count]->name;
    return fail_unknown_name(node, "observable", word, names, count);
}

// Names become groups of HDF5 files and parts of results' names.
static Status check_name(const Node *node, const char *what, const char *name, size_t size) {
    static const char letters[] =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
    char shown[QUOTE_SIZE];
    const size_t length = strlen(name);
    if (length == 0 || strspn(name, letters) != length)
        return tree_fail(node, "'%s' cannot name a %s; use letters, digits, - and _",
                         tree_quote(shown, name), what);
    if (length >= size)
        return tree_fail(node, "the name '%s' of a %s has %zu letters; at most %zu have room",
                         tree_quote(shown, name), what, length, size - 1);
    return OK;
}

static Status read_section(const char *name, const OptionTable *table, void *settings,
                           const char *const *others, const Node *map, bool complete) {
    const OptionTarget target = {table, settings};
    const OptionMap options = {name, &target, 1, others};
    return options_read(&options, map, complete);
}

static Status check_there(const Node *map, const char *key, const char *what) {
    return tree_find(map, key) ? OK : tree_fail(map, "there is no '%s': %s", key, what);
}

static Status read_one_species(const Node *node, Species *species) {
    TRY(check_name(node, "species", node->key, NAME_SIZE));
    TRY(options_default(&species_options, species));
    strcpy(species->name, node->key);
    char name[NAME_SIZE + sizeof "species ''"];
    snprintf(name, sizeof name, "species '%s'", species->name);
    return read_section(name, &species_options, species, NULL, node, true);
}

// The one that has left out its fraction is what the others leave.
static Status fill_fraction(const Node *map, System *system) {
    const Node *open = NULL;
    Species *rest = NULL, *species = system->species;
    double sum = 0;
    for (const Node *node = map->first; node; node = node->next, species++) {
        if (species->count > 0) continue;
        sum += species->fraction;
        if (tree_find(node, "fraction")) continue;
        if (open)
            return tree_fail(node,
                             "species '%s' and '%s' have no fraction; one at most may leave "
                             "it out",
                             open->key, node->key);
        open = node;
        rest = species;
    }
    if (!open) return OK;
    if (!(sum < 1))
        return tree_fail(open, "species '%s' has no fraction, and those of the others add to %.10g",
                         open->key, sum);
    rest->fraction = 1 - sum;
    return OK;
}

static Status read_species(const Node *map, System *system) {
    if (map->kind != NODE_MAP || map->count == 0)
        return tree_fail(map, "species is a map from names to particles, such as "
                              "{small: {shape: disc, fraction: 1}}");
    if (map->count > SPECIES_MOST)
        return tree_fail(map, "%zu species; at most %d have room", map->count, SPECIES_MOST);
    Faults faults = {0};
    for (const Node *node = map->first; node; node = node->next) {
        Species *species = &system->species[system->species_count++];
        TRY(faults_keep(&faults, read_one_species(node, species)));
    }
    TRY(faults_tell(&faults));
    return fill_fraction(map, system);
}

static Status read_system(const Node *map, System *system) {
    static const char *const others[] = {"species", NULL};
    Faults faults = {0};
    const Node *species = tree_find(map, "species");
    TRY(options_default(&system_options, system));
    TRY(faults_keep(&faults, read_section("system", &system_options, system, others, map, true)));
    if (faults.count == 0) TRY(faults_keep(&faults, check_there(map, "species", SPECIES_ARE)));
    if (species) TRY(faults_keep(&faults, read_species(species, system)));
    return faults_tell(&faults);
}

// Keys over what `dynamics` holds already; another method than before starts from its defaults.
static Status read_dynamics(const Node *map, const char *name, Dynamics *dynamics) {
    char word[OPTION_TEXT_SIZE] = "";
    const PropagatorKind *kind = dynamics->kind;
    const Node *method = tree_find(map, "method");
    if (!kind && !method && map->kind == NODE_MAP)
        return tree_fail(map, "dynamics needs 'method', such as event-driven");
    if (method) {
        TRY(option_read(option_named(&section_method_options, "method"), method, word));
        TRY(find_method(method, word, &kind));
    }
    const bool complete = kind != dynamics->kind; // another method, of which all must be given
    if (kind && complete) {
        *dynamics = (Dynamics){.kind = kind};
        TRY(options_default(&kind->options, &dynamics->settings));
    }
    const OptionTarget targets[] = {{&section_method_options, word},
                                    {kind ? &kind->options : NULL, &dynamics->settings}};
    const OptionMap options = {name, targets, kind ? COUNT(targets) : 1, NULL};
    return options_read(&options, map, complete);
}

static Status read_observable_settings(const Node *node, const ObservableKind *kind,
                                       Settings *settings) {
    return read_section(kind->name, &kind->options, settings, NULL, node, false);
}

// Defaults of the kind, then those of the file's `observe:`.
static Status default_observation(const Node *root, const ObservableKind *kind,
                                  Settings *settings) {
    TRY(options_default(&kind->options, settings));
    const Node *observe = tree_find(root, "observe");
    const Node *node = observe ? tree_find(observe, kind->name) : NULL;
    return node ? read_observable_settings(node, kind, settings) : OK;
}

static Status check_observable(const Node *node) {
    const ObservableKind *kind = NULL;
    Settings settings = {{0}};
    TRY(find_observable(node, node->key, &kind));
    TRY(options_default(&kind->options, &settings));
    return read_observable_settings(node, kind, &settings);
}

// Also those settings that no stage uses must be right.
static Status check_observe(const Node *root) {
    const Node *observe = tree_find(root, "observe");
    if (!observe) return OK;
    if (observe->kind != NODE_MAP)
        return tree_fail(observe, "observe is a map from observables to settings here; a stage's "
                                  "own observe is a list");
    Faults faults = {0};
    for (const Node *node = observe->first; node; node = node->next) {
        TRY(faults_keep(&faults, check_observable(node)));
    }
    return faults_tell(&faults);
}

// `pressure` or `pressure: {every: 1}`.
static Status read_observation(const Node *root, const Node *node, Observation *observation) {
    const bool with_settings = node->kind == NODE_MAP && node->count == 1;
    if (node->kind != NODE_WORD && !with_settings)
        return tree_fail(node, "an entry of observe is an observable, or one observable with "
                               "settings such as pressure: {...}");
    const char *word = with_settings ? node->first->key : node->text;
    TRY(find_observable(node, word, &observation->kind));
    TRY(default_observation(root, observation->kind, &observation->settings));
    if (!with_settings) return OK;
    return read_observable_settings(node->first, observation->kind, &observation->settings);
}

static Status add_observation(const Node *root, const Node *node, Stage *stage) {
    Observation *now = &stage->observations[stage->observation_count];
    TRY(read_observation(root, node, now));
    for (const Observation *other = stage->observations; other < now; other++) {
        if (other->kind == now->kind)
            return tree_fail(node, "%s is there twice in stage '%s'", now->kind->name, stage->name);
    }
    stage->observation_count++;
    return OK;
}

static Status read_observations(const Node *root, const Node *list, Stage *stage) {
    if (list->kind != NODE_LIST)
        return tree_fail(list, "observe is a list of observables in a stage, such as [pressure]");
    if (list->count > OBSERVATIONS_MOST)
        return tree_fail(list, "%zu observables; at most %d have room", list->count,
                         OBSERVATIONS_MOST);
    Faults faults = {0};
    for (const Node *node = list->first; node; node = node->next) {
        TRY(faults_keep(&faults, add_observation(root, node, stage)));
    }
    return faults_tell(&faults);
}

static Status read_stage_keys(const Node *node, Stage *stage) {
    static const char *const others[] = {"dynamics", "observe", NULL};
    char name[OPTION_TEXT_SIZE + sizeof "stage ''"] = "a stage";
    TRY(options_default(&stage_options, stage));
    TRY(options_default(&stage_until_options, stage));
    TRY(options_default(&drive_options, &stage->drive));
    const Node *label = tree_find(node, "stage");
    if (label) {
        TRY(option_read(option_named(&stage_options, "stage"), label, stage));
        TRY(check_name(label, "stage", stage->name, NAME_SIZE));
        snprintf(name, sizeof name, "stage '%s'", stage->name);
    }
    const OptionTarget targets[] = {
        {&stage_options, stage}, {&stage_until_options, stage}, {&drive_options, &stage->drive}};
    const OptionMap options = {name, targets, COUNT(targets), others};
    TRY(options_read(&options, node, true));
    if (!stage->drive.flow.table.file[0]) return OK;
    return rate_table_read(&stage->drive.flow, tree_find(node, "shear_table"));
}

// Keys over those of the whole run. If these name no known method, that has been told, and what the
// stage changes of it cannot be judged.
static Status read_stage_dynamics(const Node *node, const Dynamics *dynamics, Stage *stage) {
    const Node *own = tree_find(node, "dynamics");
    stage->dynamics = *dynamics;
    if (!own || (!dynamics->kind && !tree_find(own, "method"))) return OK;
    return read_dynamics(own, "dynamics", &stage->dynamics);
}

static Status read_stage(const Node *root, const Node *node, const Dynamics *dynamics,
                         Stage *stage) {
    Faults faults = {0};
    const Node *observe = tree_find(node, "observe");
    TRY(faults_keep(&faults, read_stage_keys(node, stage)));
    TRY(faults_keep(&faults, read_stage_dynamics(node, dynamics, stage)));
    if (observe) TRY(faults_keep(&faults, read_observations(root, observe, stage)));
    return faults_tell(&faults);
}

static Status read_protocol(const Node *root, Plan *plan) {
    const Node *list = tree_find(root, "protocol");
    if (list->kind != NODE_LIST || list->count == 0)
        return tree_fail(list, "protocol is a list of stages, such as - {stage: quiescent, "
                               "time: 1, observe: [pressure]}");
    if (list->count > STAGES_MOST)
        return tree_fail(list, "%zu stages; at most %d have room", list->count, STAGES_MOST);
    Faults faults = {0};
    for (const Node *node = list->first; node; node = node->next) {
        Stage *stage = &plan->stages[plan->stage_count++];
        TRY(faults_keep(&faults, read_stage(root, node, &plan->dynamics, stage)));
    }
    return faults_tell(&faults);
}

static Status read_optional(const Node *root, const char *name, const OptionTable *table,
                            void *settings) {
    TRY(options_default(table, settings));
    const Node *map = tree_find(root, name);
    return map ? read_section(name, table, settings, NULL, map, true) : OK;
}

static Status read_theory_species(const Node *node, TheorySpecies *species) {
    TRY(check_name(node, "species", node->key, THEORY_NAME_SIZE));
    TRY(options_default(&theory_species_options, species));
    strcpy(species->name, node->key);
    char name[THEORY_NAME_SIZE + sizeof "species ''"];
    snprintf(name, sizeof name, "species '%s'", species->name);
    return read_section(name, &theory_species_options, species, NULL, node, true);
}

static Status read_theory_mixture(const Node *map, TheorySpecies *species, size_t *count) {
    if (map->kind != NODE_MAP || map->count == 0)
        return tree_fail(map, "species is a map from names to particles, such as "
                              "{small: {diameter: 1, fraction: 1}}");
    if (map->count > MIXTURE_SPECIES_MOST)
        return tree_fail(map, "%zu species; at most %d have room", map->count,
                         MIXTURE_SPECIES_MOST);
    Faults faults = {0};
    for (const Node *node = map->first; node; node = node->next)
        TRY(faults_keep(&faults, read_theory_species(node, &species[(*count)++])));
    return faults_tell(&faults);
}

// A run of a theory has no other section.
static Status check_alone(const Node *root, const char *section) {
    const char *const allowed[] = {"title", "sweep", section};
    Faults faults = {0};
    for (const Node *node = root->first; node; node = node->next) {
        bool known = false;
        for (size_t i = 0; i < COUNT(allowed); i++) known = known || !strcmp(node->key, allowed[i]);
        if (known) continue;
        TRY(faults_keep(&faults,
                        tree_fail(node, "a run file with '%s' has no '%s'", section, node->key)));
    }
    return faults_tell(&faults);
}

static Status read_theory(const Node *map, Plan *plan) {
    static const char *const others[] = {"species", NULL};
    TheoryPlan *theory = &plan->theory;
    const Node *species = tree_find(map, "species");
    Faults faults = {0};
    TRY(options_default(&theory_options, theory));
    TRY(options_default(&output_options, &plan->output)); // how often there is a checkpoint
    TRY(faults_keep(&faults, read_section("theory", &theory_options, theory, others, map, true)));
    if (faults.count == 0) TRY(faults_keep(&faults, check_there(map, "species", SPECIES_ARE)));
    if (species)
        TRY(faults_keep(&faults,
                        read_theory_mixture(species, theory->species, &theory->species_count)));
    TRY(faults_tell(&faults));
    theory_complete(theory);
    plan->ensemble.replicas = 1;
    return OK;
}

static Status read_itt(const Node *map, Plan *plan) {
    static const char *const others[] = {"species", NULL};
    IttPlan *itt = &plan->itt;
    const Node *species = tree_find(map, "species");
    Faults faults = {0};
    TRY(options_default(&itt_options, itt));
    TRY(options_default(&output_options, &plan->output)); // how often there is a checkpoint
    TRY(faults_keep(&faults, read_section("itt", &itt_options, itt, others, map, true)));
    if (species)
        TRY(faults_keep(&faults, read_theory_mixture(species, itt->species, &itt->species_count)));
    TRY(faults_tell(&faults));
    itt->given = true;
    itt_complete(itt);
    plan->ensemble.replicas = 1;
    return OK;
}

static Status read_schematic(const Node *map, Plan *plan) {
    TRY(options_default(&schematic_options, &plan->schematic));
    TRY(read_section("schematic", &schematic_options, &plan->schematic, NULL, map, true));
    plan->schematic.given = true;
    plan->ensemble.replicas = 1;
    return OK;
}

// Sections that are not there are told by read_root.
static Status read_simulation(const Node *root, Plan *plan) {
    Faults faults = {0};
    const Node *system = tree_find(root, "system"), *dynamics = tree_find(root, "dynamics");
    if (system) TRY(faults_keep(&faults, read_system(system, &plan->system)));
    if (dynamics) TRY(faults_keep(&faults, read_dynamics(dynamics, "dynamics", &plan->dynamics)));
    TRY(faults_keep(&faults, check_observe(root)));
    if (tree_find(root, "protocol")) TRY(faults_keep(&faults, read_protocol(root, plan)));
    TRY(faults_keep(&faults, read_optional(root, "ensemble", &ensemble_options, &plan->ensemble)));
    TRY(faults_keep(&faults, read_optional(root, "output", &output_options, &plan->output)));
    return faults_tell(&faults);
}

// What is run instead of a simulation, by the name of its section.
static const struct {
    const char *name;
    Status (*read)(const Node *map, Plan *plan);
} theories[] = {{"theory", read_theory}, {"itt", read_itt}, {"schematic", read_schematic}};

static Status read_subject(const Node *root, Plan *plan) {
    size_t theory = 0;
    while (theory < COUNT(theories) && !tree_find(root, theories[theory].name)) theory++;
    if (theory == COUNT(theories)) return read_simulation(root, plan);
    const char *name = theories[theory].name;
    Faults faults = {0};
    TRY(faults_keep(&faults, check_alone(root, name)));
    TRY(faults_keep(&faults, theories[theory].read(tree_find(root, name), plan)));
    return faults_tell(&faults);
}

static Status judge_subject(const Node *root, const Plan *plan) {
    if (plan->itt.given) return judge_itt(root, &plan->itt);
    if (plan->schematic.given) return judge_schematic(root, &plan->schematic);
    if (plan_is_theory(plan)) return judge_theory(root, &plan->theory);
    return judge_plan(root, plan);
}

// The names of the sections. One that is missing may be there under a wrong name.
static Status read_root(const Node *root, Plan *plan) {
    TRY(options_default(&section_title_options, plan));
    TRY(read_section("the run file", &section_title_options, plan, section_root_keys, root, true));
    for (size_t i = 0; i < COUNT(theories); i++) {
        if (tree_find(root, theories[i].name)) return OK;
    }
    Faults faults = {0};
    TRY(faults_keep(&faults, check_there(root, "system", "what is simulated")));
    TRY(faults_keep(&faults,
                    check_there(root, "dynamics", "how time advances, as {method: event-driven}")));
    TRY(faults_keep(&faults, check_there(root, "protocol", "the list of stages")));
    return faults_tell(&faults);
}

static Status read_plan(const Node *root, Plan *plan) {
    Faults faults = {0};
    TRY(faults_keep(&faults, read_root(root, plan)));
    TRY(faults_keep(&faults, read_subject(root, plan)));
    TRY(faults_tell(&faults));
    return judge_subject(root, plan);
}

static Status read_tree(Node *root, const ConfigOverrides *overrides, bool must_fit, Plan *plan) {
    for (size_t i = 0; overrides && i < overrides->count; i++) {
        TRY(tree_set(root, overrides->settings[i]));
    }
    TRY(sweep_choose(root, overrides ? overrides->point : 0));
    TRY(read_plan(root, plan));
    return must_fit ? judge_memory(root, plan) : OK;
}

Status config_read_plan(Plan **out, const char *name, const char *text, size_t length,
                        const ConfigOverrides *overrides, bool must_fit) {
    Node *root = NULL;
    *out = NULL;
    TRY(tree_read(&root, name, text, length));
    Plan *plan = NULL;
    Status status = NEW(plan);
    if (status == OK) status = read_tree(root, overrides, must_fit, plan);
    tree_free(root);
    if (status == OK) return *out = plan, OK;
    memory_free(plan);
    return status;
}

Status config_read_text(Plan **out, const char *name, const char *text, size_t length,
                        const ConfigOverrides *overrides) {
    return config_read_plan(out, name, text, length, overrides, false);
}

Status config_read(Plan **out, const char *path, const ConfigOverrides *overrides) {
    char *text = NULL;
    size_t length = 0;
    *out = NULL;
    TRY(tree_read_file(path, &text, &length));
    const Status status = config_read_plan(out, path, text, length, overrides, true);
    memory_free(text);
    return status;
}
