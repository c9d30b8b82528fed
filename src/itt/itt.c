// SPDX-License-Identifier: GPL-3.0-or-later
// A run of the theory under shear: the transition where it is asked for, the structure, then the
// transients from time to time.
#include "itt/itt.h"

#include "base/constants.h"
#include "base/memory.h"
#include "itt/direct.h"
#include "itt/flow.h"
#include "itt/input.h"
#include "itt/put.h"
#include "itt/transient.h"
#include "mct/critical.h"
#include "oz/oz.h"
#include "theory/series.h"

#include <math.h>

enum { TABLE = 3000, SLICE = 4 };      // entries of c(q); times between two looks from outside
static const double TABLE_END = 3;     // in units of the cutoff: advected wave vectors are longer
static const double BEGIN = 1e-7;      // time from which progress counts
static const double UNFINISHED = 1e-3; // of the stress, in what its integral still adds

static const double FIRST_STRAIN = 1e-3; // from which the stress is kept

// Of the search for the glass transition: so many wave numbers for one of 1/d give five digits.
static const double CRITICAL_WAVES = 16 / PI, CRITICAL_LOW = 0.6, CRITICAL_HIGH = 0.76;

typedef enum Step { STEP_CRITICAL, STEP_STRUCTURE, STEP_TRANSIENTS, STEP_DONE } Step;

struct Itt {
    const IttPlan *plan;
    Step step;
    double packing_fraction;
    const Measured *measured; // structure in place of the closure's; NULL: none
    Plane *plane;
    Direct *direct;
    Transient *transient;
    Flow *flow;
    Record record;
    double next_time;                      // to be kept
    double before[2][2];                   // strain and stress of the two looks before
    double overshoot, strain_at_overshoot; // 0: the stress has had no maximum yet
};

// Up to the cutoff of the plane, since closures move the transition with it: a state beside that of
// another cutoff may be on the other side of its own.
static Status find_critical(Itt *itt, Results *results) {
    CriticalPoint *point = NULL;
    const Measured *measured = itt->measured;
    const double last = itt->plan->last_wave_number;
    const CriticalSearch search = {.mixture = itt_mixture(itt->plan),
                                   .closure = (Closure)itt->plan->structure,
                                   .count = (size_t)(CRITICAL_WAVES * last),
                                   .last = last,
                                   .low = measured ? measured_lowest(measured) : CRITICAL_LOW,
                                   .high = measured ? measured_highest(measured) : CRITICAL_HIGH,
                                   .measured = measured};
    TRY(critical_find(&point, &search));
    const double critical = point->packing_fraction;
    critical_free(point);
    itt->packing_fraction = critical * (1 + itt->plan->separation);
    itt->step = STEP_STRUCTURE;
    return theory_put_number(results, "critical_packing_fraction", "",
                             "Packing fraction of the glass transition at rest, with wave numbers "
                             "up to those of the plane.",
                             critical);
}

// ---- Structure ---------------------------------------------------------------------------------

static Status tabulate(Itt *itt, Oz *oz, double spacing, Results *results) {
    const Structure *s = NULL;
    TRY(oz_solve(oz, itt->packing_fraction, &s));
    TRY(theory_put_number(results, "packing_fraction", "", "Packing fraction of the discs.",
                          itt->packing_fraction));
    if (itt->measured)
        TRY(results_put_health(results, "structure_misfit",
                               "mean square of (c - fit)/error of the measured structure", NAN,
                               measured_misfit(itt->measured)));
    TRY(results_put_health(results, "structure_residual",
                           "largest residual of the closure, where it is solved numerically", 1e-8,
                           oz_effort(oz).residual));
    return direct_create(&itt->direct, &s->mixture, s->density, spacing, s->direct, TABLE);
}

static Status solve_structure(Itt *itt, Results *results) {
    double wave_number[TABLE];
    const double spacing = TABLE_END * itt->plan->last_wave_number / TABLE;
    const Mixture mixture = itt_mixture(itt->plan);
    Oz *oz = NULL;
    for (size_t i = 0; i < TABLE; i++) wave_number[i] = direct_wave_number(spacing, i);
    TRY(itt->measured
            ? oz_create_measured(&oz, itt->measured, wave_number, TABLE)
            : oz_create(&oz, (Closure)itt->plan->structure, &mixture, wave_number, TABLE));
    const Status status = tabulate(itt, oz, spacing, results);
    oz_free(oz);
    itt->step = STEP_TRANSIENTS;
    return status;
}

