// SPDX-License-Identifier: GPL-3.0-or-later
// The suspension as a value: option tables, and what follows from it before there are particles.
#include "state/system.h"

#include "base/constants.h"

#include <math.h>

static const double FRACTIONS_OFF = 1e-9; // how far their sum may be from 1

const char *const spread_names[SPREADS + 1] = {"none", "gaussian", "uniform", NULL};
const char *const start_names[STARTS + 1] = {"compressed", "crystal", NULL};

static const Option system_rows[] = {
    {"dimension", OPTION_INTEGER, offsetof(System, dimension), 0, 2, 3, "", "Dimension of space.",
     .required = 1},
    {"particles", OPTION_INTEGER, offsetof(System, particles), 0, 2, 2e9, "",
     "Number of particles of one replica.", .required = 1},
    {"packing_fraction", OPTION_REAL, offsetof(System, packing_fraction), 0, 0, 1, "",
     "Fraction of the volume (area in 2D) that the particles fill; give this or number_density."},
    {"number_density", OPTION_REAL, offsetof(System, number_density), 0, 0, 100, "d^-dimension",
     "Particles per volume (area in 2D); give this or packing_fraction."},
    {"box.aspect", OPTION_REALS, offsetof(System, aspect), 0, 0.01, 100, "",
     "Ratios of the edges of the periodic box, one number per dimension; all equal by default."},
    {"start", OPTION_CHOICE, offsetof(System, start), START_COMPRESSED, 0, 0, "",
     "Where the particles begin: compressed from a dilute disorder to the density asked for, or on "
     "the places of a crystal, body axes along z, for the first stage to melt.",
     start_names},
};
const OptionTable system_options = {system_rows, sizeof system_rows / sizeof *system_rows,
                                    sizeof(System)};

static const Option species_rows[] = {
    {"shape", OPTION_CHOICE, offsetof(Species, shape), 0, 0, 0, "", "Shape of the particles.",
     shape_names, .required = 1},
    {"diameter", OPTION_REAL, offsetof(Species, diameter), 1, 0.01, 100, "d",
     "Diameter; the mean if the sizes are spread."},
    {"length", OPTION_REAL, offsetof(Species, length), 0, 0, 100, "d",
     "Length of the cylinder of a spherocylinder, without its caps."},
    {"exponent", OPTION_REAL, offsetof(Species, exponent), 36, 4, 200, "",
     "Exponent n of soft spheres, whose energy is kT (d/r)^n."},
    {"diffusion.parallel", OPTION_REAL, offsetof(Species, diffusion.parallel), 0, 0, 1e6,
     "kT/(eta d)",
     "Free diffusion coefficient along the body axis, or of a body without one; 0: "
     "built in. Monte Carlo only: event-driven dynamics goes by mass."},
    {"diffusion.perpendicular", OPTION_REAL, offsetof(Species, diffusion.perpendicular), 0, 0, 1e6,
     "kT/(eta d)", "Free diffusion coefficient across the body axis; 0: built in."},
    {"diffusion.rotational", OPTION_REAL, offsetof(Species, diffusion.rotational), 0, 0, 1e6,
     "kT/(eta d^3)", "Free rotational diffusion coefficient of the body axis; 0: built in."},
    {"mass", OPTION_REAL, offsetof(Species, mass), 1, 1e-6, 1e6, "m",
     "Mass; the free diffusion coefficient of a species is inversely proportional to it."},
    {"fraction", OPTION_REAL, offsetof(Species, fraction), 0, 0, 1, "",
     "Share of this species in the number of particles, of those that counts leave; the shares add "
     "to "
     "1. One species may leave it out, and is what the others leave."},
    {"count", OPTION_INTEGER, offsetof(Species, count), 0, 0, 2e9, "",
     "How many particles the species has, such as 1 of a tracer; 0: as its fraction says."},
    {"spread.distribution", OPTION_CHOICE, offsetof(Species, spread), SPREAD_NONE, 0, 0, "",
     "Distribution of the diameters of a polydisperse species.", spread_names},
    {"spread.width", OPTION_REAL, offsetof(Species, spread_width), 0, 0, 0.3, "",
     "Polydispersity: standard deviation of the diameters over their mean."},
};
const OptionTable species_options = {species_rows, sizeof species_rows / sizeof *species_rows,
                                     sizeof(Species)};

