// SPDX-License-Identifier: GPL-3.0-or-later
// The structure of a fluid of hard discs or spheres from the Ornstein-Zernike equation
// h = c + rho c * h and a closure, or from a closed form: partial direct correlation functions
// c_ab(q) and structure factors S_ab(q) at given wave numbers.
#pragma once

#include "oz/measured.h"
#include "oz/mixture.h"

#include <stdbool.h>

typedef enum Closure {
#define CLOSURE(id, name, about) id,
#include "oz/closures.def"
    CLOSURES
} Closure;

extern const char *const closure_names[]; // NULL-ended
extern const char *const closure_abouts[];

// By pairs of species. S is normalised as S_ab -> x_a delta_ab at large q: its inverse is
// delta_ab/x_a - rho c_ab.
typedef struct Structure {
    Mixture mixture;
    double packing_fraction, density;
    size_t count;                       // of wave numbers
    const double *wave_number;          // [count]
    double *direct;                     // c_ab(q), [pair][count]
    double *factor;                     // S_ab(q), [pair][count]
    double contact[MIXTURE_PAIRS_MOST]; // g_ab at contact; NaN where the closed form has none
} Structure;

bool oz_is_of_one_species(Closure closure); // and no other
int oz_dimension_of(Closure closure);       // the only one it is for; 0: any

typedef struct Oz Oz;

// BAD_DATA if the closed form is for another dimension or for one species only.
Status oz_create(Oz **out, Closure closure, const Mixture *mixture, const double *wave_number,
                 size_t count);
// The same from what was measured, which is borrowed.
Status oz_create_measured(Oz **out, const Measured *measured, const double *wave_number,
                          size_t count);
void oz_free(Oz *oz);

// The structure at this packing fraction, borrowed until the next call. Solutions are followed from
// density to density. UNHEALTHY with a sentence that says what was reached if the iteration does
// not converge, or if no fluid is stable there.
Status oz_solve(Oz *oz, double packing_fraction, const Structure **out);

// P V/(N kT) by the virial route: 1 + rho v sum_ab x_a x_b d_ab^dim g_ab(d_ab), v = pi/2 in 2D and
// 2 pi/3 in 3D (Hansen & McDonald, Theory of Simple Liquids, eq. 2.5.26). NaN without contact
// values.
double oz_compressibility_factor(const Structure *structure);

// What the last solution took: iterations, and the largest residual of the closure that is left. On
// the way to it: the packing fraction that these are of, and the last that was solved, 0 if none.
typedef struct OzEffort {
    size_t iterations;
    double residual;
    double at, reached;
} OzEffort;
OzEffort oz_effort(const Oz *oz);