// ---- Transients --------------------------------------------------------------------------------

// Where S(q), of all species together, is largest, on the table.
static double peak(const Direct *direct) {
    double best = 0, most = 0;
    for (size_t i = 0; i < direct->count / 2; i++) {
        const double q = direct_wave_number(direct->spacing, i), s = direct_total(direct, q);
        if (s > most) best = q;
        most = fmax(most, s);
    }
    return best;
}

static Status begin_record(Itt *itt) {
    const IttPlan *plan = itt->plan;
    const OptionReals *wanted = &plan->wave_numbers;
    const size_t waves = wanted->count > 0 ? (size_t)wanted->count : 1;
    itt->record.species = itt_species(plan, &itt->record.species_count);
    const double decades = log10(plan->last_strain / plan->shear_rate / plan->first_time);
    for (size_t i = 0; i < waves; i++)
        itt->record.wave_number[i] = wanted->count > 0 ? wanted->values[i] : peak(itt->direct);
    // Half a block for each doubling of the strain.
    const double strains =
        ((double)plan->block / 2) * (fmax(0, log2(plan->last_strain / FIRST_STRAIN)) + 3);
    itt->next_time = plan->first_time;
    return record_create(&itt->record, waves,
                         (size_t)(decades * (double)plan->times_per_decade) + 3, (size_t)strains,
                         plan->tagged);
}

static Status begin_transients(Itt *itt) {
    const IttPlan *plan = itt->plan;
    TransientSettings settings = {
        .shear_rate = plan->shear_rate, .block = (size_t)plan->block, .tagged = plan->tagged};
    size_t count;
    const TheorySpecies *species = itt_species(plan, &count);
    for (size_t a = 0; a < count; a++) settings.diffusion[a] = species[a].diffusion;
    TRY(plane_create(&itt->plane, plan->last_wave_number, plan->spacing));
    TRY(transient_create(&itt->transient, itt->plane, itt->direct, &settings));
    TRY(flow_create(&itt->flow, itt->plane, itt->direct, plan->shear_rate));
    flow_see(itt->flow, 0, transient_collective(itt->transient));
    return begin_record(itt);
}

// F = Phi S at a wave vector.
static void read_correlators(const Itt *itt, double q, double x, double y, SmallMatrix f) {
    const size_t species = itt->record.species_count;
    const double *phi = transient_collective(itt->transient);
    SmallMatrix read, factor;
    for (size_t a = 0; a < species; a++) {
        for (size_t b = 0; b < species; b++)
            read[a][b] = plane_read(itt->plane, phi + (a * species + b) * itt->plane->size, x, y);
    }
    direct_factor(itt->direct, q, factor);
    small_multiply(species, read, factor, f);
}

// Of pairs of species and all together, over what they were at the start.
static void keep_correlators(Itt *itt, int direction, size_t wave, double *to, size_t stride) {
    const size_t species = itt->record.species_count, rows = itt->record.rows;
    const double q = itt->record.wave_number[wave];
    double x, y, total = 0;
    SmallMatrix f, start;
    record_vector(direction, q, &x, &y);
    read_correlators(itt, q, x, y, f);
    direct_factor(itt->direct, q, start);
    for (size_t a = 0; a < species; a++) {
        for (size_t b = 0; b < species; b++) {
            total += f[a][b];
            if (b >= a && rows > 1)
                to[mixture_pair(species, a, b) * stride] = (f[a][b] + f[b][a]) / (2 * start[a][b]);
        }
    }
    to[(rows - 1) * stride] = total / direct_total(itt->direct, q);
}

static void keep_tagged(Itt *itt, int direction, size_t wave, double *to, size_t stride) {
    double x, y;
    record_vector(direction, itt->record.wave_number[wave], &x, &y);
    for (size_t s = 0; s < itt->record.species_count; s++)
        to[s * stride] = plane_read(itt->plane, transient_tagged(itt->transient, s), x, y);
}

