// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers of run files, tables and results.
#include "base/number.h"

#include "base/plain_locale.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *skip_digits(const char *c) {
    while (*c >= '0' && *c <= '9') c++;
    return c;
}

// [+-] digits [. digits] [e [+-] digits], with a digit before or after the point.
static bool is_decimal(const char *c) {
    if (*c == '+' || *c == '-') c++;
    const char *whole = c;
    c = skip_digits(c);
    size_t digits = (size_t)(c - whole);
    if (*c == '.') {
        const char *part = ++c;
        c = skip_digits(c);
        digits += (size_t)(c - part);
    }
    if (digits == 0) return false;
    if (*c == 'e' || *c == 'E') {
        c++;
        if (*c == '+' || *c == '-') c++;
        if (c == skip_digits(c)) return false;
        c = skip_digits(c);
    }
    return *c == '\0';
}

static bool is_zero(const char *decimal) {
    const size_t mantissa = strcspn(decimal, "eE");
    return strcspn(decimal, "123456789") >= mantissa;
}

bool number_read(const char *text, double *value) {
    if (!is_decimal(text)) return false;
    IN_PLAIN_LOCALE;
    const double read = strtod(text, NULL); // correctly rounded by the C library
    if (!isfinite(read) || (read == 0 && !is_zero(text))) return false;
    *value = read;
    return true;
}

bool number_read_whole(const char *text, int64_t *value) {
    const char *digits = text + (*text == '+' || *text == '-');
    if (*digits && *skip_digits(digits) == '\0') {
        long long whole = 0;
        for (const char *c = digits; *c; c++) {
            if (__builtin_mul_overflow(whole, 10, &whole)) return false;
            if (__builtin_sub_overflow(whole, *c - '0', &whole))
                return false; // negative: more room
        }
        if (*text != '-' && __builtin_sub_overflow(0, whole, &whole)) return false;
        *value = whole;
        return true;
    }
    static const double EXACT = 9007199254740992; // 2^53, up to which a double counts
    double real = 0;
    if (!number_read(text, &real) || real != rint(real) || fabs(real) > EXACT) return false;
    *value = (int64_t)real;
    return true;
}

// `value` with this many digits behind the first, as 123.4 or, where that is shorter, as 1e20.
static void print_real(char out[NUMBER_SIZE], double value, int behind) {
    static const int SMALLEST = -5, LARGEST = 16; // powers of ten that may do without an exponent
    static const int PLAIN = 6;                   // and those from 0 that always do
    char scientific[NUMBER_SIZE];
    snprintf(scientific, sizeof scientific, "%.*e", behind, value);
    char *e = strchr(scientific, 'e');
    const int exponent = atoi(e + 1);
    *e = '\0';
    snprintf(out, NUMBER_SIZE, "%.24se%d", scientific, exponent);
    if (exponent < SMALLEST || exponent > LARGEST) return;
    if (exponent >= PLAIN && strlen(out) < (size_t)exponent + 1) return;
    snprintf(out, NUMBER_SIZE, "%.*f", behind > exponent ? behind - exponent : 0, value);
}

const char *number_write(char out[NUMBER_SIZE], double value) {
    if (!isfinite(value)) {
        snprintf(out, NUMBER_SIZE, "%s", isnan(value) ? "nan" : value > 0 ? "inf" : "-inf");
        return out;
    }
    IN_PLAIN_LOCALE;
    for (int behind = 0; behind < 17; behind++) {
        print_real(out, value, behind);
        if (strtod(out, NULL) == value) break;
    }
    return out;
}