// What the counts leave to the fractions.
static int64_t left_to_share(const System *system) {
    int64_t left = system->particles;
    for (size_t s = 0; s < system->species_count; s++) left -= system->species[s].count;
    return left;
}

void system_counts(const System *system, size_t counts[SPECIES_MOST]) {
    double remainder[SPECIES_MOST];
    const double shared = (double)left_to_share(system);
    size_t placed = 0;
    for (size_t s = 0; s < system->species_count; s++) {
        const Species *species = &system->species[s];
        const double share =
            species->count > 0 ? (double)species->count : species->fraction * shared;
        counts[s] = (size_t)floor(share);
        remainder[s] = species->count > 0 ? -1 : share - floor(share);
        placed += counts[s];
    }
    for (; placed < (size_t)system->particles; placed++) {
        size_t most = 0;
        for (size_t s = 1; s < system->species_count; s++) {
            if (remainder[s] > remainder[most]) most = s;
        }
        counts[most]++;
        remainder[most] = -1;
    }
}

static Status check_shares(const System *system) {
    double sum = 0;
    size_t sharing = 0;
    for (size_t s = 0; s < system->species_count; s++) {
        if (system->species[s].count > 0) continue;
        sum += system->species[s].fraction;
        sharing++;
    }
    const int64_t left = left_to_share(system);
    if (sharing == 0 && left != 0)
        return status_fail(BAD_DATA,
                           "the counts of the species add to %lld, but particles = %lld; leave out "
                           "one of the counts",
                           (long long)(system->particles - left), (long long)system->particles);
    if (sharing > 0 && left < (int64_t)sharing)
        return status_fail(
            BAD_DATA,
            "the counts of the species leave %lld of %lld particles to those without "
            "one; take more particles",
            (long long)left, (long long)system->particles);
    if (sharing == 0 || fabs(sum - 1) <= FRACTIONS_OFF) return OK;
    return status_fail(BAD_DATA, "the fractions of the species add to %.10g; they must add to 1",
                       sum);
}

Status system_check_counts(const System *system) {
    size_t counts[SPECIES_MOST];
    if (system->species_count < 1) return status_fail(BAD_DATA, "a system needs a species");
    for (size_t s = 0; s < system->species_count; s++) {
        const Species *species = &system->species[s];
        if (species->count > 0 && species->fraction != 0)
            return status_fail(BAD_DATA,
                               "fraction = %g: species '%s' has a count as well; one is enough",
                               species->fraction, species->name);
    }
    TRY(check_shares(system));
    system_counts(system, counts);
    for (size_t s = 0; s < system->species_count; s++) {
        if (counts[s] > 0) continue;
        return status_fail(BAD_DATA, "fraction = %g of %g particles leaves none of species '%s'",
                           system->species[s].fraction, (double)left_to_share(system),
                           system->species[s].name);
    }
    return OK;
}

Body species_body(const Species *species) {
    return (Body){.shape = (ShapeKind)species->shape,
                  .diameter = species->diameter,
                  .length = species->length,
                  .exponent = species->exponent};
}

bool system_is_oriented(const System *system) {
    for (size_t s = 0; s < system->species_count; s++) {
        if (shape_is_oriented((ShapeKind)system->species[s].shape)) return true;
    }
    return false;
}

Diffusion species_diffusion(const Species *species) {
    const Body body = species_body(species);
    const Diffusion given = species->diffusion;
    Diffusion diffusion = shape_diffusion(&body);
    if (given.parallel > 0) diffusion.parallel = given.parallel;
    if (!shape_is_oriented(body.shape)) diffusion.perpendicular = diffusion.parallel;
    if (given.perpendicular > 0) diffusion.perpendicular = given.perpendicular;
    if (given.rotational > 0) diffusion.rotational = given.rotational;
    return diffusion;
}