static void keep(Itt *itt) {
    Record *r = &itt->record;
    const size_t t = r->times++, lines = TRANSIENT_DIRECTIONS * r->waves;
    r->time[t] = transient_time(itt->transient);
    r->modulus[t] = flow_modulus(itt->flow);
    for (size_t i = 0; i < lines; i++) {
        const int direction = (int)(i / r->waves);
        keep_correlators(itt, direction, i % r->waves, r->collective + t * r->rows * lines + i,
                         lines);
        if (r->tagged)
            keep_tagged(itt, direction, i % r->waves, r->tagged + t * r->species_count * lines + i,
                        lines);
    }
    const size_t displacements = r->displacement ? r->species_count * TRANSIENT_DIRECTIONS : 0;
    for (size_t i = 0; i < displacements; i++)
        r->displacement[t * displacements + i] = transient_displacement(
            itt->transient, i / TRANSIENT_DIRECTIONS, (int)(i % TRANSIENT_DIRECTIONS));
}

// At all times from the first strain that is kept.
static void keep_stress(Itt *itt) {
    Record *r = &itt->record;
    const double strain = transient_strain(itt->transient);
    if (strain < FIRST_STRAIN || r->strains == r->strains_most) return;
    r->strain[r->strains] = strain;
    r->stress[2 * r->strains] = flow_stress(itt->flow);
    r->stress[2 * r->strains + 1] = flow_normal_difference(itt->flow);
    r->strains++;
}

// The largest stress, by the parabola through three looks where the middle one is above the others
// and above all before.
static void find_overshoot(Itt *itt) {
    const double now[2] = {transient_strain(itt->transient), flow_stress(itt->flow)};
    const double *a = itt->before[0], *b = itt->before[1];
    if (b[1] > a[1] && b[1] > now[1] && b[1] > itt->overshoot) {
        const double left = (b[1] - a[1]) / (b[0] - a[0]),
                     right = (now[1] - b[1]) / (now[0] - b[0]);
        const double curvature = (right - left) / (now[0] - a[0]);
        const double slope = left + curvature * (b[0] - a[0]); // at the middle
        itt->strain_at_overshoot = b[0] - slope / (2 * curvature);
        itt->overshoot = b[1] - slope * slope / (4 * curvature);
    }
    for (int i = 0; i < 2; i++) {
        itt->before[0][i] = itt->before[1][i];
        itt->before[1][i] = now[i];
    }
}

static Status advance(Itt *itt, bool *done) {
    TRY(transient_advance(itt->transient));
    const double time = transient_time(itt->transient);
    flow_see(itt->flow, time, transient_collective(itt->transient));
    find_overshoot(itt);
    keep_stress(itt);
    *done = transient_strain(itt->transient) >= itt->plan->last_strain;
    if (time < itt->next_time && !*done) return OK;
    keep(itt);
    while (itt->next_time <= time)
        itt->next_time *= pow(10, 1 / (double)itt->plan->times_per_decade);
    *done = *done || itt->record.times == itt->record.times_most;
    return OK;
}

static Status put_flow(const Itt *itt, Results *results) {
    const double rate = itt->plan->shear_rate, stress = flow_stress(itt->flow);
    TRY(theory_put_number(results, "shear_rate", "D0/d^2", "Shear rate.", rate));
    TRY(theory_put_number(results, "shear_stress", "kT/d^2", "sigma_xy at the last strain.",
                          stress));
    TRY(theory_put_number(results, "normal_stress_difference", "kT/d^2",
                          "sigma_xx - sigma_yy at the last strain.",
                          flow_normal_difference(itt->flow)));
    TRY(theory_put_number(results, "shear_viscosity", "kT/D0",
                          "sigma_xy over the shear rate, without that of the solvent.",
                          stress / rate));
    TRY(results_put_health(
        results, "stress_unfinished",
        "what the integral for the stress still grew by per unit of ln t at the "
        "end, over the stress",
        UNFINISHED, fabs(flow_modulus(itt->flow) * transient_strain(itt->transient) / stress)));
    const bool passed = itt->overshoot > 0;
    TRY(theory_put_number(results, "largest_stress", "kT/d^2",
                          "Maximum of the stress after the start of shear, if it has passed one.",
                          passed ? itt->overshoot : NAN));
    return theory_put_number(results, "strain_at_largest_stress", "",
                             "Strain at the maximum of the stress.",
                             passed ? itt->strain_at_overshoot : NAN);
}

// dy^2 has grown like the time over the last two that are kept.
static Status put_diffusion(const Itt *itt, Results *results) {
    const Record *r = &itt->record;
    if (!r->displacement || r->times < 2) return OK;
    const size_t stride = r->species_count * TRANSIENT_DIRECTIONS;
    const double *last = r->displacement + (r->times - 1) * stride, *before = last - stride;
    const double time = r->time[r->times - 1] - r->time[r->times - 2];
    double diffusion[MIXTURE_SPECIES_MOST];
    for (size_t s = 0; s < r->species_count; s++) {
        const size_t across = s * TRANSIENT_DIRECTIONS + 1;
        diffusion[s] = (last[across] - before[across]) / time / 2;
    }
    return theory_put_each(results, r->species, r->species_count, "diffusion_across_flow", "D0",
                           "Slope of the displacement along y over 2 t, at the last strain.",
                           diffusion);
}

