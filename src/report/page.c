// SPDX-License-Identifier: GPL-3.0-or-later
// The text of report.html: HTML and CSS only, nothing fetched, nothing run.
#include "report/page.h"

#include "report/flow_table.h"
#include "report/html.h"
#include "report/notation.h"
#include "report/select.h"
#include "report/tensor.h"

#include <math.h>
#include <string.h>

static const char STYLE[] =
    "body{font:16px/1.5 system-ui,'Helvetica Neue',Helvetica,Arial,sans-serif;color:#1b1f24;"
    "background:#fff;max-width:1180px;margin:0 auto;padding:1.5rem}\n"
    "h1{font-size:1.75rem;line-height:1.25;margin:0 0 .25rem}\n"
    "h2{font-size:1.2rem;margin:2.2rem 0 .6rem;padding-bottom:.2rem;border-bottom:1px solid "
    "#d5dae0}\n"
    "h3{font-size:1rem;margin:0 0 .3rem}\n"
    "h3 small{font-weight:400;color:#57606a}\n"
    ".under{color:#57606a;margin:.4rem 0 1rem;font-size:.93rem}\n"
    ".verdict{padding:.5rem .8rem;border-left:5px solid;border-radius:3px}\n"
    ".good{background:#eaf6ef;border-color:#009E73}.bad{background:#fdeeee;border-color:#c62828}\n"
    "table{border-collapse:collapse;width:100%;font-size:.93rem}\n"
    "th{text-align:left;font-weight:600;border-bottom:2px solid #8c959f;padding:.25rem .6rem}\n"
    "td{border-bottom:1px solid #e4e8ec;padding:.25rem .6rem;vertical-align:top}\n"
    "td.n,th.n{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}\n"
    "td.a{color:#57606a;font-size:.87rem}tr.stage th{border:0;padding-top:.9rem}\n"
    "td:first-child,td.u{white-space:nowrap}table.facts td:first-child{width:13rem}"
    ".facts td{overflow-wrap:anywhere}\n"
    "td.ok{color:#006b4e;font-weight:600}td.broken{color:#c62828;font-weight:700}\n"
    ".figures{display:grid;grid-template-columns:repeat(auto-fit,minmax(480px,1fr));gap:1.6rem}\n"
    "figure{margin:0;break-inside:avoid}figure svg{width:100%;height:auto;display:block}\n"
    "figcaption{font-size:.87rem;color:#41484f;margin-top:.3rem}\n"
    ".chip{display:inline-block;width:.8em;height:.8em;border-radius:50%;margin-right:.3em}\n"
    "pre{background:#f6f8fa;padding:.8rem;overflow:auto;font-size:.82rem;line-height:1.4}\n"
    "code{font-family:ui-monospace,Menlo,Consolas,monospace;font-size:.9em}\n"
    "footer{margin-top:2.5rem;color:#57606a;font-size:.87rem}\n"
    "@media (min-width:1060px){figure:last-child:nth-child(odd){grid-column:1/-1;width:calc(50% - "
    ".8rem);justify-self:center}}\n"
    "@media (max-width:800px){.figures{grid-template-columns:1fr}.a{display:none}"
    "table{font-size:.78rem}td,th{padding:.2rem .3rem}}\n"
    "@media print{html{font-size:9pt}body{max-width:none;padding:0;font-size:1rem}"
    "h2{break-after:avoid}tr{break-inside:avoid}table{font-size:.85rem}td,th{padding:.1rem .35rem}"
    "td.a{font-size:.8rem}.a{display:table-cell}.figures{grid-template-columns:1fr 1fr}}\n";

static const char *fact(const Results *results, const char *name, const char *otherwise) {
    const char *text = results_find_fact(results, name);
    return text && text[0] ? text : otherwise;
}