static Status check_diffusion(const System *system, size_t index) {
    const Species *species = &system->species[index];
    const Body body = species_body(species);
    const Diffusion given = species->diffusion, diffusion = species_diffusion(species);
    const bool oriented = shape_is_oriented(body.shape);
    if (body.shape == SHAPE_DISC && system->species_count > 1 && !(given.parallel > 0))
        return status_fail(BAD_DATA,
                           "diffusion = 0: species '%s' needs {parallel: ...}, since discs have no "
                           "Stokes law that would tell several species apart",
                           species->name);
    if (!oriented && (given.perpendicular > 0 || given.rotational > 0))
        return status_fail(
            BAD_DATA, "diffusion.%s = %g: species '%s' has no body axis; give parallel alone",
            given.perpendicular > 0 ? "perpendicular" : "rotational",
            given.perpendicular > 0 ? given.perpendicular : given.rotational, species->name);
    const bool whole = diffusion.parallel > 0 && diffusion.perpendicular > 0 &&
                       (!oriented || diffusion.rotational > 0);
    const bool by_hand = given.parallel > 0 && given.perpendicular > 0 && given.rotational > 0;
    const bool short_rod = body.shape == SHAPE_SPHEROCYLINDER && body.length < 2 * body.diameter;
    if (whole && (!short_rod || by_hand)) return OK;
    return status_fail(BAD_DATA,
                       "diffusion = 0: species '%s' needs {parallel: ..., perpendicular: ..., "
                       "rotational: ...}, since the built-in tensor is for rods of length >= 2 "
                       "diameters",
                       species->name);
}

Status system_check_diffusion(const System *system) {
    for (size_t s = 0; s < system->species_count; s++) TRY(check_diffusion(system, s));
    return OK;
}

double system_reference_diffusion(const System *system) {
    const Diffusion first = species_diffusion(&system->species[0]);
    return diffusion_mean(&first, (int)system->dimension);
}

// <(1 + w x)^p> of the relative deviations w x of diameters, whose distribution is symmetric.
static double spread_moment(const Species *species, int power) {
    static const double factor[4] = {0, 0, 1, 3};
    const double width = species->spread == SPREAD_NONE ? 0 : species->spread_width;
    return 1 + factor[power] * width * width;
}

double system_diameter_moment(const System *system, int power) {
    ASSERT(power >= 1 && power <= 3);
    size_t counts[SPECIES_MOST];
    system_counts(system, counts);
    double sum = 0;
    for (size_t s = 0; s < system->species_count; s++) {
        const Species *species = &system->species[s];
        double moment = spread_moment(species, power);
        for (int p = 0; p < power; p++) moment *= species->diameter;
        sum += (double)counts[s] * moment;
    }
    return sum / (double)system->particles;
}

double system_mean_volume(const System *system) {
    size_t counts[SPECIES_MOST];
    system_counts(system, counts);
    double sum = 0;
    for (size_t s = 0; s < system->species_count; s++) {
        const Species *species = &system->species[s];
        const Body body = species_body(species);
        sum += (double)counts[s] * shape_volume(&body) *
               spread_moment(species, shape_dimension(body.shape));
    }
    return sum / (double)system->particles;
}

double system_packing_fraction(const System *system) {
    if (system->packing_fraction > 0) return system->packing_fraction;
    return system->number_density * system_mean_volume(system);
}

double system_number_density(const System *system) {
    if (system->number_density > 0) return system->number_density;
    return system->packing_fraction / system_mean_volume(system);
}

Box system_box(const System *system) {
    double aspect[3] = {1, 1, 1};
    for (int64_t a = 0; a < system->aspect.count && a < 3; a++) {
        aspect[a] = system->aspect.values[a];
    }
    const double volume = (double)system->particles / system_number_density(system);
    return box_of_volume((int)system->dimension, volume, aspect);
}
