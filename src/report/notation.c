// SPDX-License-Identifier: GPL-3.0-or-later
// Rounding of values and errors as people write them.
#include "report/notation.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int power_of_ten(double value) { // 12.3 -> 1
    char scientific[32];
    snprintf(scientific, sizeof scientific, "%.16e", value);
    return atoi(strchr(scientific, 'e') + 1);
}

// The place (power of ten) of the last digit that an error allows. Of the error's three leading
// digits, up to 354 leave two, up to 949 leave one, and the rest round up to 1000 and leave two.
static int last_place(double error) {
    char scientific[32];
    snprintf(scientific, sizeof scientific, "%.2e", error);
    const int place = atoi(strchr(scientific, 'e') + 1);
    const int leading =
        100 * (scientific[0] - '0') + 10 * (scientific[2] - '0') + (scientific[3] - '0');
    if (leading <= 354) return place - 1;
    return place;
}

static double rounded_to(double value, int place) {
    const double unit = pow(10.0, place);
    return round(value / unit) * unit;
}

static void value_and_error(Text *text, double value, double error, int place) {
    if (place >= 0) {
        text_add(text, "%.0f(%.0f)", rounded_to(value, place), rounded_to(error, place));
        return;
    }
    const bool in_last_digits = error < 1.0 - 0.5 * pow(10.0, place);
    text_add(text, "%.*f", -place, value);
    if (in_last_digits)
        text_add(text, "(%.0f)", error * pow(10.0, -place));
    else
        text_add(text, "(%.*f)", -place, error);
}

void notation_estimate(Text *text, Estimate estimate) {
    static const double SMALL = 1e-4, LARGE = 1e6; // outside, with a power of ten
    static const int DIGITS = 10;                  // of what is exact
    const double value = estimate.value, error = estimate.error;
    if (!isfinite(value)) {
        text_put(text, "-");
        return;
    }
    if (!isfinite(error) || error <= 0.0) {
        text_add(text, "%.*g", error == 0.0 ? DIGITS : 6, value);
        return;
    }
    const double size = fmax(fabs(value), error);
    const int power = power_of_ten(size);
    int place = last_place(error);
    if (place < power - DIGITS) {
        text_add(text, "%.*g", DIGITS, value); // exact but for rounding
    } else if (size < SMALL || size >= LARGE) {
        const double scale = pow(10.0, power);
        value_and_error(text, value / scale, error / scale, place - power);
        text_add(text, "e%+03d", power);
    } else {
        value_and_error(text, value, error, place);
    }
}

static const char *const RAISED[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};

static const char *put_raised(Text *text, const char *digits) {
    for (; *digits == '-' || (*digits >= '0' && *digits <= '9'); digits++) {
        text_put(text, *digits == '-' ? "⁻" : RAISED[*digits - '0']);
    }
    return digits;
}

static bool is_one_over_a_letter(const char *unit) {
    return unit[0] == '1' && unit[1] == '/' && unit[2] && !unit[3];
}

static const struct {
    const char *name, *letter;
} GREEK[] = {{"alpha", "α"}, {"beta", "β"},  {"gamma", "γ"}, {"delta", "δ"},  {"epsilon", "ε"},
             {"eta", "η"},   {"theta", "θ"}, {"kappa", "κ"}, {"lambda", "λ"}, {"mu", "μ"},
             {"nu", "ν"},    {"xi", "ξ"},    {"pi", "π"},    {"rho", "ρ"},    {"sigma", "σ"},
             {"tau", "τ"},   {"phi", "φ"},   {"chi", "χ"},   {"psi", "ψ"},    {"omega", "ω"}};

static bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

// Of the Greek letter that the word at `c` names, as in sigma_xy; 0 if it names none.
static size_t put_greek(Text *text, const char *c) {
    for (size_t i = 0; i < sizeof GREEK / sizeof *GREEK; i++) {
        const size_t length = strlen(GREEK[i].name);
        if (strncmp(c, GREEK[i].name, length) != 0 || is_letter(c[length])) continue;
        text_put(text, GREEK[i].letter);
        return length;
    }
    return 0;
}

void notation_unit(Text *text, const char *unit) {
    if (is_one_over_a_letter(unit)) {
        text_add(text, "%s⁻¹", unit + 2);
        return;
    }
    for (const char *c = unit; *c;) {
        const char *digit = c[0] == '^' ? c + 1 + (c[1] == '-') : c;
        const bool raised = c[0] == '^' && *digit >= '0' && *digit <= '9';
        const bool begins = c == unit || !is_letter(c[-1]);
        const size_t greek = begins ? put_greek(text, c) : 0;
        if (greek > 0) {
            c += greek;
        } else if (raised) {
            c = put_raised(text, c + 1);
        } else if (strncmp(c, "sqrt", 4) == 0) {
            text_put(text, "√");
            c += 4;
        } else if (strncmp(c, "D0", 2) == 0) {
            text_put(text, "D₀");
            c += 2;
        } else {
            text_bytes(text, c++, 1);
        }
    }
}

void notation_name(Text *text, const char *name) {
    for (const char *c = name; *c; c++) text_bytes(text, *c == '_' ? " " : c, 1);
}