static void put_verdict(Text *page, const Results *results) {
    const ResultCounter *broken = results_broken_limit(results);
    if (!broken) {
        text_put(page,
                 "<p class=\"verdict good\">Healthy: every counter is within its limit.</p>\n");
        return;
    }
    text_put(page, "<p class=\"verdict bad\">A health limit is broken: ");
    html_name(page, broken->name);
    text_add(page, " = %g, where %g is the limit. Do not trust these numbers.</p>\n", broken->value,
             broken->limit);
}

// What was simulated and how, in a sentence each.
static void put_system(Text *page, const Results *results) {
    static const char *const SAID[] = {"system", "stages"};
    for (size_t i = 0; i < sizeof SAID / sizeof *SAID; i++) {
        const char *words = fact(results, SAID[i], NULL);
        if (!words) continue;
        html_unit(page, words);
        text_put(page, ".<br>\n");
    }
}

static void put_left_out(Text *page, const Results *results) {
    const char *list = fact(results, RESULTS_NOT_SIDE_BY_SIDE, NULL);
    if (!list) return;
    text_put(page, "<details class=\"under\"><summary>Series that are not side by side, for their "
                   "axes are too many or differ: the report of each point has its own</summary>");
    html_words(page, list);
    text_put(page, "</details>\n");
}

void page_begin(Text *page, const Results *results) {
    const char *title = fact(results, "title", "Brownian dynamics of hard colloids");
    text_put(page, "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                   "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
                   "<title>");
    html_words(page, title);
    text_add(page, "</title>\n<style>\n%s</style>\n</head>\n<body>\n<h1>", STYLE);
    html_words(page, title);
    text_put(page, "</h1>\n<p class=\"under\">");
    put_system(page, results);
    if (results_find_fact(results, "seed")) { // not of a theory, where nothing is random
        text_add(page, "%zu replica%s, seed ", results->replicas,
                 results->replicas == 1 ? "" : "s");
        html_words(page, fact(results, "seed", "unknown"));
        text_put(page, ". ");
    }
    text_put(page, "Perrin ");
    html_words(page, fact(results, "version", ""));
    text_put(page, ", finished ");
    html_words(page, fact(results, "finished", "at an unknown time"));
    text_put(page, ".</p>\n");
    put_left_out(page, results);
    put_verdict(page, results);
}

// Becomes: {"pressure", "pressure_theory"}, ...
static const struct {
    const char *quantity, *reference;
} REFERENCES[] = {
#define REFERENCE(quantity, reference) {#quantity, #reference},
#include "report/references.def"
#undef REFERENCE
};
enum { REFERENCE_COUNT = sizeof REFERENCES / sizeof *REFERENCES };

static bool is_reference(const char *quantity) {
    for (size_t i = 0; i < REFERENCE_COUNT; i++) {
        if (strcmp(REFERENCES[i].reference, quantity) == 0) return true;
    }
    return false;
}

static const ResultScalar *reference_of(const Results *results, const ResultScalar *scalar) {
    for (size_t i = 0; i < REFERENCE_COUNT; i++) {
        if (strcmp(REFERENCES[i].quantity, scalar->quantity) != 0) continue;
        return results_find_scalar(results, scalar->stage, REFERENCES[i].reference);
    }
    return NULL;
}

static const char *sign(double value) { // typeset
    return value < 0 ? "−" : "+";
}

static void put_estimate(Text *page, Estimate estimate) {
    Text words = {0};
    notation_estimate(&words, estimate);
    const char *digits = text_words(&words);
    const bool negative = digits[0] == '-' && digits[1];
    if (negative) text_put(page, "−");
    html_words(page, digits + negative);
    text_free(&words);
}

