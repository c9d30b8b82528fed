// SPDX-License-Identifier: GPL-3.0-or-later
// perrin analyse: measures observables again from the trajectories of a run.
#include "command.h"

#include "base/memory.h"
#include "base/text.h"
#include "config/config.h"
#include "protocol/replica.h"
#include "report/report.h"
#include "session/session.h"
#include "store/store.h"

#include <stdio.h>
#include <string.h>

// "protocol.quiescent.observe=[overlap, self_scattering: {...}]": an operand each.
static Status override_observations(Text *setting, const Arguments *arguments, const char *stage) {
    text_add(setting, "protocol.%s.observe=[", stage);
    for (size_t i = 1; i < arguments->operands; i++) {
        const bool with_settings = strchr(arguments->operand[i], ':') != NULL;
        text_add(setting, with_settings ? "%s{%s}" : "%s%s", i > 1 ? ", " : "",
                 arguments->operand[i]);
    }
    text_add(setting, "]");
    return text_status(setting);
}

// What is asked for by name must be there to measure.
static Status check_observations(const Plan *plan) {
    for (size_t s = 0; s < plan->stage_count; s++) {
        const Stage *stage = &plan->stages[s];
        for (size_t k = 0; k < stage->observation_count; k++) {
            if (plan_stage_frames(plan, s).every == 0) continue;
            if (!stage->observations[k].kind->of_motion) continue;
            return status_fail(BAD_DATA,
                               "%s needs velocities or collisions, which trajectories do not have",
                               stage->observations[k].kind->name);
        }
    }
    return OK;
}

// The plan of the run, with the observations that the command line gives for every recorded stage.
static Status read_with(Plan **out, const Arguments *arguments, const char *path, const Plan *ran) {
    Text settings[STAGES_MOST] = {{0}};
    const char *words[STAGES_MOST];
    ConfigOverrides overrides = {0, words, 0};
    Status status = OK;
    for (size_t s = 0; s < ran->stage_count && status == OK; s++) {
        if (plan_stage_frames(ran, s).every == 0) continue;
        status = override_observations(&settings[s], arguments, ran->stages[s].name);
        words[overrides.count++] = text_words(&settings[s]);
    }
    if (status == OK) status = config_read(out, path, &overrides);
    for (size_t s = 0; s < STAGES_MOST; s++) text_free(&settings[s]);
    return status == OK ? check_observations(*out) : status;
}

static Status read_plan(Plan **out, const Arguments *arguments) {
    Text path = {0};
    Plan *ran = NULL;
    text_add(&path, "%s/plan.yaml", arguments->operand[0]);
    Status status = text_status(&path);
    if (status == OK) status = config_read(&ran, text_words(&path), NULL);
    if (status == OK && arguments->operands > 1) {
        status = read_with(out, arguments, text_words(&path), ran);
        memory_free(ran);
    } else {
        *out = ran;
    }
    text_free(&path);
    return status;
}

static Status keep(const Results *results, const char *directory) {
    Store *store = NULL;
    store_ignore_signals();
    TRY(store_open(&store, directory));
    Status status = store_write_results(store, results);
    if (status == OK) status = report_write(results, directory);
    store_close(store);
    if (status == OK) printf("%s/report.html\n", directory);
    return status;
}

static Status analyse_into(const Plan *plan, const char *from, const char *into) {
    Text directory = {0};
    Results *results = NULL;
    text_add(&directory, into ? "%s" : "%s/analysis", into ? into : from);
    Status status = text_status(&directory);
    if (status == OK) status = session_analyse(&results, plan, from);
    if (status == OK) status = keep(results, text_words(&directory));
    results_free(results);
    text_free(&directory);
    return status;
}

static Status analyse(const Arguments *arguments) {
    Plan *plan = NULL;
    Status status = read_plan(&plan, arguments);
    if (status == OK) {
        status = analyse_into(plan, arguments->operand[0], argument_value(arguments, "output"));
    }
    memory_free(plan);
    return status;
}

static const Flag flags[] = {
    {'o', "output", "DIR", "write results and report here; the default is DIR/analysis"},
    {0},
};

const Command command_analyse = {
    .name = "analyse",
    .operands = "DIR [OBSERVABLE...]",
    .about = "Measure again from the trajectories of a run: what it observed, or what is named, "
             "such as overlap or 'overlap: {distance: 0.2}'.",
    .flags = flags,
    .least = 1,
    .most = OPERANDS_MOST,
    .run = analyse,
};