static Status put_structure(const Itt *itt, Results *results) {
    const size_t species = itt->record.species_count, size = itt->plane->size;
    double *rest = NULL;
    TRY(NEW_ARRAY(rest, mixture_pairs(&itt->direct->mixture) * size));
    for (size_t k = 0; k < size; k++) {
        SmallMatrix factor;
        direct_factor(itt->direct, hypot(itt->plane->x[k], itt->plane->y[k]), factor);
        for (size_t a = 0; a < species; a++) {
            for (size_t b = a; b < species; b++)
                rest[mixture_pair(species, a, b) * size + k] = factor[a][b];
        }
    }
    const Status status =
        record_put_structure(&itt->record, results, itt->plane, rest, flow_distortion(itt->flow));
    memory_free(rest);
    return status;
}

static Status solve_transients(Itt *itt, Results *results) {
    bool done = false;
    if (!itt->transient) TRY(begin_transients(itt));
    for (int i = 0; i < SLICE && !done; i++) TRY(advance(itt, &done));
    if (!done) return OK;
    TRY(put_flow(itt, results));
    TRY(put_diffusion(itt, results));
    TRY(record_put(&itt->record, results));
    TRY(put_structure(itt, results));
    itt->step = STEP_DONE;
    return OK;
}

// ---- The whole ---------------------------------------------------------------------------------

Status itt_create(Itt **out, const IttPlan *plan, const Measured *measured) {
    Itt *itt = NULL;
    TRY(NEW(itt));
    itt->plan = plan;
    itt->packing_fraction = plan->packing_fraction;
    itt->step = plan->packing_fraction > 0 ? STEP_STRUCTURE : STEP_CRITICAL;
    itt->measured = measured;
    *out = itt;
    return OK;
}

void itt_free(Itt *itt) {
    if (!itt) return;
    record_free(&itt->record);
    flow_free(itt->flow);
    transient_free(itt->transient);
    plane_free(itt->plane);
    direct_free(itt->direct);
    memory_free(itt);
}

Status itt_advance(Itt *itt, Results *results) {
    static Status (*const work[STEP_DONE])(Itt *, Results *) = {find_critical, solve_structure,
                                                                solve_transients};
    return work[itt->step](itt, results);
}

bool itt_can_save(const Itt *itt) {
    return itt->step == STEP_TRANSIENTS && itt->transient;
}

static const uint64_t ITT_TAG = 0x4954543030303033; // "ITT00003"

static void archive_transients(Itt *itt, Archive *archive) {
    archive_tag(archive, ITT_TAG);
    transient_archive(itt->transient, archive);
    flow_archive(itt->flow, archive);
    record_archive(&itt->record, archive);
    archive_f64(archive, &itt->next_time, 1);
    archive_f64(archive, &itt->before[0][0], 4);
    archive_f64(archive, &itt->overshoot, 1);
    archive_f64(archive, &itt->strain_at_overshoot, 1);
}

void itt_save(Itt *itt, Archive *archive) {
    ASSERT(itt_can_save(itt));
    archive_transients(itt, archive);
}

Status itt_load(Itt *itt, Results *results, Archive *archive) {
    while (itt->step < STEP_TRANSIENTS) TRY(itt_advance(itt, results));
    TRY(begin_transients(itt));
    archive_transients(itt, archive);
    return archive_status(archive, false);
}

bool itt_finished(const Itt *itt) {
    return itt->step == STEP_DONE;
}

double itt_progress(const Itt *itt) {
    if (itt->step == STEP_DONE) return 1;
    if (!itt->transient) return 0;
    const double end = itt->plan->last_strain / itt->plan->shear_rate;
    return fmin(0.999, fmax(0, log(itt_time(itt) / BEGIN) / log(end / BEGIN)));
}

const char *itt_doing(const Itt *itt) {
    static const char *const doing[] = {"critical point", "structure", "transients", ""};
    return doing[itt->step];
}

double itt_time(const Itt *itt) {
    return itt->transient ? transient_time(itt->transient) : 0;
}