// Cells of the reference and of the deviation from it, in percent and in standard errors.
static void put_reference(Text *page, const Results *results, const ResultScalar *scalar) {
    const ResultScalar *reference = reference_of(results, scalar);
    if (!reference) {
        text_put(page, "<td></td><td></td>");
        return;
    }
    const Estimate value = results_scalar_estimate(results, scalar);
    const Estimate wanted = results_scalar_estimate(results, reference);
    text_put(page, "<td class=\"n\" title=\"");
    html_unit(page, reference->about);
    text_add(page, "\">%.6g</td><td class=\"n\">", wanted.value);
    const double percent = 100 * (value.value / wanted.value - 1);
    const double deviations = (value.value - wanted.value) / value.error;
    if (isfinite(percent)) text_add(page, "%s%.2f %%", sign(percent), fabs(percent));
    if (isfinite(deviations)) {
        text_add(page, " (%s%.1f σ)", sign(deviations), fabs(deviations));
    }
    text_put(page, "</td>");
}

static void put_scalar(Text *page, const Results *results, const ResultScalar *scalar) {
    const Estimate estimate = results_scalar_estimate(results, scalar);
    text_put(page, "<tr><td>");
    html_name(page, scalar->quantity);
    text_put(page, "</td><td class=\"n\">");
    put_estimate(page, estimate);
    text_put(page, "</td><td class=\"u\">");
    html_unit(page, scalar->unit);
    text_put(page, "</td>");
    put_reference(page, results, scalar);
    text_add(page, "<td class=\"n\">%zu</td><td class=\"a\">", estimate.n);
    if (!selects_said_before(results, scalar)) html_unit(page, scalar->about);
    text_put(page, "</td></tr>\n");
}

static bool begins_stage(const Results *results, size_t scalar) {
    for (size_t i = 0; i < scalar; i++) {
        if (strcmp(results->scalars[i].stage, results->scalars[scalar].stage) == 0) return false;
    }
    return true;
}

static void put_stage(Text *page, const Results *results, const char *stage) {
    text_put(page, "<tr class=\"stage\"><th colspan=\"7\">Stage ");
    html_words(page, stage);
    text_put(page, "</th></tr>\n");
    for (size_t i = 0; i < results->scalar_count; i++) {
        const ResultScalar *scalar = &results->scalars[i];
        if (strcmp(scalar->stage, stage) != 0 || is_reference(scalar->quantity)) continue;
        if (tensor_has(scalar)) continue;
        put_scalar(page, results, scalar);
    }
}

static bool first_to_say(const Results *results, size_t scalar) {
    for (size_t i = 0; i < scalar; i++) {
        if (strcmp(results->scalars[i].about, results->scalars[scalar].about) == 0) return false;
    }
    return true;
}

// Where the references come from.
static void put_sources(Text *page, const Results *results) {
    const char *before = " References: ";
    for (size_t i = 0; i < results->scalar_count; i++) {
        if (!is_reference(results->scalars[i].quantity) || !first_to_say(results, i)) continue;
        text_put(page, before);
        html_unit(page, results->scalars[i].about);
        before = " ";
    }
}

// What the columns mean; of a theory, where nothing is random, there is less to say.
static void put_conventions(Text *page, const Results *results) {
    const bool simulated = results_find_fact(results, "seed") != NULL;
    text_put(page, "</table>\n<p class=\"under\">");
    if (simulated)
        text_put(page, "In brackets the standard error over the n replicas (of one: over the "
                       "trajectories in it), in units of the last digits; σ is that error alone, "
                       "and references have errors of their own and "
                       "are of equilibrium. ");
    else if (results->replicas > 1)
        text_put(page, "In brackets the standard error, in units of the last digits, from n groups "
                       "of what was measured, each left out in turn. ");
    text_put(page, "Lengths in d, energies in kT, times in d²/D₀");
    text_put(page, simulated ? ", in Newtonian stages in d √(m/kT)." : ".");
}

void page_numbers(Text *page, const Results *results) {
    flow_table_put(page, results);
    if (results->scalar_count == 0) return;
    text_put(page, "<h2>Numbers</h2>\n<table>\n<tr><th>Quantity</th><th class=\"n\">Value</th>"
                   "<th>Unit</th><th class=\"n\">Reference</th><th class=\"n\">Deviation</th>"
                   "<th class=\"n\">n</th><th class=\"a\">About</th></tr>\n");
    for (size_t i = 0; i < results->scalar_count; i++) {
        if (begins_stage(results, i)) put_stage(page, results, results->scalars[i].stage);
    }
    put_conventions(page, results);
    put_sources(page, results);
    text_put(page, "</p>\n");
    tensor_table(page, results);
}

static void put_counter(Text *page, const ResultCounter *counter) {
    const bool healthy = result_healthy(counter), judged = !isnan(counter->limit);
    text_put(page, "<tr><td>");
    html_name(page, counter->name);
    text_add(page, "</td><td class=\"n\">%.10g</td><td class=\"n\">", counter->value);
    if (judged) text_add(page, "%g", counter->limit);
    text_add(page, "</td><td class=\"%s\">%s</td><td class=\"a\">",
             !judged   ? ""
             : healthy ? "ok"
                       : "broken",
             !judged   ? ""
             : healthy ? "✓ good"
                       : "✗ broken");
    html_words(page, counter->about);
    text_put(page, "</td></tr>\n");
}

static const char EQUILIBRIUM[] = "equilibrium of ";

static bool tells_equilibrium(const ResultFact *fact) {
    return strncmp(fact->name, EQUILIBRIUM, strlen(EQUILIBRIUM)) == 0;
}

static void put_equilibrium(Text *page, const ResultFact *fact) {
    text_put(page, "<p>Equilibrium of ");
    html_words(page, fact->name + strlen(EQUILIBRIUM));
    text_put(page, ": ");
    html_words(page, fact->text);
    text_put(page, ".</p>\n");
}

void page_health(Text *page, const Results *results) {
    if (results->health_count == 0) return;
    text_put(page, "<h2>Health</h2>\n<table>\n<tr><th>Counter</th><th class=\"n\">Value</th>"
                   "<th class=\"n\">Limit</th><th>Verdict</th><th class=\"a\">About</th></tr>\n");
    for (size_t i = 0; i < results->health_count; i++) put_counter(page, &results->health[i]);
    text_put(page, "</table>\n");
    for (size_t i = 0; i < results->fact_count; i++) {
        if (tells_equilibrium(&results->facts[i])) put_equilibrium(page, &results->facts[i]);
    }
}

static bool is_elsewhere(const ResultFact *fact) { // above, or below the table
    if (tells_equilibrium(fact)) return true;
    static const char *const NAMES[] = {"plan", "title", "system", "stages",
                                        RESULTS_NOT_SIDE_BY_SIDE};
    for (size_t i = 0; i < sizeof NAMES / sizeof *NAMES; i++) {
        if (strcmp(fact->name, NAMES[i]) == 0) return true;
    }
    return false;
}

void page_provenance(Text *page, const Results *results) {
    text_put(page, "<h2>Provenance</h2>\n<table class=\"facts\">\n");
    for (size_t i = 0; i < results->fact_count; i++) {
        if (is_elsewhere(&results->facts[i])) continue;
        text_put(page, "<tr><td>");
        html_name(page, results->facts[i].name);
        text_put(page, "</td><td>");
        html_words(page, results->facts[i].text);
        text_put(page, "</td></tr>\n");
    }
    text_put(page, "</table>\n");
    const char *plan = results_find_fact(results, "plan");
    if (!plan) return;
    text_put(page, "<details><summary>The run file, all defaults filled</summary><pre>");
    html_words(page, plan);
    text_put(page, "</pre></details>\n");
}

void page_end(Text *page) {
    text_put(page, "<footer>All numbers: <code>perrin show DIR</code>, with <code>--json</code> or "
                   "<code>--csv</code> for machines. The script and the numbers of each figure are "
                   "in <code>figures/</code>. The same run again: <code>perrin rerun "
                   "results.h5</code>.</footer>\n</body>\n</html>\n");
}
